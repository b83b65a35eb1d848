"""SQLite's own needs: its file, its locks, and the errors of a start on a database that cannot be used."""

import os
import sqlite3
import tempfile
from contextlib import closing
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import Any

from sqlalchemy import URL, Connection, Engine, create_engine, event
from sqlalchemy.exc import DBAPIError, OperationalError

from backend.command_error import CommandError
from backend.db.columns import SQLITE_FUNCTION

LOCK_TIMEOUT = 1.0  # a lock of another program is waited for so long, then it is an error [s]
# While a commit waits for the last reader, SQLite lets no other reader begin: it is rolled back and tried again [s].
COMMIT_TIMEOUT = 0.1
LARGE_CACHE = 25_000  # pages of 4 KiB that a large transaction keeps in memory; SQLite takes a multiple of 256 for 0
APPLICATION_ID = int.from_bytes(b"Ride")  # in the file's header
# A page, the header or the file's end is not what was written; or its disk cannot read it any more.
DAMAGED = (sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB)
UNREADABLE = (sqlite3.SQLITE_IOERR_READ, sqlite3.SQLITE_IOERR_SHORT_READ, sqlite3.SQLITE_IOERR_CORRUPTFS)
# Of PostgreSQL: data corrupted, index corrupted, a file of a table gone, its disk cannot read it.
SERVER_DAMAGED = ("XX001", "XX002", "58P01", "58030")
REASONS = {
    sqlite3.SQLITE_BUSY: "another program holds a lock on it",
    sqlite3.SQLITE_CANTOPEN: "it cannot be opened",
    sqlite3.SQLITE_CORRUPT: "it is damaged; put a backup in its place",
    sqlite3.SQLITE_FULL: "its disk is full",
    sqlite3.SQLITE_NOTADB: "it is no SQLite database; put a backup in its place",
    sqlite3.SQLITE_READONLY: "it or its folder cannot be written to",
}


class UnusableDatabaseError(CommandError):
    """A service cannot start on this database."""


class DatabaseLockedError(OperationalError):
    """Another program has held a lock for longer than `LOCK_TIMEOUT`."""

    def __init__(self) -> None:
        reason = f"another program has held a lock on the SQLite database for more than {LOCK_TIMEOUT:g} s"
        super().__init__(None, None, sqlite3.OperationalError(reason))


class DatabaseReplacedError(OperationalError):
    """The file was deleted or replaced since it was opened: nobody would find what is written to the old one."""

    def __init__(self, path: Path) -> None:
        super().__init__(None, None, sqlite3.OperationalError(f"{path} was deleted or replaced since the start"))


class DamagedDatabaseError(OperationalError):
    """A page of the database turned out to be damaged: what is on it is lost, and nothing more may be written."""

    def __init__(self, reason: str) -> None:
        super().__init__(None, None, sqlite3.OperationalError(reason))


class DatabaseFile:
    """The file of a SQLite database; `opened` says which one it was at the first transaction."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.opened: tuple[int, int] | None = None

    def connect(self) -> sqlite3.Connection:
        """Return a connection; unlike SQLite's own it creates no file where there is none."""
        return sqlite3.connect(
            f"{self.path.absolute().as_uri()}?mode=rw",
            uri=True,
            timeout=LOCK_TIMEOUT,
            isolation_level=None,  # the driver begins nothing on its own, `_begin` does
            check_same_thread=False,  # the pool hands it from thread to thread, one at a time
        )

    def create(self) -> None:
        """Create the file atomically where there is none: an empty file is then a lost database, not a crashed start.

        Raises:
            UnusableDatabaseError: It is empty, its disk is full, or its folder cannot be written to.
        """
        try:
            if not self.path.exists():
                self.path.parent.mkdir(parents=True, exist_ok=True)
                self._create()
            empty = self.path.stat().st_size == 0
        except OSError as error:
            raise UnusableDatabaseError(f"{self.path}: {error.strerror}") from error
        except sqlite3.Error as error:
            raise UnusableDatabaseError(f"{self.path}: {reason(error)}") from error
        if empty:
            raise UnusableDatabaseError(f"{self.path} is empty: put a backup in its place, or delete it to begin anew")

    def _create(self) -> None:
        with tempfile.TemporaryDirectory(dir=self.path.parent, prefix=".new-") as folder:
            new = Path(folder) / self.path.name
            with closing(sqlite3.connect(new)) as connection:
                connection.execute(f"PRAGMA application_id={APPLICATION_ID}")
            try:
                os.link(new, self.path)
            except FileExistsError:
                pass  # another process was quicker
            except OSError:  # a file system without hard links
                new.replace(self.path)


def database_file(url: URL) -> DatabaseFile | None:
    """The file of a database at that URL; None where SQLite itself is told more of it, by `file:`, or on a server."""
    name = str(url.database)
    return None if url.get_backend_name() != "sqlite" or name.startswith("file:") else DatabaseFile(Path(name))


def sqlite_engine(url: URL, file: DatabaseFile | None) -> Engine:
    """Connections to the file. A transaction with the option `lock_timeout` writes, and may wait so long [s]."""
    if file is None:
        engine = create_engine(url, connect_args={"isolation_level": None})
    else:
        engine = create_engine(url, creator=file.connect)
    event.listen(engine, "connect", _set_up)
    event.listen(engine, "begin", partial(_begin, file))
    return engine


def _set_up(connection: sqlite3.Connection, _: object) -> None:
    mode = "WAL" if wal_is_safe(sqlite3.sqlite_version_info) else "DELETE"
    # EXTRA: with the mode DELETE a power cut could bring the journal of a committed transaction back, which undoes it.
    for pragma in (f"journal_mode={mode}", "synchronous=EXTRA", "foreign_keys=ON"):
        connection.execute(f"PRAGMA {pragma}").close()
    connection.create_function(SQLITE_FUNCTION, 0, _now)
    # Text that a flipped bit has made invalid is read with another character there: then its checksum tells.
    connection.text_factory = partial(str, encoding="utf-8", errors="replace")


def _now() -> str:
    """Return the machine's clock, which all who share the file have, in the form of times in the file."""
    return f"{datetime.now(UTC):%Y-%m-%d %H:%M:%S.%f}"


def _begin(file: DatabaseFile | None, connection: Connection) -> None:
    """Have a writer take its lock at once: one that upgrades a read lock may fail without waiting.

    Raises:
        DatabaseReplacedError: The file is not the one of the first transaction.
    """
    if file is not None:
        try:
            status = file.path.stat()
        except OSError:
            raise DatabaseReplacedError(file.path) from None
        file.opened = file.opened or (status.st_dev, status.st_ino)
        if file.opened != (status.st_dev, status.st_ino):
            raise DatabaseReplacedError(file.path)
    options = connection.get_execution_options()
    lock_timeout: float | None = options.get("lock_timeout")
    driver: Any = connection.connection.dbapi_connection  # where nothing can fail: SQLAlchemy takes ten times as long
    # A transaction that outgrows the cache would lock readers out before it commits: only a migration's does.
    driver.execute(f"PRAGMA cache_spill={LARGE_CACHE if options.get('large') else 'OFF'}")
    driver.execute(f"PRAGMA busy_timeout={1000 * (LOCK_TIMEOUT if lock_timeout is None else lock_timeout):.0f}")
    if lock_timeout is None:
        driver.execute("BEGIN")  # which locks nothing yet
    else:
        connection.exec_driver_sql("BEGIN IMMEDIATE")
        driver.execute(f"PRAGMA busy_timeout={1000 * min(lock_timeout, COMMIT_TIMEOUT):.0f}")


def try_writing(engine: Engine) -> None:
    """Begin to write and roll back (0.1 ms). A lock is no error: its holder can write.

    Raises:
        SQLAlchemyError: Nothing can be written.
    """
    try:
        with engine.connect().execution_options(lock_timeout=0) as connection:
            version = connection.exec_driver_sql("PRAGMA user_version").scalar_one()
            connection.exec_driver_sql(f"PRAGMA user_version={version}")  # opens the journal in the folder
            connection.rollback()
    except OperationalError as error:
        if not is_locked(error):
            raise


def is_locked(error: DBAPIError) -> bool:
    """Check whether SQLite gave up waiting for a lock."""
    return _code(error) == sqlite3.SQLITE_BUSY


def is_damaged(error: BaseException | None) -> bool:
    """Check whether a driver's error says that the database's own pages are damaged."""
    code = getattr(error, "sqlite_errorcode", 0)
    return code & 0xFF in DAMAGED or code in UNREADABLE or getattr(error, "sqlstate", None) in SERVER_DAMAGED


def reason(error: DBAPIError | sqlite3.Error) -> str:
    """Why the database cannot be used, without the statement and its values."""
    text = str(_cause(error)).strip().splitlines()
    return REASONS.get(_code(error), text[0] if text else type(error).__name__)


def _code(error: DBAPIError | sqlite3.Error) -> int:
    extended: Any = getattr(_cause(error), "sqlite_errorcode", 0)
    return int(extended) & 0xFF


def _cause(error: DBAPIError | sqlite3.Error) -> BaseException | None:
    return error.orig if isinstance(error, DBAPIError) else error


def wal_is_safe(version: tuple[int, ...]) -> bool:
    """Check whether that SQLite has the fix of the WAL-reset race (3.51.3, and 3.50.7 and 3.44.6 on their branches)."""
    return version >= (3, 51, 3) or (3, 50, 7) <= version < (3, 51) or (3, 44, 6) <= version < (3, 45)
