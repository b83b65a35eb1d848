"""A stored result of which a bit has flipped is noticed, computed again and counted; a link's reader is told."""

import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import httpx
import numpy as np
import pytest
from sqlalchemy import Column, Connection, Table, select, update

from backend.db.columns import UNCHECKED
from backend.db.database import insert_new
from backend.db.tables import links, pinned_series, recordings, results, roads, run_results, runs
from backend.errors import DamagedError
from backend.store import Store, StoredLink, StoredRun
from sim_core.scenario.measured import MeasuredRoad
from sim_core.scenario.recorded import RecordedDrive
from tests.api.test_job_store import BATCH, computed, rows
from tests.api.test_links import opened, share
from tests.api.test_store import outcomes, save
from tests.there import there


def damage(store: Store, key: str) -> None:
    """Change a digit of that result, which stays good JSON."""
    with store.writing() as connection:
        summary = text(connection, key)
        digit = there(re.search("[1-9]", summary))
        other = "2" if digit[0] == "1" else "1"
        changed = summary[: digit.start()] + other + summary[digit.end() :]
        connection.execute(update(results).where(results.c.key == key).values(summary=changed))


def key_of(store: Store, run_id: str) -> str:
    """Of the run's result of the passive car."""
    query = select(results.c.key).join(run_results, run_results.c.result_key == results.c.key)
    with store.reading() as connection:
        passive = query.where(run_results.c.run_id == run_id, results.c.strategy == "passive")
        return str(connection.execute(passive).scalar_one())


def text(connection: Connection, key: str) -> str:
    return str(connection.execute(select(results.c.summary).where(results.c.key == key)).scalar_one())


def dropped(client: httpx.Client, what: str = "result") -> float:
    (value,) = re.findall(
        rf'^ridelab_damaged_results_total{{what="{what}"}} (.*)$', client.get("/metrics").text, re.MULTILINE
    )
    return float(value)


def figures(run: Any) -> dict[str, Any]:
    """Everything but what the computation took."""
    return {name: {**each, "compute_ms": 0, "cached": None} for name, each in run["strategies"].items()}


@pytest.mark.parametrize("ask", ["read", "requested again", "part of another run"])
def test_a_damaged_result_of_a_run_is_computed_again(service: Any, fresh: dict[str, Any], ask: str) -> None:
    store: Store = service.services.store
    key, before = key_of(store, fresh["id"]), dropped(service)
    with store.reading() as connection:
        stored = text(connection, key)
    damage(store, key)
    if ask == "read":
        answer = service.get(f"/api/v1/runs/{fresh['id']}").json()
    else:
        names = ["passive"] if ask == "part of another run" else ["passive", "lv"]
        answer = service.run(names, fresh["scenario"]).json()
    assert figures(answer)["passive"] == figures(fresh)["passive"]
    if ask == "part of another run":  # whose answer came from memory: whoever reads it notices
        assert figures(service.get(f"/api/v1/runs/{answer['id']}").json())["passive"] == figures(fresh)["passive"]
    assert dropped(service) == before + 1
    with store.reading() as connection:
        assert text(connection, key) == stored
    assert figures(service.get(f"/api/v1/runs/{fresh['id']}").json()) == figures(fresh)
    assert dropped(service) == before + 1, "it is whole again"


def test_the_reader_of_a_link_is_told(service: Any, fresh: dict[str, Any]) -> None:
    slug = share(service, fresh["id"])["slug"]
    before = opened(service, slug)
    assert before["damaged_at"] is None
    damage(service.services.store, key_of(service.services.store, fresh["id"]))
    for _ in range(2):
        link = opened(service, slug)
        assert link["damaged_at"] > link["created_at"]
        assert figures(link["run"]) == figures(fresh)


def test_damaged_time_histories_of_a_link_are_made_again(service: Any, fresh: dict[str, Any]) -> None:
    slug, path = share(service, fresh["id"])["slug"], f"/api/v1/runs/{fresh['id']}/series?strategy=passive&points=100"
    whole, before = service.get(path).content, dropped(service, "series")
    store: Store = service.services.store
    pin = pinned_series.c.result_key == key_of(store, fresh["id"])
    with store.writing() as connection:
        content = bytearray(connection.execute(select(pinned_series.c.content).where(pin)).scalar_one())
        content[len(content) // 2] ^= 1
        connection.execute(update(pinned_series).where(pin).values(content=bytes(content)))
    refused = service.get(path)
    assert (refused.status_code, "damaged" in refused.json()["detail"]) == (503, True)
    assert service.get(path).content == whole
    assert dropped(service, "series") == before + 1
    assert opened(service, slug)["damaged_at"] is not None


RUN = StoredRun(
    id="r" * 22,
    core_version="1",
    schema_version=1,
    scenario={"road": {"profile": None}},
    by_strategy={item.strategy: [item] for item in outcomes("a", "b")},
)
ROAD = MeasuredRoad.of(np.zeros(600))
DRIVE = RecordedDrive.of({"time": np.arange(900.0), "body_acceleration": np.ones(900)})
READ: dict[Table, Callable[[Store], object]] = {
    results: lambda store: [*there(store.runs.load(RUN.id)).results, *store.runs.load_results(["a"]).values()],
    pinned_series: lambda store: store.links.load_pins(["a"]),
    runs: lambda store: store.runs.load(RUN.id),
    links: lambda store: store.links.load("s" * 22),
    roads: lambda store: store.roads.load([ROAD.id]),
    recordings: lambda store: store.recordings.load([DRIVE.id]),
}


@pytest.mark.parametrize("table", READ, ids=str)
def test_a_value_that_was_not_written_so_is_never_answered(store: Store, table: Table) -> None:
    """Each column of each kind of row; a result and its time histories are dropped, anything else is said."""
    store.runs.save(RUN)
    store.links.save(StoredLink(slug="s" * 22, kind="run", target=RUN.id, view={"x": 1}), {"a": bytes(100)})
    store.roads.save(ROAD, {"iri": 2.5})
    store.recordings.save(DRIVE)
    whole = READ[table](store)
    names = {*table.c.checksum.info["covered"], "checksum"}
    columns = [each for each in table.c if each.name in names and not each.primary_key and not each.foreign_keys]
    assert columns
    for column in columns:
        with store.writing() as connection:
            row = connection.execute(select(table)).first()._mapping  # type: ignore[union-attr]
            key = next(iter(table.primary_key)) == next(iter(row.values()))
            connection.execute(update(table).where(key).values({column.name: changed(column, row[column.name])}))
        if table in (results, pinned_series):
            assert READ[table](store) != whole, column
            with store.writing() as connection:
                insert_new(connection, table, [dict(row)])
                connection.execute(update(table).where(key).values(dict(row)))
        else:
            with pytest.raises(DamagedError):
                READ[table](store)
            with store.writing() as connection:
                connection.execute(update(table).where(key).values(dict(row)))
        assert READ[table](store) == whole


def changed(column: Column[Any], value: Any) -> Any:
    """Another value of the column's type; of a checksum none, as a flipped bit of a row's head leaves it."""
    if column.name == "checksum":
        return None
    if isinstance(value, int | float):
        return value + 1
    if isinstance(value, bytes):
        return bytes([value[0] ^ 1]) + value[1:]
    return {"other": 1} if isinstance(value, dict) else f"{value or ''}0"


def test_a_text_whose_type_became_bytes_is_damaged(store: Store) -> None:
    """SQLite keeps the type with each value: one bit decides it."""
    if store.engine.dialect.name == "sqlite":
        store.runs.save(RUN)
        with store.writing() as connection:
            connection.exec_driver_sql("UPDATE results SET summary = CAST(summary AS BLOB)")
        assert store.runs.load_results(["a", "b"]) == {}


def test_what_has_no_checksum_is_kept_as_until_0_3_0(store: Store) -> None:
    save(store, "run", "a", "b")
    damage(store, "a")
    with store.writing() as connection:
        connection.execute(update(results).where(results.c.key == "a").values(checksum=UNCHECKED))
    damage(store, "b")
    assert [item.status for item in there(store.runs.load("run")).results] == ["ok", "expired"]


def test_jobs_count_what_they_have_lost_and_a_cancelled_one_waits_for_nothing(store: Store) -> None:
    for job_id in ("done", "cancelled"):
        store.jobs.create(replace(BATCH, id=job_id), rows())
    good = computed(*(f"key-{number}" for number in range(11)))
    store.job_runs.save("done", [*good, *computed("key-11", status="failed")], "1")
    store.jobs.start("cancelled")
    assert store.job_runs.hand_out("cancelled", rows()) == []
    store.jobs.cancel("cancelled")
    assert store.jobs.finish("done")
    for key in ("key-3", "key-11"):
        with store.writing() as connection:
            connection.execute(update(results).where(results.c.key == key).values(summary='{"metrics":1}'))
    for job_id, state, status in (("done", "queued", "waiting"), ("cancelled", "cancelled", "cancelled")):
        store.job_runs.rows(job_id, -1, 100)
        job, run_statuses = store.jobs.load(job_id), [row.status for row in store.job_runs.rows(job_id, -1, 100)]
        assert job is not None
        assert (job.state, job.done, job.failed) == (state, 10, 0)
        assert [run_statuses[3], run_statuses[11]] == [status] * 2
        assert run_statuses.count("ok") == 10
