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

from backend.settings import Settings
from backend.store.sqlite import database_file

PATIENCE = 30.0  # with those that write [s]
LOOK = 0.002  # SQLite itself looks so seldom that who writes all the time is always quicker [s]


class BackupError(Exception):
    """No copy was made; the message says why, in one sentence."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Backup:
    """A copy that was made.

    Attributes:
        database: What was copied.
        size: Of the copy [bytes].
        seconds: For which nobody could write [s].
    """

    database: Path
    size: int
    seconds: float


def back_up(settings: Settings, target: Path, *, overwrite: bool) -> Backup:
    """Copy the whole database to a file, which is there when it is whole and not before.

    Nothing is written to the database while it is copied: SQLite begins a copy anew with every write of another
    process, and so never ends where somebody writes all the time. Reads go on.

    Args:
        settings: Say which database.
        target: The file.
        overwrite: Whether it may take an older file's place.

    Raises:
        BackupError: No copy was made.
        OSError: The file cannot be written.
    """
    file = database_file(make_url(settings.store_url))
    if file is None:
        raise BackupError("PostgreSQL is copied with pg_dump -Fc (docs/operations.md, Backup and restore)")
    if not file.path.exists():
        raise BackupError(f"There is no database at {file.path}")
    _check_target(file.path, target, overwrite=overwrite)
    handle, name = tempfile.mkstemp(prefix=f".{target.name}.", dir=target.parent)
    beside = Path(name)
    try:
        seconds = _copy(file.path, beside)
        shutil.copymode(file.path, beside)
        os.fsync(handle)
        beside.replace(target)
    except sqlite3.Error as error:
        raise BackupError(f"{file.path}: {error}") from error
    finally:
        os.close(handle)
        beside.unlink(missing_ok=True)
    _sync_folder(target.parent)
    return Backup(database=file.path, size=target.stat().st_size, seconds=seconds)


def _check_target(database: Path, target: Path, *, overwrite: bool) -> None:
    if not target.parent.is_dir():
        raise BackupError(f"There is no folder {target.parent}")
    if target.is_dir():
        raise BackupError(f"{target} is a folder; name a file")
    if target.exists() and target.samefile(database):
        raise BackupError(f"{target} is the database itself")
    if target.exists() and not overwrite:
        raise BackupError(f"{target} is there already; --force replaces it")


def _copy(database: Path, copy: Path) -> float:
    """All of it, looked through; how long nobody could write [s]."""
    address = f"{database.absolute().as_uri()}?mode=rw"
    with (
        closing(sqlite3.connect(address, uri=True, timeout=0, isolation_level=None)) as turn,
        closing(sqlite3.connect(address, uri=True, timeout=PATIENCE)) as source,
        closing(sqlite3.connect(copy)) as made,
    ):
        made.execute("PRAGMA synchronous=OFF")  # written to the disk as a whole, when the turn is over
        _take(turn)
        begun = time.monotonic()
        source.backup(made)
        turn.rollback()
        seconds = time.monotonic() - begun
        (found,) = made.execute("PRAGMA quick_check(1)").fetchone()
    if found != "ok":
        raise BackupError(f"{database} is damaged, so no copy was kept: {found}")
    return seconds


def _take(turn: sqlite3.Connection) -> None:
    end = time.monotonic() + PATIENCE
    while True:
        try:
            turn.execute("BEGIN IMMEDIATE")
        except sqlite3.OperationalError as error:
            if error.sqlite_errorcode & 0xFF != sqlite3.SQLITE_BUSY or time.monotonic() > end:
                raise
            time.sleep(LOOK)
        else:
            return


def _sync_folder(folder: Path) -> None:
    """The file's name outlives a power cut, too."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
