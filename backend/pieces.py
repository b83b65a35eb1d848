"""Answers written piece by piece, into memory or into a file. Runs in workers: no web here."""

import io
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any

import orjson


def render_to(write: Callable[[IO[bytes]], object], path: Path | None) -> bytes:
    """Return what `write` writes, or have it written into the existing file at `path`."""
    if path is None:
        memory = io.BytesIO()
        write(memory)
        return memory.getvalue()
    with path.open("r+b") as file:  # not created: if the file is gone, its request was cancelled
        write(file)
        file.truncate()  # what a worker that died may have left behind
    return b""


def write_json(value: Any, file: IO[bytes]) -> None:
    """Write JSON piece by piece: a dictionary member by member; a function is called when its value is due."""
    if callable(value):
        value = value()
    if not isinstance(value, dict) or not value:
        file.write(orjson.dumps(value, option=orjson.OPT_SERIALIZE_NUMPY))
        return
    for number, (key, member) in enumerate(value.items()):
        file.write((b"," if number else b"{") + orjson.dumps(key) + b":")
        write_json(member, file)
    file.write(b"}")
