"""The store on both databases it knows: SQLite, and a real PostgreSQL."""

import contextlib
import shutil
import sqlite3
import threading
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from sqlalchemy import Column, MetaData, func, select
from sqlalchemy.exc import IntegrityError, SQLAlchemyError

from backend.db.database import DAMAGED
from backend.db.sqlite import DamagedDatabaseError, wal_is_safe
from backend.db.tables import metadata, results
from backend.outcome import Outcome
from backend.store import Store, StoredLink, StoredRun
from tests.data import release
from tests.servers.postgres import Postgres
from tests.servers.process import HANG_TIMEOUT
from tests.there import there

OpenStore = Callable[[], Store]


@pytest.fixture
def open_store(database_url: str) -> Iterator[OpenStore]:
    """Opens the database once more, as another process would."""
    opened: list[Store] = []

    def open_one() -> Store:
        opened.append(Store(database_url))
        return opened[-1]

    yield open_one
    for store in opened:
        store.close()


SCENARIO = {"road": {"profile": None, "name": "ä 😀"}}


def outcomes(*keys: str) -> list[Outcome]:
    return [
        Outcome(key=key, strategy=key, status="ok", json=b'{"a":[1.5]}', compute_ms=2.0, cached=True) for key in keys
    ]


def save(store: Store, run_id: str, *keys: str) -> StoredRun:
    return saved_run(store, run_of(run_id, outcomes(*keys)))


def saved_run(store: Store, run: StoredRun) -> StoredRun:
    store.runs.save(run)
    return there(store.runs.load(run.id))


def run_of(run_id: str, items: list[Outcome], version: int = 1) -> StoredRun:
    return StoredRun(
        id=run_id,
        core_version=str(version),
        schema_version=version,
        scenario=SCENARIO,
        by_strategy={item.strategy: [item] for item in items},
    )


def in_threads(*calls: Callable[[], object]) -> list[BaseException]:
    """Run all at once; what they raised."""
    raised: list[BaseException] = []

    def guarded(call: Callable[[], object]) -> None:
        try:
            call()
        except (SQLAlchemyError, OSError, threading.BrokenBarrierError) as error:
            raised.append(error)

    threads = [threading.Thread(target=guarded, args=[call]) for call in calls]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return raised


def default(column: Column[Any]) -> str | None:
    return None if column.server_default is None else str(column.server_default.arg)  # type: ignore[attr-defined]


def schema(store: Store) -> dict[str, Any]:
    """Each table's columns, keys, references and indexes."""
    metadata = MetaData()
    with store.reading() as connection:
        metadata.reflect(connection)
    return {
        table.name: (
            sorted((each.name, str(each.type), each.nullable, default(each)) for each in table.c),
            sorted(str(each.name) + str([column.name for column in each.columns]) for each in table.constraints),  # type: ignore[attr-defined]
            sorted((str(each.name), [column.name for column in each.columns], each.unique) for each in table.indexes),
            sorted((each.target_fullname, str(each.ondelete)) for each in table.foreign_keys),
        )
        for table in metadata.tables.values()
    }


def test_a_database_of_0_4_0_has_the_schema_of_a_new_one_and_keeps_every_row(
    open_store: OpenStore, migrated_sqlite: Path, migrated_postgres: str, postgres: Postgres
) -> None:
    store = open_store()
    release.restore(store)
    store.migrate()
    is_sqlite = store.engine.dialect.name == "sqlite"
    url = f"sqlite:///{migrated_sqlite}" if is_sqlite else postgres.new_database(migrated_postgres)
    with contextlib.closing(Store(url)) as new:
        assert schema(store) == schema(new)
    with store.reading() as connection:
        now = release.dump(connection)
    assert now.keys() == metadata.tables.keys()
    for table, stored in now.items():
        for row in release.content()["tables"].get(table, ()):
            if table == "results" and row["status"] == "failed":
                continue  # the machine may have been to blame: it is computed again
            same = {name: value for name, value in row.items() if name in stored[0]}
            assert any(same.items() <= each.items() for each in stored), (table, row)


def test_migrating_again_and_from_many_processes_changes_nothing(open_store: OpenStore) -> None:
    stores = [open_store() for _ in range(4)]
    assert not in_threads(*(store.migrate for store in stores))
    saved = save(stores[0], "run", "a")
    for store in stores:
        store.migrate()
        assert store.runs.load("run") == saved


def test_a_stored_result_stays_as_it_was_first(store: Store) -> None:
    first = save(store, "one", "a", "b")
    assert [item.key for item in first.results] == ["a", "b"]
    assert first.scenario == SCENARIO
    changed = [Outcome(key="a", strategy="a", status="ok", json=b"{}", compute_ms=9.0)]
    second = saved_run(store, run_of("two", changed))
    assert second.results == first.results[:1]
    assert saved_run(store, run_of("one", changed, version=2)) == first


def test_links_keep_their_view_and_each_results_first_pin(store: Store) -> None:
    save(store, "r" * 22, "k1", "k2")
    view = {"baseline": "lv", "zoom": [1.25, 7]}
    link = StoredLink(slug="s" * 22, kind="run", target="r" * 22, view=view)
    content = bytes(range(256)) * 5000
    store.links.save(link, {"k1": content})
    store.links.save(replace(link, slug="u" * 22), {"k2": b"", "k1": b"another"})
    loaded = store.links.load("s" * 22)
    assert loaded is not None
    assert replace(loaded, created_at=link.created_at) == link
    assert store.links.load("t" * 22) is None
    assert store.links.pinned(["k1", "k2", "k3"]) == {"k1", "k2"}
    assert store.links.load_pins(["k1", "k2", "k3"]) == {"k1": content, "k2": b""}, "the first pin stays"
    with pytest.raises(IntegrityError):
        store.links.save(replace(link, slug="v" * 22, target="x" * 22), {})
    assert store.links.load("v" * 22) is None


def test_many_writers_of_the_same_results_wait_for_each_other(open_store: OpenStore) -> None:
    """Each in an order of its own, where a database that locks row by row meets deadlocks."""
    stores = [open_store() for _ in range(4)]
    stores[0].migrate()
    shared, rounds = [f"r{number:04}" for number in range(200)], range(3)
    together = threading.Barrier(len(stores), timeout=HANG_TIMEOUT)

    def write(number: int) -> None:
        order = shared if number % 2 else shared[::-1]
        for item in rounds:
            together.wait()
            save(stores[number], f"{number}-{item}", *(f"{key}-{item}" for key in order), f"own-{number}-{item}")

    assert not in_threads(*(lambda number=number: write(number) for number in range(4)))
    assert all(stores[0].runs.load(f"{number}-{item}") for number in range(4) for item in rounds)
    with stores[0].reading() as connection:
        assert connection.scalar(select(func.count()).select_from(results)) == len(rounds) * (len(shared) + 4)


def test_a_lost_database_is_reported_and_used_again_when_it_is_back(postgres: Postgres, server_store: Store) -> None:
    saved = save(server_store, "before", "a")
    for end in (postgres.stop, postgres.kill):
        end()
        with pytest.raises(SQLAlchemyError):
            server_store.ping()
        with pytest.raises(SQLAlchemyError):
            save(server_store, "during", "b")
        postgres.start()
        server_store.ping()
        assert server_store.runs.load("before") == saved
        assert server_store.runs.load("during") is None
    save(server_store, "during", "b")


def test_a_damaged_page_of_a_server_is_said_once_it_is_met(postgres: Postgres, server_store: Store) -> None:
    save(server_store, "run", "a")
    with server_store.reading() as connection:
        path = connection.exec_driver_sql("SELECT pg_relation_filepath('results')").scalar_one()
    server_store.ping()
    postgres.stop()
    with (postgres.folder / "data" / path).open("r+b") as file:
        file.write(b"\xff" * 8192)
    postgres.start()
    with pytest.raises(SQLAlchemyError):
        server_store.runs.load("run")
    assert server_store.damage == DAMAGED
    with pytest.raises(DamagedDatabaseError):
        server_store.ping()


def test_sqlite_is_set_up_for_durability(migrated_sqlite: Path, tmp_path: Path) -> None:
    expected = "wal" if wal_is_safe(sqlite3.sqlite_version_info) else "delete"
    store = Store(f"sqlite:///{shutil.copy(migrated_sqlite, tmp_path)}")
    with contextlib.closing(store), store.engine.connect() as connection:
        assert connection.exec_driver_sql("PRAGMA journal_mode").scalar() == expected
        assert connection.exec_driver_sql("PRAGMA synchronous").scalar() == 3, "EXTRA"
        assert connection.exec_driver_sql("PRAGMA foreign_keys").scalar() == 1


def test_wal_is_used_only_with_its_fix() -> None:
    fixed = [(3, 44, 6), (3, 50, 7), (3, 51, 3), (3, 52, 0)]
    assert all(map(wal_is_safe, fixed))
    assert not any(map(wal_is_safe, [(3, 44, 5), (3, 50, 6), (3, 51, 2)]))
