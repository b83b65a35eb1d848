"""Answers that come bit by bit: server-sent events, and the rows of a long JSON answer."""

import json
import re
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from ridelab.errors import RidelabConnectionError

_ROWS = re.compile(r'"rows"\s*:\s*\[')
_DECODER = json.JSONDecoder()


class Event(NamedTuple):
    """Something that happened to a job: `state`, `progress` or `restart`, and how the job stood then."""

    id: str
    kind: str
    data: dict[str, Any]


def server_sent(lines: Iterable[str], last_id: str = "") -> Iterator[Event | None]:
    """The events in a stream's lines (WHATWG HTML, 9.2.6), and None for each line between, which is a sign of life.

    One that is cut off is not an event.
    """
    kind, data = "message", list[str]()
    for line in lines:
        name, _, value = line.partition(":")
        value = value.removeprefix(" ")
        if line:
            if name == "id":
                last_id = value
            elif name == "event":
                kind = value
            elif name == "data":
                data.append(value)
            yield None
            continue
        if data:
            yield Event(last_id, kind, json.loads("\n".join(data)))
        kind, data = "message", []


def json_rows(pieces: Iterable[str]) -> Iterator[dict[str, Any]]:
    """The objects of an answer's last member, `"rows": [..]`, each as soon as it is there.

    Raises:
        RidelabConnectionError: The answer ended before its end.
    """
    text, begun = "", False
    for piece in pieces:
        text += piece
        if not begun:
            head = _ROWS.search(text)
            if head is None:
                continue
            text, begun = text[head.end() :], True
        while True:
            text = text.lstrip(" \t\r\n,")
            if text.startswith("]"):
                return
            try:
                row, end = _DECODER.raw_decode(text)
            except ValueError:  # the rest of this row is still to come
                break
            text = text[end:]
            yield row
    raise RidelabConnectionError("The answer ended before its last row")
