"""The runs of a job: waiting, in a chunk, stored with their results. Workers import this, so it imports little."""

import pickle
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

from backend.json_types import JsonObject
from backend.outcome import Outcome
from sim_core.scenario.measured import MeasuredRoad

PAGE = 1000  # runs
Computed = Literal["sweep", "reproduction"]  # kinds of jobs whose runs are computed in chunks


class JobRun(NamedTuple):
    """A run of a job without a result.

    Attributes:
        position: In the job.
        changes: JSON text: field -> value.
        strategy: Its id; of a reproduction the row's name.
        key: Of its result; empty where it has failed when it was planned.
        reason: Why it has.
    """

    position: int
    changes: str
    strategy: str
    key: str
    reason: str | None = None

    def row(self, job_id: str) -> dict[str, object]:
        """Its row in the table of runs."""
        return {
            "job_id": job_id,
            "position": self.position,
            "changes": self.changes,
            "strategy": self.strategy,
            "status": "waiting" if self.key else "failed",
            "result_key": self.key or None,
            "reason": self.reason,
        }


class PackedRuns:
    """The runs of a new job on their way from a worker to the database, unpacked some at a time.

    As objects those of a large batch would hold up the service's other threads.
    """

    def __init__(self, runs: Sequence[JobRun]) -> None:
        self._pages = [pickle.dumps(runs[first : first + PAGE]) for first in range(0, len(runs), PAGE)]

    def __iter__(self) -> Iterator[JobRun]:
        for page in self._pages:
            yield from pickle.loads(page)  # noqa: S301 - our own worker's


@dataclass(frozen=True, slots=True, kw_only=True)
class JobRow:
    """A run of a sweep with its stored result (`summary` is JSON text)."""

    position: int
    changes: str
    strategy: str
    status: str
    reason: str | None
    core_version: str | None
    summary: str | None
    compute_ms: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Chunk:
    """Runs of one job that one process computes together.

    Attributes:
        kind: Of the job: what its runs compute.
        group: Chunks of one group are stopped together; a job that is resumed gets another one.
        core_version: Of the service that asks; results of another would be stored under a wrong key.
        schema_version: Of the base.
        base: The job's plain scenario.
        runs: What to compute.
        roads: The measured roads that base and runs name, by id.
        budget: After so long no further run of it is begun [s].
        timeout: The whole chunk may take so long [s].
        priority: Those of the highest come first.
    """

    kind: Computed
    group: str
    core_version: str
    schema_version: int
    base: JsonObject
    runs: Sequence[JobRun]
    roads: Mapping[str, MeasuredRoad]
    budget: float
    timeout: float
    priority: int = 0


Trouble = Literal["lost", "busy", "timeout", "misfit", "bug"]


class ClusterLostError(Exception):
    """The chunk was not computed because the cluster, or a part of it, went away; it may be sent again."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ChunkOutcome:
    """The results of a chunk, or why there are none.

    Attributes:
        computed: Its results, perhaps of a part only; None where it got none.
        trouble: Why: its process died, and the one that tried again (`lost`); no process came up (`busy`); it took
            too long (`timeout`); the worker cannot serve, and `detail` says why (`misfit`); an unforeseen exception
            (`bug`).
        detail: More, for the log.
    """

    computed: list[Outcome] | None = None
    trouble: Trouble | None = None
    detail: str = ""
