"""Answers written piece by piece, into memory or into a file. Runs in workers: no web here."""

import io
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any

import orjson


def rendered(write: Callable[[IO[bytes]], object], path: Path | None) -> bytes:
    """What `write` writes; nothing where it goes into a file, which has to be there."""
    if path is None:
        memory = io.BytesIO()
        write(memory)
        return memory.getvalue()
    with path.open("r+b") as file:  # nobody waits for one that is gone, and none may be made
        write(file)
        file.truncate()  # what a worker that died may have left behind
    return b""


def write_json(value: Any, file: IO[bytes]) -> None:
    """Write JSON: of a dictionary member after member, and of a function what it returns when its turn comes."""
    if callable(value):
        value = value()
    if not isinstance(value, dict) or not value:
        file.write(orjson.dumps(value, option=orjson.OPT_SERIALIZE_NUMPY))
        return
    for number, (key, member) in enumerate(value.items()):
        file.write((b"," if number else b"{") + orjson.dumps(key) + b":")
        write_json(member, file)
    file.write(b"}")
