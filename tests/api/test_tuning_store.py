"""Tunings in the store, on both databases: a generation is committed whole and once, whoever drives."""

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from datetime import UTC, datetime
from typing import Any

import orjson
import pytest

from backend.store import Store, StoredTuning
from backend.store.tunings import StoredTrial
from tests.api.test_batch_store import BATCH, rows

TUNING = StoredTuning(
    id="t" * 22,
    state="queued",
    reason=None,
    step="search",
    attempt=1,
    core_version="1",
    schema_version=1,
    request={"scenario": {"road": {"seed": 1}}, "seeds": [1, 2]},
    estimated_cost=1.5,
    total=4,
    done=0,
    failed=0,
    feasible=0,
    generation=0,
    batch_id=None,
    comparison=None,
    request_hash="hash",
    created_at=datetime(2026, 11, 21, 12, tzinfo=UTC),
    started_at=None,
    finished_at=None,
)
TOLD = {"best": [0.1], "hypervolume": None}


def trial(number: int, generation: int, *, ok: bool = True) -> StoredTrial:
    return StoredTrial(
        number=number,
        generation=generation,
        weights={"lqr.weights": [0.1, 1 / 3, 50.0]},
        status="ok" if ok else "failed",
        reason=None if ok else "lost",
        feasible=ok,
        values=[0.1 + 0.2, 1e-300] if ok else None,
        limits=[] if ok else None,
    )


@pytest.fixture
def store(migrated_url: str) -> Iterator[Store]:
    store = Store(migrated_url)
    store.batches.create(BATCH, rows(), None)
    yield store
    store.close()


@pytest.fixture
def tuning(store: Store) -> StoredTuning:
    return store.tunings.create(TUNING, "once")[0]


def now(store: Store) -> StoredTuning:
    found = store.tunings.load(TUNING.id)
    assert found is not None
    return found


def told(store: Store) -> list[tuple[str, str, int]]:
    events = store.tunings.events(TUNING.id, 0)
    assert [event.number for event in events] == list(range(1, len(events) + 1))
    found = [(event.kind, orjson.loads(event.data)) for event in events]
    return [(kind, data["state"], data["generation"]) for kind, data in found]


def test_what_is_created_is_loaded_again(store: Store, tuning: StoredTuning) -> None:
    assert tuning == TUNING
    assert now(store) == TUNING
    assert store.tunings.by_idempotency_key("once") == TUNING
    assert store.tunings.newest(5) == [TUNING]
    assert store.tunings.unfinished() == [TUNING.id]
    assert store.tunings.counts() == {"queued": 1}
    assert store.tunings.load("x") is None
    assert told(store) == [("state", "queued", 0)]


def test_an_idempotency_key_has_one_tuning_however_many_ask_at_once(store: Store) -> None:
    def create(number: int) -> tuple[StoredTuning, bool]:
        return store.tunings.create(replace(TUNING, id=str(number)), "once")

    with ThreadPoolExecutor(6) as threads:
        answers = list(threads.map(create, range(6)))
    assert len({tuning.id for tuning, _ in answers}) == 1
    assert [new for _, new in answers].count(True) == 1
    assert all(store.tunings.create(replace(TUNING, id=name), None)[1] for name in "xyz")


def test_a_generation_is_committed_whole_and_once(store: Store, tuning: StoredTuning) -> None:
    assert store.tunings.waits_for(tuning, BATCH.id, "search")
    running = now(store)
    assert (running.state, running.batch_id) == ("running", BATCH.id)
    assert running.started_at is not None
    made = [trial(0, 0), trial(1, 0, ok=False)]
    with ThreadPoolExecutor(6) as threads:  # two services that both believe they drive, and more
        added = list(threads.map(lambda _: store.tunings.add_generation(running, made, TOLD), range(6)))
    assert added.count(True) == 1
    assert store.tunings.trials(TUNING.id) == made, "to the last bit of each number"
    found = now(store)
    assert (found.generation, found.done, found.failed, found.feasible) == (1, 1, 1, 1)
    assert not store.tunings.waits_for(running, BATCH.id, "search"), "it is further than this one knows"
    assert store.tunings.waits_for(found, BATCH.id, "search")
    assert store.tunings.add_generation(found, [trial(2, 1), trial(3, 1)], TOLD)
    assert [trial.number for trial in store.tunings.trials(TUNING.id)] == [0, 1, 2, 3]
    assert [each["done"] for each in store.tunings.history(TUNING.id)] == [1, 3]
    assert store.tunings.history(TUNING.id)[0]["best"] == [0.1]
    assert told(store) == [
        ("state", "queued", 0),
        ("state", "running", 0),
        ("progress", "running", 1),
        ("progress", "running", 2),
    ]


def test_it_ends_with_its_comparison(store: Store, tuning: StoredTuning) -> None:
    store.tunings.waits_for(tuning, BATCH.id, "comparison")
    assert store.tunings.finish(now(store), {"points": []})
    done = now(store)
    assert (done.state, done.step, done.comparison) == ("done", "comparison", {"points": []})
    assert done.finished_at is not None
    assert store.tunings.unfinished() == []
    store.tunings.cancel(TUNING.id)
    store.tunings.fail(done, "too late")
    assert not store.tunings.finish(done, {})
    assert now(store) == done


def test_what_was_cancelled_takes_no_more_until_it_is_resumed(store: Store, tuning: StoredTuning) -> None:
    store.tunings.add_generation(tuning, [trial(0, 0)], TOLD)
    before = now(store)
    store.tunings.cancel(TUNING.id)
    assert now(store).state == "cancelled"
    assert not store.tunings.add_generation(before, [trial(1, 1)], TOLD)
    assert not store.tunings.waits_for(before, BATCH.id, "search")
    store.tunings.resume(TUNING.id, 9, 3.0)
    resumed = now(store)
    assert (resumed.state, resumed.total, resumed.estimated_cost, resumed.attempt) == ("queued", 9, 3.0, 2)
    assert (resumed.generation, resumed.done, resumed.finished_at) == (1, 1, None)
    # Whoever drove it before does not know yet that it was begun anew: nothing of theirs counts.
    store.tunings.fail(before, "One of its batches was cancelled")
    assert not store.tunings.add_generation(before, [trial(1, 1)], TOLD)
    assert now(store) == resumed
    store.tunings.resume(TUNING.id, 10, 3.0)
    assert now(store) == resumed, "it has not ended"
    store.tunings.fail(resumed, "no more")
    assert (now(store).state, now(store).reason) == ("failed", "no more")
    store.tunings.resume(TUNING.id, 9, 3.0)
    assert now(store).reason is None


def test_another_core_version_keeps_no_number(store: Store, tuning: StoredTuning) -> None:
    store.tunings.add_generation(tuning, [trial(0, 0)], TOLD)
    scenario: dict[str, Any] = {"road": {"seed": 1, "roughness": 0}}
    store.tunings.restart(now(store), scenario, "2", 3)
    found = now(store)
    assert (found.core_version, found.schema_version, found.attempt) == ("2", 3, 2)
    assert (found.generation, found.done, found.feasible) == (0, 0, 0)
    assert found.request == {"scenario": scenario, "seeds": [1, 2]}
    assert store.tunings.trials(TUNING.id) == store.tunings.history(TUNING.id) == []
    store.tunings.add_generation(found, [trial(0, 0)], TOLD)
    assert len(store.tunings.history(TUNING.id)) == 1
    assert [kind for kind, *_ in told(store)] == ["state", "progress", "restart", "progress"]
