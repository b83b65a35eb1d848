"""The runs of a job: without a result, and stored with it. Workers import this, so it imports little."""

from dataclasses import dataclass
from typing import NamedTuple

UNAVAILABLE_KEY = "-"  # of a run whose strategy is not there now: it can be tried again


class JobRun(NamedTuple):
    """A run of a job without a result.

    Attributes:
        position: In the job.
        changes: JSON text: field -> value.
        strategy: Its id; of a reproduction the row's name.
        key: Of its result, from when it is handed out; empty before that.
        reason: Why it fails without being computed.
    """

    position: int
    changes: str
    strategy: str
    key: str = ""
    reason: str | None = None

    def row(self, job_id: str) -> dict[str, object]:
        """Return its row in the table of runs."""
        return {
            "job_id": job_id,
            "position": self.position,
            "changes": self.changes,
            "strategy": self.strategy,
            "status": "waiting" if self.reason is None else "failed",
            "result_key": self.key or None,
            "reason": self.reason,
        }


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
