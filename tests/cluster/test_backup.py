"""The backup commands of docs/how-to/operations.md, run against a database in use."""

import json
import os
import re
import shlex
import sqlite3
import subprocess
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import make_url

from backend.command_error import CommandError
from backend.db.backup import back_up
from backend.settings import Settings
from backend.store import Store
from tests.api.test_store import save
from tests.client.cli import Cli
from tests.servers.postgres import Postgres, program
from tests.servers.process import wait_until

ROOT = Path(__file__).parents[2]
PAGE_SIZE = 4096
PAGE = (ROOT / "docs/how-to/operations.md").read_text()

Backup = Callable[..., str]


def damaged(database: Path) -> bytes:
    """Its content with the first page of its results overwritten."""
    with closing(sqlite3.connect(database)) as connection:
        (page,) = connection.execute("SELECT rootpage FROM sqlite_master WHERE name = 'results'").fetchone()
    content = database.read_bytes()
    return content[: (page - 1) * PAGE_SIZE] + b"\xff" * PAGE_SIZE + content[page * PAGE_SIZE :]


def documented(pattern: str) -> list[str]:
    """The words of the page's command that begins so."""
    (line,) = re.findall(rf"^    ({pattern}.*)$", PAGE, re.MULTILINE)
    return shlex.split(line)


@pytest.fixture
def sqlite_store(tmp_path: Path) -> Iterator[Store]:
    store = Store(f"sqlite:///{tmp_path}/data/ridelab.sqlite")
    store.migrate()
    yield store
    store.close()


@pytest.fixture
def backup(tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes], monkeypatch: pytest.MonkeyPatch) -> Backup:
    """The page's command, in a folder with the default's data directory; gives what it says."""
    (_, *words) = documented(r"\.venv/bin/ridelab backup")
    monkeypatch.chdir(tmp_path)
    cli = Cli(capfdbinary)
    return lambda *more, code=0: cli(*words, *more, code=code) + cli.error


def test_a_copy_of_sqlite_under_writes_is_a_whole_database(sqlite_store: Store, tmp_path: Path, backup: Backup) -> None:
    save(sqlite_store, "before", "a")
    copied = threading.Event()

    def write() -> int:
        written = 0
        while not copied.is_set():
            save(sqlite_store, f"beside-{written}", "a")
            written += 1
        return written

    with ThreadPoolExecutor(1) as threads:
        writing = threads.submit(write)
        try:
            wait_until(lambda: sqlite_store.runs.load("beside-9"), "somebody writes")
            assert "writes waited" in backup()
        finally:
            copied.set()
    copy = Store(f"sqlite:///{tmp_path}/copy.sqlite")
    copy.migrate()
    there = [copy.runs.load(f"beside-{number}") is not None for number in range(writing.result())]
    assert copy.runs.load("before") == sqlite_store.runs.load("before")
    assert there == sorted(there, reverse=True), "as it was at one moment"
    assert there[9]
    copy.close()
    assert {path.name for path in tmp_path.iterdir()} == {"data", "copy.sqlite"}
    assert json.loads(backup("--force", "--json"))["file"] == "copy.sqlite"


def refusal(**settings: Any) -> str:
    """Why no copy of what these settings name takes the place of copy.sqlite."""
    with pytest.raises(CommandError) as refused:
        back_up(Settings.model_validate(settings), Path("copy.sqlite"), overwrite=True)
    return str(refused.value)


def test_no_copy_is_half_and_none_is_lost(sqlite_store: Store, tmp_path: Path, backup: Backup) -> None:
    save(sqlite_store, "before", "a")
    sqlite_store.close()
    (tmp_path / "copy.sqlite").write_text("older")
    assert "is there already; --force replaces it" in backup(code=2)
    folder = tmp_path / "data"
    database = folder / "ridelab.sqlite"
    whole = database.read_bytes()
    for content, why in (
        (damaged(database), "damaged"),
        (b"no database at all" * 100, "it is no SQLite database"),
        (b"", "is empty, so there is nothing to copy"),
    ):
        database.write_bytes(content)
        assert why in refusal(data_dir=folder)
    assert "There is no database at" in refusal(data_dir=tmp_path / "none")
    assert "pg_dump" in refusal(data_dir=tmp_path, database_url="postgresql://host/ridelab")
    assert (tmp_path / "copy.sqlite").read_text() == "older"
    database.write_bytes(whole)
    backup("--force")
    with closing(Store(f"sqlite:///{tmp_path}/copy.sqlite")) as copy:
        assert copy.runs.load("before") is not None
        assert len(copy.runs.load_results(["a"])) == 1
    assert {path.name for path in tmp_path.iterdir()} == {"data", "copy.sqlite"}


def test_a_dump_of_postgresql_brings_everything_back(postgres: Postgres, tmp_path: Path) -> None:
    url = make_url(postgres.new_database())
    environment = {**os.environ, "PGPASSWORD": str(url.password), "PGHOST": str(url.host), "PGPORT": str(url.port)}
    store = Store(url.render_as_string(hide_password=False))
    store.migrate()
    saved = save(store, "before", "a")

    def run(words: list[str]) -> None:
        here = [str(url.database) if word == "ridelab" else word for word in words]
        here[here.index("-U") + 1] = str(url.username)
        subprocess.run([program(here[0]), *here[1:]], env=environment, cwd=tmp_path, check=True)

    dump = documented("pg_dump -h")
    run([word for word in dump if word not in ("-h", "HOST")])
    save(store, "after", "a")
    restore = documented("docker compose exec -T database pg_restore")
    begin, end = restore.index("pg_restore"), restore.index("<")
    run([*restore[begin:end], restore[-1]])
    assert store.runs.load("before") == saved
    assert store.runs.load("after") is None
    save(store, "after", "a")
    store.close()
