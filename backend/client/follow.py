"""Answers that come bit by bit: server-sent events, and the rows of a long JSON answer."""

import json
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from backend.client.errors import RidelabConnectionError

_ROWS = re.compile(r'"rows"\s*:\s*\[')
_BETWEEN = " \t\r\n,"
_DECODER = json.JSONDecoder()


@dataclass(frozen=True, slots=True, kw_only=True)
class Event:
    """One server-sent event; `id` is the last one the stream has named."""

    id: str
    kind: str
    data: str


def events(lines: Iterable[str], last_id: str = "") -> Iterator[Event]:
    """The events in a stream's lines (WHATWG HTML, 9.2.6); one that is cut off is not an event."""
    kind, data = "", list[str]()
    for line in lines:
        if not line:
            if data:
                yield Event(id=last_id, kind=kind or "message", data="\n".join(data))
            kind, data = "", []
            continue
        name, _, value = line.partition(":")
        value = value.removeprefix(" ")
        if name == "id" and "\0" not in value:
            last_id = value
        elif name == "event":
            kind = value
        elif name == "data":
            data.append(value)


def rows(pieces: Iterable[str]) -> Iterator[dict[str, Any]]:
    """The objects of an answer's last member, `"rows": [..]`, each as soon as it is there.

    Raises:
        RidelabConnectionError: The answer ended before its end.
    """
    text, begun = "", False
    for piece in pieces:
        text += piece
        if not begun:
            found = _ROWS.search(text)
            if found is None:
                continue
            text, begun = text[found.end() :], True
        place = 0
        while True:
            while place < len(text) and text[place] in _BETWEEN:
                place += 1
            if text[place : place + 1] == "]":
                return
            try:
                row, place = _DECODER.raw_decode(text, place)
            except ValueError:  # the rest of this row is still to come
                break
            yield row
        text = text[place:]
    raise RidelabConnectionError("The answer ended before its last row")
