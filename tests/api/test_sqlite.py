"""SQLite's file: with other programs at it, gone, read-only, or one that no service can start on.

A short lock is waited for, a long one is an error, and readers go on.
"""

import asyncio
import contextlib
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import threading
from collections.abc import Awaitable, Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import insert

from backend.db import database, sqlite
from backend.db.migrations import REVISIONS
from backend.db.sqlite import DatabaseLockedError, DatabaseReplacedError, UnusableDatabaseError
from backend.db.tables import runs
from backend.settings import Settings
from backend.store import Store
from tests.api.conftest import serve
from tests.api.test_store import save
from tests.servers import loops
from tests.servers.process import HANG_TIMEOUT, ROOT

WRITE, READ, READ_WRITE = "BEGIN IMMEDIATE", "BEGIN", "BEGIN EXCLUSIVE"
SHORT = 0.4  # [s]


@pytest.fixture
def path(migrated_sqlite: Path, tmp_path: Path) -> Path:
    return Path(shutil.copy(migrated_sqlite, tmp_path))


@pytest.fixture
def store(path: Path) -> Iterator[Store]:
    store = Store(f"sqlite:///{path}")
    save(store, "before", "a")
    yield store
    store.close()


@contextlib.contextmanager
def foreign(path: Path, begin: str) -> Iterator[sqlite3.Connection]:
    """Another program in the middle of a transaction."""
    with contextlib.closing(sqlite3.connect(path, isolation_level=None, check_same_thread=False)) as connection:
        connection.execute(begin)
        connection.execute("SELECT count(*) FROM runs").fetchall()
        yield connection


def together(work: Callable[[], Awaitable[Any]]) -> Any:
    async def run() -> Any:
        return await work()

    return loops.run(run)


@pytest.mark.parametrize("begin", [WRITE, READ])
def test_readers_go_on_while_writers_wait_and_fail(store: Store, path: Path, begin: str) -> None:
    async def work() -> None:
        writers = [asyncio.create_task(store.write(save, store, f"run-{number}", "b")) for number in range(8)]
        reads = 0
        while not any(writer.done() for writer in writers):
            assert await store.read(store.runs.load, "before") is not None
            await store.read(store.ping)
            reads += 1
        assert reads > 1
        errors = await asyncio.gather(*writers, return_exceptions=True)
        assert [type(error) for error in errors] == [DatabaseLockedError] * 8, "those queued behind the first, too"

    with foreign(path, begin):
        together(work)
    save(store, "after", "b")


@pytest.mark.parametrize("begin", [WRITE, READ, READ_WRITE])
def test_a_short_lock_fails_nothing(store: Store, path: Path, begin: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sqlite, "LOCK_TIMEOUT", 30.0)  # on a busy machine the lock below lasts longer

    async def work() -> None:
        writes = [store.write(save, store, f"run-{number}", "b") for number in range(4)]
        reads = [store.read(store.runs.load, "before") for _ in range(8)]
        assert None not in await asyncio.gather(*writes, *reads)

    with foreign(path, begin) as connection:
        threading.Timer(SHORT, connection.rollback).start()
        together(work)


@pytest.mark.parametrize("kind", ["writing", "reading"])
def test_a_long_transaction_of_our_own_is_waited_for_and_readers_go_on(store: Store, kind: str) -> None:
    """No other program is to blame. One that writes outgrows SQLite's cache, which once locked every reader out."""
    begun, may_end = threading.Event(), threading.Event()

    def long() -> None:
        with getattr(store, kind)() as connection:
            for number in range(200 if kind == "writing" else 0):
                large = {"core_version": "1", "schema_version": 1, "scenario": "x" * 50_000}
                connection.execute(insert(runs).values(id=str(number), roads=1, baseline=None, **large))
            connection.exec_driver_sql("SELECT count(*) FROM runs").all()
            begun.set()
            assert may_end.wait(HANG_TIMEOUT)

    async def work() -> None:
        first = asyncio.create_task(store.write(long) if kind == "writing" else store.read(long))
        while not begun.is_set():
            assert not first.done(), first.exception()
            await asyncio.sleep(0.01)
        second = asyncio.create_task(store.write(save, store, "second", "b"))
        try:
            await asyncio.sleep(1.2)  # longer than a lock of another program is waited for
            assert await store.read(store.runs.load, "before") is not None
            assert kind == "reading" or not second.done()
        finally:
            may_end.set()
        await asyncio.gather(first, second)

    together(work)


def test_a_file_that_is_gone_or_another_is_said(store: Store, path: Path, migrated_sqlite: Path) -> None:
    aside = path.rename(path.with_name("aside"))
    for _ in range(2):
        with pytest.raises(DatabaseReplacedError):
            store.ping()
        with pytest.raises(DatabaseReplacedError):
            save(store, "lost", "b")
        assert list(path.parent.iterdir()) in ([aside], [aside, path], [path, aside])
        shutil.copy(migrated_sqlite, path)
    aside.rename(path)
    store.ping()
    assert store.runs.load("lost") is None


READ_ONLY = """
import os, sys
from pathlib import Path
from sqlalchemy.exc import SQLAlchemyError
from backend.db import database, sqlite
from backend.store import Store

path = Path(sys.argv[1])
store = Store(f"sqlite:///{path}")
store.ping()
path.parent.chmod(0o555)
if os.geteuid() == 0:
    os.seteuid(65534)  # root may write everywhere
try:
    store.ping()
except SQLAlchemyError as error:
    print(error.orig)
"""


def test_a_folder_that_cannot_be_written_to_is_said(path: Path) -> None:
    with tempfile.TemporaryDirectory() as folder:  # pytest's own only its owner may enter
        command = [sys.executable, "-c", READ_ONLY, shutil.copy(path, folder)]
        ended = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    assert ended.stdout == "attempt to write a readonly database\n"


def damaged(path: Path) -> None:
    content = path.read_bytes()
    path.write_bytes(content[:200] + b"\xff" * (len(content) - 200))


def newer(path: Path) -> None:
    changed(path, "UPDATE alembic_version SET version_num = '9999'")


def older(path: Path) -> None:
    changed(path, "UPDATE alembic_version SET version_num = '0012'")


def strange(path: Path) -> None:
    path.unlink()
    changed(path, "CREATE TABLE bookmarks (id INTEGER)")


def changed(path: Path, statement: str) -> None:
    with contextlib.closing(sqlite3.connect(path)) as connection, connection:
        connection.execute(statement)


@pytest.mark.parametrize(
    ("spoil", "reason"),
    [
        (lambda path: path.write_bytes(b"no database at all" * 100), "it is no SQLite database"),
        (lambda path: path.write_bytes(b""), "is empty: put a backup in its place"),
        (damaged, "it is damaged; put a backup in its place"),
        (newer, f"is of a newer version of Ridelab (schema 9999, this one knows {REVISIONS[-1]})"),
        (older, "is of Ridelab 0.3.0 or before (schema 0012): start 0.4.0 on it once"),
        (strange, "is another program's database"),
        (lambda path: (path.unlink(), path.mkdir()), "it cannot be opened"),
        (lambda path: (path.unlink(), path.symlink_to("/dev/null/ridelab.sqlite")), "Not a directory"),
    ],
    ids=["other", "empty", "damaged", "newer", "older", "strange", "folder", "nowhere"],
)
def test_a_start_says_what_is_wrong_with_the_database(path: Path, spoil: Callable[[Path], None], reason: str) -> None:
    spoil(path)
    there = path.read_bytes() if path.is_file() else None
    with contextlib.closing(Store(f"sqlite:///{path}")) as store, pytest.raises(UnusableDatabaseError) as caught:
        store.migrate()
    assert str(path) in str(caught.value)
    assert reason in str(caught.value)
    assert "\n" not in str(caught.value)
    assert there is None or path.read_bytes() == there


def test_a_damaged_page_is_said_once_it_is_met(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """As a power cut may leave it: the second half never reached the disk, and only who reads it can know."""
    body = {"scenario": {"road": {"length": 12, "bump": {"start": 5, "width": 2}}}, "strategies": ["passive"]}
    for service in serve(Settings(data_dir=tmp_path, workers=1, batch_workers=1)):
        run = service.post("/api/v1/runs", json=body).raise_for_status().json()
        assert service.get("/readyz").json()["reason"] is None
        with (tmp_path / "ridelab.sqlite").open("r+b") as file:
            file.truncate(file.seek(0, 2) // 2)
        assert service.get(f"/api/v1/runs/{run['id']}").status_code == 503
        unready = service.get("/readyz")
        assert (unready.status_code, unready.json()["store"]) == (503, False)
        assert unready.json()["reason"] == database.DAMAGED
    (said,) = (each.getMessage() for each in caplog.records if "ridelab.sqlite" in each.getMessage())
    assert "put a backup in its place" in said


def test_a_start_waits_for_a_lock_longer_than_a_request_does(path: Path) -> None:
    with contextlib.closing(Store(f"sqlite:///{path}")) as store, foreign(path, READ_WRITE) as connection:
        threading.Timer(1.3, connection.rollback).start()
        store.migrate()
