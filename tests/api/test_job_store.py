"""Jobs in the store, on both databases: each kind is counted right and committed once, whichever service writes."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from typing import Any

import orjson
import pytest

from backend.db.tables import links
from backend.job_run import JobRun
from backend.outcome import Outcome
from backend.store import Store, StoredJob, StoredLink, jobs
from backend.store.job import UNPLANNED
from backend.store.trials import StoredTrial
from tests.there import there

RUNS = 12
BATCH = StoredJob(
    id="b" * 22,
    kind="sweep",
    core_version="1",
    schema_version=1,
    request={"scenario": {"road": {"seed": 1}}, "strategies": ["lv", "passive"], "fields": ["road.seed"]},
    sweep={"grid": {"road.seed": [1, 2, 3, 4, 5, 6]}},
    estimated_cost=1.5,
    total=RUNS,
    request_hash="hash",
    created_at=datetime(2026, 11, 21, 12, tzinfo=UTC),
)


def rows(prefix: str = "key", shared: int = 0) -> list[JobRun]:
    """The batch's runs; the last `shared` have the key of the first."""
    keys = [f"{prefix}-{number if number < RUNS - shared else 0}" for number in range(RUNS)]
    return [
        JobRun(number, orjson.dumps({"road.seed": number // 2}).decode(), ("lv", "passive")[number % 2], key)
        for number, key in enumerate(keys)
    ]


def computed(*keys: str, status: str = "ok") -> list[Outcome]:
    summary: dict[str, Any] = {"metrics": {}} if status == "ok" else {"reason": "too steep", "kind": "refused"}
    json = orjson.dumps(summary)
    return [Outcome(key=key, strategy="lv", status=status, json=json, compute_ms=1.0) for key in keys]


def purge(store: Store) -> None:
    """Delete the rows of deleted jobs."""
    while store.jobs.purge():
        pass


@pytest.fixture
def batch(store: Store) -> StoredJob:
    return store.jobs.create(BATCH, rows(shared=2), "once")[0]


def test_an_idempotency_key_has_one_batch_however_many_ask_at_once(store: Store) -> None:
    def create(number: int) -> tuple[StoredJob, bool]:
        return store.jobs.create(replace(BATCH, id=str(number)), rows(), "once")

    with ThreadPoolExecutor(6) as threads:
        answers = list(threads.map(create, range(6)))
    assert len({batch.id for batch, _ in answers}) == 1
    assert [new for _, new in answers].count(True) == 1
    existing = there(store.jobs.by_idempotency_key("sweep", "once"))
    assert existing.id == answers[0][0].id
    assert len(store.jobs.page("sweep", 10)[0]) == 1
    assert store.job_runs.rows(existing.id, -1, 100), "with its runs"
    # Batches without a key never meet.
    assert all(store.jobs.create(replace(BATCH, id=name), rows(), None)[1] for name in "xyz")


def test_a_batch_is_done_when_nothing_waits_and_not_before(store: Store, batch: StoredJob) -> None:
    """Its runs wait page by page until their result is there."""
    assert store.jobs.unfinished() == [replace(BATCH, sweep=None)]
    store.jobs.start(batch.id)
    assert [run.position for run in store.job_runs.waiting(batch.id, range(5))] == [0, 1, 2, 3, 4]
    store.job_runs.save(batch.id, computed("key-0", "key-2"), "1")
    waiting = store.job_runs.waiting(batch.id, range(100))
    assert [run.position for run in waiting] == [1, 3, 4, 5, 6, 7, 8, 9], "two runs shared key-0"
    now = there(store.jobs.load(batch.id))
    assert (now.done, now.failed, store.jobs.finish(batch.id)) == (4, 0, False)
    store.job_runs.save(batch.id, computed(*(run.key for run in waiting)), "1")
    assert store.jobs.finish(batch.id) is True
    now = there(store.jobs.load(batch.id))
    assert (now.state, now.done, store.jobs.unfinished()) == ("done", RUNS, [])
    assert now.finished_at is not None
    store.jobs.cancel(batch.id)
    assert store.jobs.load(batch.id) == now, "too late"
    states = [orjson.loads(event.data)["state"] for event in store.job_events.of(batch.id, 0) if event.kind == "state"]
    assert states == ["queued", "running", "done"]


def test_what_is_saved_twice_counts_once(store: Store, batch: StoredJob) -> None:
    with ThreadPoolExecutor(4) as threads:
        jobs = [
            threads.submit(store.job_runs.save, batch.id, computed("key-0", "key-1", "key-2"), "1") for _ in range(8)
        ]
        saved = sorted(job.result() for job in jobs)
    assert saved == [*[(set(), 0)] * 7, ({"key-0", "key-1", "key-2"}, 0)], "the one that stored them may count them"
    now = there(store.jobs.load(batch.id))
    assert (now.done, now.failed) == (5, 0)
    numbers = [event.number for event in store.job_events.of(batch.id, 0)]
    assert numbers == list(range(1, len(numbers) + 1))


def test_a_run_that_failed_stays_without_the_result_that_another_batch_gets(store: Store, batch: StoredJob) -> None:
    store.job_runs.save(batch.id, [], "1", {1: "It took too long"})
    other, _ = store.jobs.create(replace(BATCH, id="other"), rows(), None)
    store.job_runs.save(other.id, computed("key-1"), "1")
    row = store.job_runs.rows(batch.id, 0, 1)[0]
    assert (row.status, row.reason, row.summary) == ("failed", "It took too long", None)
    assert (row.core_version, row.compute_ms) == (None, None)


def test_a_cancelled_batch_keeps_what_it_has_and_takes_no_more_until_it_is_resumed(
    store: Store, batch: StoredJob
) -> None:
    store.job_runs.save(batch.id, computed("key-0"), "1")
    store.jobs.cancel(batch.id)
    before, events = store.job_runs.rows(batch.id, -1, 100), store.job_events.of(batch.id, 0)
    store.job_runs.save(batch.id, computed("key-1"), "1", {2: "late"})
    assert store.job_runs.rows(batch.id, -1, 100) == before
    assert store.job_events.of(batch.id, 0) == events
    assert [row.status for row in before].count("ok") == 3
    assert [row.status for row in before].count("cancelled") == RUNS - 3
    assert store.jobs.by_idempotency_key("sweep", "once") is None
    again, new = store.jobs.create(replace(BATCH, id="again"), rows("other"), "once")
    assert (new, store.jobs.by_idempotency_key("sweep", "once")) == (True, again)
    store.jobs.resume(batch.id)
    now = there(store.jobs.load(batch.id))
    assert (now.state, now.done, now.finished_at) == ("queued", 3, None)
    assert len(store.job_runs.waiting(batch.id, range(RUNS))) == RUNS - 3


def test_a_run_gets_its_key_when_it_is_handed_out_and_what_is_stored_is_not(store: Store, batch: StoredJob) -> None:
    def handed_out(*runs: JobRun) -> list[int]:
        return [run.position for run in store.job_runs.hand_out(batch.id, runs)]

    waiting = store.job_runs.waiting(batch.id, range(RUNS))
    assert handed_out(*waiting) == [], "it is queued"
    store.jobs.start(batch.id)
    assert handed_out(*waiting) == list(range(RUNS))
    store.job_runs.save(batch.id, computed("key-0"), "1")
    other, _ = store.jobs.create(replace(BATCH, id="other"), rows())
    store.job_runs.save(other.id, computed("key-new"), "2")
    keyed = [waiting[0]._replace(key="late"), waiting[1]._replace(key="key-new"), waiting[2]._replace(key="newer")]
    assert handed_out(*keyed, waiting[3]._replace(key="", reason="No such shape any more")) == [0, 2]
    stored = store.job_runs.rows(batch.id, -1, 4)
    assert [row.status for row in stored] == ["ok", "ok", "waiting", "failed"]
    assert [row.core_version for row in stored] == ["1", "2", None, None]
    assert stored[3].reason == "No such shape any more"
    assert [run.key for run in store.job_runs.waiting(batch.id, [1, 2])] == ["newer"]


def test_planning_adds_runs_in_pieces_begins_anew_and_stops_where_the_job_was_cancelled(store: Store) -> None:
    unplanned = replace(BATCH, state="planning", total=0, estimated_cost=UNPLANNED)
    job, _ = store.jobs.create(unplanned, (), "once")
    runs = [run._replace(key="") for run in rows()]
    for piece in (runs[:6], runs[6:9], runs[:5], runs[5:]):  # the first planning was interrupted
        assert store.jobs.add_planned(job.id, piece)
    store.jobs.end_planning(job.id, total=RUNS, failed=0, estimated_cost=1.5)
    now = there(store.jobs.load(job.id))
    assert (now.state, now.total, now.is_planned) == ("queued", RUNS, True)
    assert len(store.job_runs.rows(job.id, -1, 100)) == RUNS
    assert not store.jobs.add_planned(job.id, runs), "it is planned"
    other, _ = store.jobs.create(replace(unplanned, id="other"), ())
    store.jobs.cancel(other.id)
    assert not store.jobs.add_planned(other.id, runs)
    store.jobs.end_planning(other.id, total=RUNS)
    assert there(store.jobs.load(other.id)).state == "cancelled"
    store.jobs.resume(other.id)
    assert there(store.jobs.load(other.id)).state == "planning"


def test_pages_are_the_newest_first_and_hold_each_once(store: Store) -> None:
    """Also those of one moment; what a job submitted is not listed."""
    for number in range(9):
        created_at = BATCH.created_at + timedelta(hours=number // 3)
        store.jobs.create(replace(BATCH, id=f"{number:02}", created_at=created_at))
    store.jobs.create(replace(BATCH, id="child", parent_id="00"))
    listed, cursor = store.jobs.page("sweep", 2)
    while cursor is not None:
        page, cursor = store.jobs.page("sweep", 2, cursor)
        listed += page
    assert [job.id for job in listed] == [f"{number:02}" for number in range(8, -1, -1)]
    assert {job.sweep for job in listed} == {None}, "an item of a list is small"


def test_what_has_ended_is_deleted_with_its_children_unless_a_link_shows_it(
    store: Store, batch: StoredJob, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is gone at once, and its rows go piece by piece."""
    store.jobs.create(replace(BATCH, id="child", parent_id=batch.id), rows("child"), None)
    store.job_runs.save(batch.id, computed("key-0"), "1")
    assert not store.jobs.delete(batch.id), "it runs"
    store.jobs.cancel(batch.id)
    child = there(store.jobs.load("child"))
    assert child.state == "cancelled", "nobody waits for it"
    link = StoredLink(slug="s" * 22, kind="batch", target=batch.id, view={})
    store.links.save(link, {})
    assert not store.jobs.delete(batch.id), "a link shows it"
    with store.writing() as connection:
        connection.execute(links.delete())
    monkeypatch.setattr(jobs, "PURGED", 5)
    assert store.jobs.delete(batch.id)
    assert store.jobs.load(batch.id) is None
    assert store.jobs.load("child") is None
    assert store.jobs.page("sweep", 9) == ([], None)
    assert store.jobs.create(replace(BATCH, id="again"), [], "once")[1], "its key is free"
    left = []
    while store.jobs.purge():
        left.append(len(store.job_runs.rows(batch.id, -1, 99)))
    assert left[0] == RUNS - 5, "SQLite lets nobody else write meanwhile, and a job may have 100,000 rows"
    assert left[-1] == len(store.job_events.of(batch.id, 0)) == 0
    assert "key-0" in store.runs.load_results(["key-0"]), "others may share a result"


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
    created_at=BATCH.created_at,
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
def tuning(store: Store) -> StoredJob:
    return store.jobs.create(TUNING, idempotency_key="once")[0]


def now(store: Store) -> StoredJob:
    return there(store.jobs.load(TUNING.id))


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
    events = [(event.number, event.kind) for event in store.job_events.of(TUNING.id, 0)]
    assert events == [(1, "state"), (2, "progress"), (3, "state"), (4, "progress")]


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
