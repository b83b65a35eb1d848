"""The backup commands of docs/operations.md, run against a database in use."""

import os
import re
import shlex
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from sqlalchemy import make_url

from backend.store import Store, StoredResult, StoredRun
from tests.servers.postgres import Postgres, program

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/operations.md").read_text()


def save(store: Store, run_id: str) -> StoredRun:
    result = StoredResult(key=f"of {run_id}", strategy="lv", status="ok", summary={"a": "ä"}, compute_ms=2.0)
    return store.runs.save(run_id=run_id, core_version="1", schema_version=1, scenario={}, outcomes=[result])


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


def test_a_copy_of_sqlite_is_a_whole_database(sqlite_store: Store, tmp_path: Path) -> None:
    saved = save(sqlite_store, "before")
    words = documented(r"\.venv/bin/python -c")
    with sqlite_store.writing():  # the service is in the middle of something
        subprocess.run([sys.executable, *words[1:]], cwd=tmp_path, check=True)
    save(sqlite_store, "after")
    copy = Store(f"sqlite:///{tmp_path}/copy.sqlite")
    copy.migrate()
    assert copy.runs.load("before") == saved
    assert copy.runs.load("after") is None
    copy.close()


def test_a_dump_of_postgresql_brings_everything_back(postgres: Postgres, tmp_path: Path) -> None:
    url = make_url(postgres.new_database())
    environment = {**os.environ, "PGPASSWORD": str(url.password), "PGHOST": str(url.host), "PGPORT": str(url.port)}
    store = Store(url.render_as_string(hide_password=False))
    store.migrate()
    saved = save(store, "before")

    def run(words: list[str]) -> None:
        here = [str(url.database) if word == "ridelab" else word for word in words]
        here[here.index("-U") + 1] = str(url.username)
        subprocess.run([program(here[0]), *here[1:]], env=environment, cwd=tmp_path, check=True)

    dump = documented("pg_dump -h")
    run([word for word in dump if word not in ("-h", "HOST")])
    save(store, "after")
    restore = documented("docker compose exec -T database pg_restore")
    begin, end = restore.index("pg_restore"), restore.index("<")
    run([*restore[begin:end], restore[-1]])
    assert store.runs.load("before") == saved
    assert store.runs.load("after") is None
    save(store, "after")
    store.close()
