"""The runs of a job: without a result, and stored with it. Workers import this, so it imports little."""

import pickle
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

RUNS_PACKED = 1000  # together


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
        self._pages = [pickle.dumps(runs[first : first + RUNS_PACKED]) for first in range(0, len(runs), RUNS_PACKED)]

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
