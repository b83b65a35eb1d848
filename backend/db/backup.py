"""A copy of the SQLite database, whether or not a service uses it."""

import os
import shutil
import sqlite3
import tempfile
import time
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from sqlalchemy import make_url

from backend.command_error import CommandError
from backend.db.sqlite import database_file, reason
from backend.settings import Settings

LOCK_TIMEOUT = 30.0  # [s]


@dataclass(frozen=True, slots=True, kw_only=True)
class Backup:
    """A finished copy.

    Attributes:
        database: What was copied.
        size: Of the copy [bytes].
        seconds: For which, without WAL, nobody could write [s].
    """

    database: Path
    size: int
    seconds: float


def back_up(settings: Settings, target: Path, *, overwrite: bool) -> Backup:
    """Copy the whole database to a file, which appears only when it is complete.

    SQLite writes it as one that reads: reads go on, and without WAL writes wait. The copy has no free pages.

    Args:
        settings: Say which database.
        target: The file.
        overwrite: Whether it may take an older file's place.

    Raises:
        CommandError: No copy was made.
        OSError: The file cannot be written.
    """
    file = database_file(make_url(settings.store_url))
    if file is None:
        raise CommandError("PostgreSQL is copied with pg_dump -Fc (docs/how-to/operations.md, Backup and restore)")
    if not file.path.exists():
        raise CommandError(f"There is no database at {file.path}")
    if file.path.stat().st_size == 0:  # SQLite takes it for a database without tables
        raise CommandError(f"{file.path} is empty, so there is nothing to copy")
    _check_target(file.path, target, overwrite=overwrite)
    with tempfile.TemporaryDirectory(prefix=f".{target.name}.", dir=target.parent) as folder:
        copy = Path(folder) / target.name
        try:
            seconds = _copy(file.path, copy)
        except sqlite3.Error as error:
            raise CommandError(f"No copy of {file.path} was made: {reason(error)}") from error
        shutil.copymode(file.path, copy)
        _sync(copy)
        _check_target(file.path, target, overwrite=overwrite)  # somebody may have put one there meanwhile
        copy.replace(target)
    _sync(target.parent)
    return Backup(database=file.path, size=target.stat().st_size, seconds=seconds)


def _check_target(database: Path, target: Path, *, overwrite: bool) -> None:
    if not target.parent.is_dir():
        raise CommandError(f"There is no folder {target.parent}")
    if target.is_dir():
        raise CommandError(f"{target} is a folder; name a file")
    if target.exists() and target.samefile(database):
        raise CommandError(f"{target} is the database itself")
    if target.exists() and not overwrite:
        raise CommandError(f"{target} is there already; --force replaces it")


def _copy(database: Path, copy: Path) -> float:
    """Copy and check a database; returns how long nobody could write to it, unless it is in WAL mode [s]."""
    address = f"{database.absolute().as_uri()}?mode=rw"
    begun = time.monotonic()
    with closing(sqlite3.connect(address, uri=True, timeout=LOCK_TIMEOUT, isolation_level=None)) as source:
        source.execute("VACUUM INTO ?", [str(copy)])
    seconds = time.monotonic() - begun
    with closing(sqlite3.connect(copy)) as target:
        (verdict,) = target.execute("PRAGMA quick_check(1)").fetchone()
    if verdict != "ok":
        raise CommandError(f"The copy of {database} is damaged, so it was not kept: {verdict}")
    return seconds


def _sync(path: Path) -> None:
    """Sync a file's content, or a folder's names, so that they survive a power cut."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
