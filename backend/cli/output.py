"""Results as files, or on standard output where the file is called `-`."""

import sys
from collections.abc import Iterable
from pathlib import Path

from backend.cli.reporting import InputError
from backend.client.files import format_of, save


def chosen_format(out: str, file_format: str | None) -> str:
    """The format asked for, else the one the file's name ends with; said before anything is computed for it.

    Raises:
        InputError: There is no such format, or no such folder.
    """
    if not Path(out).parent.is_dir():
        raise InputError(f"--out: there is no folder {Path(out).parent}")
    try:
        return format_of(out, file_format)
    except ValueError as error:
        raise InputError(f"{'--format' if file_format or out == '-' else '--out'}: {error}") from None


def deliver(content: Iterable[bytes], out: str) -> None:
    """Write the pieces there; a file is whole or not touched.

    Raises:
        OSError: It cannot be written.
    """
    if out != "-":
        save(content, out)
        return
    for piece in content:
        sys.stdout.buffer.write(piece)
