"""Tunings in the store, on both databases: a generation is committed whole and once, whoever drives."""

from concurrent.futures import ThreadPoolExecutor
from datetime import UTC, datetime

import orjson
import pytest

from backend.store import Store, StoredJob
from backend.store.trials import StoredTrial
from tests.api.test_job_store import BATCH, rows

TUNING = StoredJob(
    id="t" * 22,
    kind="tuning",
    core_version="1",
    schema_version=1,
    request={"scenario": {"road": {"seed": 1}}, "seeds": [1, 2]},
    progress={"step": "search", "attempt": 1, "generation": 0, "feasible": 0, "batch": None},
    estimated_cost=1.5,
    total=4,
    request_hash="hash",
    created_at=datetime(2026, 11, 21, 12, tzinfo=UTC),
)
QUALITY = {"best": [0.1], "hypervolume": None}


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
def store(store: Store) -> Store:
    store.jobs.create(BATCH, rows(), None)
    return store


@pytest.fixture
def tuning(store: Store) -> StoredJob:
    return store.jobs.create(TUNING, idempotency_key="once")[0]


def now(store: Store) -> StoredJob:
    loaded = store.jobs.load(TUNING.id)
    assert loaded is not None
    return loaded


def stored_events(store: Store) -> list[tuple[str, str, int]]:
    events = store.job_events.of(TUNING.id, 0)
    assert [event.number for event in events] == list(range(1, len(events) + 1))
    pairs = [(event.kind, orjson.loads(event.data)) for event in events]
    return [(kind, data["state"], data["generation"]) for kind, data in pairs]


def add(store: Store, job: StoredJob, *trials: StoredTrial) -> bool:
    """Commit a generation of these."""
    generation = job.progress["generation"] + 1
    return store.jobs.advance(
        job,
        event="progress",
        details=QUALITY,
        new_trials=trials,
        progress=job.progress | {"generation": generation},
        done=job.done + sum(each.status == "ok" for each in trials),
    )


def test_a_generation_is_committed_whole_and_once(store: Store, tuning: StoredJob) -> None:
    trials = [trial(0, 0), trial(1, 0, ok=False)]
    with ThreadPoolExecutor(6) as threads:  # two services that both believe they drive, and more
        added = list(threads.map(lambda _: add(store, tuning, *trials), range(6)))
    assert added.count(True) == 1
    assert store.trials.of(TUNING.id) == trials, "to the last bit of each number"
    job = now(store)
    assert (job.progress["generation"], job.done) == (1, 1)
    assert not store.jobs.advance(tuning, event=None, state="running"), "it is further than this one knows"
    assert store.jobs.advance(job, event="state", state="running")
    assert add(store, job, trial(2, 1), trial(3, 1))
    assert [trial.number for trial in store.trials.of(TUNING.id)] == [0, 1, 2, 3]
    assert [each["done"] for each in store.job_events.history(TUNING.id)] == [1, 3]
    assert store.job_events.history(TUNING.id)[0]["best"] == [0.1]
    assert stored_events(store) == [
        ("state", "queued", 0),
        ("progress", "queued", 1),
        ("state", "running", 1),
        ("progress", "running", 2),
    ]


def test_what_was_cancelled_takes_no_more_until_it_is_resumed(store: Store, tuning: StoredJob) -> None:
    add(store, tuning, trial(0, 0))
    before = now(store)
    store.jobs.cancel(TUNING.id)
    assert now(store).state == "cancelled"
    assert not add(store, before, trial(1, 1))
    store.jobs.resume(TUNING.id, total=9, progress=before.progress | {"attempt": 2})
    resumed = now(store)
    assert (resumed.state, resumed.total, resumed.progress["attempt"]) == ("queued", 9, 2)
    assert (resumed.progress["generation"], resumed.done, resumed.finished_at) == (1, 1, None)
    # Whoever drove it before does not know yet that it was begun anew: nothing of theirs counts.
    store.jobs.fail(before, "One of its batches was cancelled")
    assert not add(store, before, trial(1, 1))
    assert now(store) == resumed
    store.jobs.resume(TUNING.id, total=10)
    assert now(store) == resumed, "it has not ended"
    store.jobs.fail(resumed, "no more")
    assert (now(store).state, now(store).reason) == ("failed", "no more")
    store.jobs.resume(TUNING.id)
    assert now(store).reason is None


def test_a_restart_drops_trials_and_begins_a_new_history(store: Store, tuning: StoredJob) -> None:
    add(store, tuning, trial(0, 0))
    store.jobs.advance(
        now(store), event="restart", drop_trials=True, core_version="2", progress=TUNING.progress, done=0
    )
    assert store.trials.of(TUNING.id) == []
    assert store.job_events.history(TUNING.id) == []
    add(store, now(store), trial(0, 0))
    assert len(store.job_events.history(TUNING.id)) == 1
    assert [kind for kind, *_ in stored_events(store)] == ["state", "progress", "restart", "progress"]
