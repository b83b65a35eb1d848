"""Old jobs and results are removed where the operator says so; runs, links and labels keep what they name."""

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from sqlalchemy import update

from backend.db.columns import UNCHECKED
from backend.db.tables import REMOVED, jobs, results, roads
from backend.jobs.retention import Retention
from backend.outcome import UNAVAILABLE, failure_json
from backend.settings import Settings
from backend.store import Store, StoredLink, retention
from sim_core.scenario.measured import MeasuredRoad
from tests.api.conftest import Service
from tests.api.test_job_store import BATCH, computed, purge, rows
from tests.api.test_store import SCENARIO, outcomes, save
from tests.servers import loops
from tests.servers.process import HANG_TIMEOUT
from tests.there import there

LONG_AGO = datetime.now(UTC) - timedelta(days=40)


LINK = StoredLink(slug="s" * 22, kind="run", target="linked", view={})


@pytest.fixture
def store(store: Store) -> Store:
    return fill(store)


@pytest.fixture
def on_server(server_store: Store) -> Store:
    """The same on PostgreSQL."""
    return fill(server_store)


def fill(store: Store) -> Store:
    """Runs `plain`, `linked` and `pinned`, jobs `plain`, `labelled` and `linked` with a child, all of them long ago."""
    for name in ("plain", "linked"):
        save(store, name, f"{name}-1", "shared")
    link = StoredLink(slug="r" * 22, kind="run", target="linked", view={})
    store.links.save(link, {"linked-1": b"histories"})
    for name in ("plain", "labelled", "linked"):
        store.jobs.create(replace(BATCH, id=name), rows(name))
        if name == "plain":
            store.jobs.create(replace(BATCH, id="child", parent_id="plain"), rows("child"))
            store.job_runs.save("child", computed("child-0"), "1")
            store.jobs.cancel("child")
        store.job_runs.save(name, computed(*(f"{name}-{number}" for number in range(12))), "1")
        assert store.jobs.finish(name)
    store.jobs.set_label("labelled", "winter")
    store.links.save(StoredLink(slug="j" * 22, kind="batch", target="linked", view={}), {})
    with store.writing() as connection:
        connection.execute(update(jobs).values(finished_at=LONG_AGO))
        connection.execute(update(results).values(created_at=LONG_AGO))
    return store


def apply(store: Store, **limits: float) -> None:
    loops.run(Retention(store, Settings(data_dir=Path("unused"), **limits), store.write).apply)


def test_what_is_old_goes_and_what_is_named_stays(store: Store) -> None:
    apply(store)
    assert store.jobs.load("plain") is not None, "off by default"
    apply(store, retention_days=50)
    assert store.jobs.load("plain") is not None, "not so old"
    apply(store, retention_days=30)
    assert store.jobs.load("plain") is store.jobs.load("child") is None
    assert store.jobs.load("labelled") is not None
    assert store.jobs.load("linked") is not None
    assert len(store.job_runs.rows("labelled", -1, 20)) == 12
    stored = store.runs.load_results(["plain-0", "plain-1", "labelled-0", "linked-0", "linked-1", "shared", "child-0"])
    assert sorted(stored) == ["labelled-0", "linked-0", "linked-1", "shared"], "a run with a link keeps all its results"
    run = there(store.runs.load("plain"))
    assert run.expired
    assert run.scenario == SCENARIO
    assert [item.strategy for item in run.results] == ["plain-1", "shared"], "what it was is known"


def test_a_child_that_is_named_or_linked_keeps_its_family(store: Store) -> None:
    store.jobs.set_label("child", "the best weights")
    apply(store, retention_days=30)
    assert store.jobs.load("plain") is not None
    store.jobs.set_label("child", None)
    store.links.save(StoredLink(slug="c" * 22, kind="batch", target="child", view={}), {})
    apply(store, retention_days=30)
    assert store.jobs.load("child") is not None
    assert not store.jobs.delete("child"), "it belongs to a job"


USES: dict[str, Callable[[Store], object]] = {
    "label": lambda store: store.jobs.set_label("plain", "winter"),
    "resume": lambda store: store.jobs.resume("plain"),
    "link": lambda store: store.links.save(replace(LINK, kind="batch", target="plain"), {}),
    "link to a run": lambda store: store.links.save(replace(LINK, target="plain"), {}),
}


@pytest.mark.parametrize("use", USES)
def test_what_is_used_while_retention_looks_stays(on_server: Store, monkeypatch: pytest.MonkeyPatch, use: str) -> None:
    """On PostgreSQL others write meanwhile: here between the look for what is old and its removal."""
    store, lock = on_server, retention._lock
    used: list[object] = []
    before = datetime.now(UTC) - timedelta(days=30)
    if use == "link to a run":
        store.retention.remove("jobs", before)  # which need its results too
        purge(store)

    def late(*arguments: Any) -> None:
        if not used:
            used.append(USES[use](store))
        lock(*arguments)

    monkeypatch.setattr(retention, "_lock", late)
    if use == "link to a run":
        assert store.retention.remove("results", before) > 0
        assert used == [True]
        assert set(store.runs.load_results(["plain-1", "shared"])) == {"plain-1", "shared"}
    else:
        store.retention.remove("jobs", before)
        purge(store)
        assert store.jobs.load("plain") is not None
        assert len(store.job_runs.rows("plain", -1, 20)) == 12


def test_a_link_that_waits_for_a_removal_finds_it_done(on_server: Store) -> None:
    with on_server.engine.connect() as connection, ThreadPoolExecutor(1) as threads:
        connection.execute(update(jobs).where(jobs.c.id == "plain").values(kind=REMOVED))
        linking = threads.submit(on_server.links.save, replace(LINK, kind="batch", target="plain"), {})
        with pytest.raises(TimeoutError):
            linking.result(timeout=0.3)
        connection.commit()
        assert linking.result(HANG_TIMEOUT) is False


def test_rows_that_a_deletion_left_are_removed_where_nothing_else_is(store: Store) -> None:
    """The service ended in the middle of it."""
    assert store.jobs.delete("plain")
    apply(store)
    assert store.job_runs.rows("plain", -1, 20) == []
    assert len(store.job_runs.rows("labelled", -1, 20)) == 12


def test_an_expired_result_is_stored_again_whoever_computes_it(store: Store) -> None:
    apply(store, retention_days=30)
    store.jobs.create(replace(BATCH, id="again"), [rows()[0]._replace(key="plain-1")])
    assert [run.key for run in store.job_runs.waiting("again", range(9))] == ["plain-1"], "it is not there"
    before = there(store.runs.load("plain"))
    newer: dict[str, Any] = {"core_version": "2", "schema_version": 7, "scenario": {"road": {"profile": None}}}
    store.runs.recompute(
        replace(before, **newer, by_strategy={item.strategy: [item] for item in outcomes("plain-1", "other")}), "2"
    )
    run = there(store.runs.load("plain"))
    assert not run.expired
    assert {name: getattr(run, name) for name in newer} == newer
    assert store.runs.load_results(["plain-1"]).keys() == {"plain-1"}


def test_a_road_stays_while_it_is_young_and_as_long_as_a_run_or_a_job_names_it(store: Store) -> None:
    names = ("nobody's", "a run's", "a job's", "a sweep's", "sent again")
    measured = {name: MeasuredRoad.of(np.full(600, index * 0.01)) for index, name in enumerate(names)}
    for road in measured.values():
        store.roads.save(road)
    linked = there(store.runs.load("linked"))
    runs = replace(linked, id="on-it", scenario={"road": {"profile": measured["a run's"].id}})
    store.runs.save(runs)
    store.jobs.create(replace(BATCH, id="job", request={"scenario": {"road": {"profile": measured["a job's"].id}}}))
    grid = {"grid": {"road.profile": [None, measured["a sweep's"].id]}}
    store.jobs.create(replace(BATCH, id="sweep", request={"scenario": {"road": {}}}, sweep=grid))
    with store.writing() as connection:
        connection.execute(update(roads).values(created_at=LONG_AGO))
    store.roads.save(measured["sent again"])

    def stored() -> list[str]:
        return [name for name in names if measured[name].id in store.roads.load([measured[name].id])]

    apply(store, retention_days=50)
    assert stored() == list(names), "not so old"
    apply(store, retention_days=30)
    assert stored() == ["a run's", "a job's", "a sweep's", "sent again"]
    assert store.roads.load([measured["a run's"].id])[measured["a run's"].id].heights().tolist() == [0.01] * 600
    for name in ("job", "sweep"):
        store.jobs.cancel(name)
        assert store.jobs.delete(name)
    apply(store, retention_days=30)
    assert stored() == ["a run's", "sent again"]


def test_the_oldest_goes_first_where_all_is_too_large(store: Store) -> None:
    with store.writing() as connection:
        for key, size, when in (("plain-3", 3_000_000, LONG_AGO), ("labelled-3", 100_000, datetime.now(UTC))):
            changed = {"summary": f'{{"text": "{size * "x"}"}}', "created_at": when, "checksum": UNCHECKED}
            connection.execute(update(results).where(results.c.key == key).values(**changed))
    apply(store, retention_bytes=2 * 1024 * 1024)
    assert store.retention.size() < 2 * 1024 * 1024
    assert store.jobs.load("plain") is None
    assert "labelled-3" in store.runs.load_results(["labelled-3"])


def test_a_failure_that_is_not_the_scenarios_does_not_take_the_place_of_what_expired(
    service: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is told, and the next time it is tried again."""
    store, results_of = service.services.store, service.services.runs.results
    scenario = {"road": {"length": 12.7, "bump": {"start": 5, "width": 2}}}
    run = service.run(["passive", "lqr"], scenario).json()
    keys = [result.key for result in there(store.runs.load(run["id"])).results]
    with store.writing() as connection:
        connection.execute(update(results).where(results.c.key.in_(keys)).values(created_at=LONG_AGO))
    apply(store, retention_days=30)
    call = service.services.workers.call

    async def away(*arguments: Any, **queued: Any) -> Any:
        failed = {"status": "failed", "json": failure_json("its road is away", UNAVAILABLE), "cacheable": False}
        return {name: replace(each, **failed, series=None) for name, each in (await call(*arguments, **queued)).items()}

    def answered() -> dict[str, Any]:
        results_of.memory.clear()
        answer: dict[str, Any] = service.get(f"/api/v1/runs/{run['id']}").json()["strategies"]
        return answer

    with monkeypatch.context() as patch:
        patch.setattr(service.services.workers, "call", away)
        assert {(each["kind"], each["reason"]) for each in answered().values()} == {("unavailable", "its road is away")}
    assert there(store.runs.load(run["id"])).expired
    assert 'ridelab_removed_total{what="results"}' in service.get("/metrics").text
    again = {name: each["metrics"] for name, each in answered().items()}
    assert again == {name: each["metrics"] for name, each in run["strategies"].items()}
    assert not there(store.runs.load(run["id"])).expired
