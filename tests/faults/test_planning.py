"""How a job that is planned ends where planning meets trouble."""

import itertools
import sqlite3
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from sqlalchemy.exc import OperationalError

from backend.batches.kind import SWEEP
from backend.errors import WorkerLostError
from backend.job_run import JobRun
from backend.jobs import dispatch
from backend.jobs.kind import AddRuns, JobSize
from backend.store import Store, StoredJob
from sim_core.errors import RidelabError
from sim_core.scenario import Scenario
from tests.faults.test_scheduler import end_of, led
from tests.servers import loops


def planned(folder: Path, trouble: Callable[[], None], *, resumed: bool = False) -> StoredJob:
    """A batch as it ends, perhaps once more after it was resumed; planning it begins with `trouble`."""

    async def plan(_: StoredJob, add: AddRuns) -> JobSize:
        trouble()
        await add([JobRun(0, "{}", "lv")])
        return JobSize(total=1, estimated_cost=1.0)

    async def run() -> StoredJob:
        store = Store(f"sqlite:///{folder}/ridelab.sqlite")
        store.migrate()
        request = {"scenario": Scenario().model_dump(mode="json"), "strategies": ["lv"], "fields": []}
        batch, _ = store.jobs.create(StoredJob(kind="sweep", state="planning", request=request, request_hash=""))
        async with led(store, folder, replace(SWEEP, plan=plan)):
            await end_of(store, batch.id)
            if resumed:
                await store.write(store.jobs.resume, batch.id, progress={})
                await end_of(store, batch.id)
        job = store.jobs.load(batch.id)
        store.close()
        assert job is not None
        return job

    return loops.run(run)


def test_a_batch_that_cannot_be_planned_without_a_controller_says_so(tmp_path: Path) -> None:
    def refuse() -> None:
        raise RidelabError("Unknown strategy mine", field="own.mine")

    job = planned(tmp_path, refuse)
    assert (job.state, job.reason) == ("failed", "Unknown strategy mine")
    problem = job.progress["problem"]
    assert problem["type"].endswith(":refused")
    assert problem["errors"] == [{"pointer": "/scenario/own/mine", "message": "Unknown strategy mine"}]


def test_a_batch_that_is_resumed_after_planning_crashed_outlives_a_database_that_is_away(tmp_path: Path) -> None:
    tries = itertools.count()

    def crash() -> None:
        number = next(tries)
        if number < dispatch.MOST_CRASHES:
            raise WorkerLostError
        if number == dispatch.MOST_CRASHES:
            raise OperationalError("SELECT secret", {}, sqlite3.OperationalError("away"))

    job = planned(tmp_path, crash, resumed=True)
    assert (job.state, job.reason) == ("done", None)
