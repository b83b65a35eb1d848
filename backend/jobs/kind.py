"""What the engine has to know of a kind of job; the kinds stand in the rooms that ask for them."""

from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from prometheus_client import Gauge

from backend.compute.chunk_messages import ComputeRun
from backend.job_run import JobRun
from backend.json_types import JsonObject
from backend.store import StoredJob

# From a plain scenario, its schema version and some runs: the runs with their keys, or with a reason to fail.
RunKeys = Callable[[JsonObject, int, Sequence[JobRun]], list[JobRun]]
AddRuns = Callable[[Sequence[JobRun]], Awaitable[None]]  # stores runs of a job that is being planned, in their order


@dataclass(frozen=True, slots=True, kw_only=True)
class JobSize:
    """What planning finds of a job.

    Attributes:
        total: Runs, or trials.
        failed: Of the runs those that have failed already.
        estimated_cost: Of all [s of one core].
    """

    total: int
    failed: int = 0
    estimated_cost: float


class JobFailedError(Exception):
    """The job cannot go on; the message tells its owner why, and `problem` what a dry run would have answered."""

    def __init__(self, message: str, problem: JsonObject | None = None) -> None:
        super().__init__(message)
        self.problem = problem


@dataclass(frozen=True, slots=True, kw_only=True)
class JobKind:
    """A kind of job: computed run by run (`compute`), or taken step by step (`step`).

    Functions that run in a worker are functions of a module, as they travel by their names.

    Attributes:
        name: As it is stored.
        word: What users call one.
        plural: What they call several.
        size_pointer: What of a request makes a job large.
        run_pointer: What makes one of its runs expensive.
        compute: What a worker computes of each run.
        order: Positions of all its runs in the order in which they are computed; ascending without it.
        plan: Finds a new job's runs and its size. Raises ServiceError where the job cannot be run, and that error is
            what its owner is told; TemporaryError where it can be tried again. Without it a job is accepted as planned.
        keys: Run in a worker as runs are handed out: gives them the keys of their results. Without it they have theirs
            from the start, and a job of another version is deleted: who asked for it asks anew.
        delete_when_done: A job is deleted when all its runs have succeeded: their results are what was asked for.
        step: Takes the next step of a job to its end; the stored state says which it is. Raises JobFailedError where
            the job cannot go on, TemporaryError where it can be tried again.
        gauges: Of its jobs, and of their open runs, by state.
    """

    name: str
    word: str
    plural: str
    size_pointer: str = ""
    run_pointer: str = ""
    compute: ComputeRun | None = None
    order: Callable[[StoredJob], NDArray[np.intp]] | None = None
    plan: Callable[[StoredJob, AddRuns], Awaitable[JobSize]] | None = None
    keys: RunKeys | None = None
    delete_when_done: bool = False
    step: Callable[[StoredJob], Awaitable[None]] | None = None
    gauges: tuple[Gauge, Gauge] | None = None
