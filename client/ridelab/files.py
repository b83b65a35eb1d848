"""Answers written to files: the whole file or none."""

import os
import uuid
from collections.abc import Iterable
from pathlib import Path

FORMATS = ("json", "csv", "parquet")


def format_of(path: str | os.PathLike[str], file_format: str | None = None) -> str:
    """The format named, else that of the name's ending.

    Raises:
        ValueError: There is no such format; the message lists those there are.
    """
    kind = (file_format or Path(path).suffix.removeprefix(".")).lower()
    if kind not in FORMATS:
        raise ValueError(f"The file's format has to be {', '.join(FORMATS[:-1])} or {FORMATS[-1]}")
    return kind


def save(pieces: Iterable[bytes], path: str | os.PathLike[str]) -> Path:
    """Write the pieces beside `path`, then put them in its place: a broken answer leaves what was there.

    Raises:
        OSError: It cannot be written.
    """
    target = Path(path)
    beside = target.with_name(f".{target.name}.{uuid.uuid4().hex[:8]}")
    try:
        with beside.open("xb") as file:
            file.writelines(pieces)
        return beside.replace(target)
    finally:
        beside.unlink(missing_ok=True)
