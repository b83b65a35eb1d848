"""A job as it is stored."""

from dataclasses import dataclass, field
from datetime import datetime
from typing import Literal

from backend import digest
from backend.db.columns import UNSTORED
from backend.json_types import JsonObject
from backend.store.roads import measured_roads, swept_roads
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import SCHEMA_VERSION
from sim_core.scenario.versions import upgraded

State = Literal["planning", "queued", "running", "done", "cancelled", "failed"]
WAITING = ("planning", "queued")
UNFINISHED = (*WAITING, "running")
FINAL = ("done", "cancelled", "failed")
UNPLANNED = -1.0  # the estimated cost of a job that is not planned yet: the column takes no null


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredJob:
    """A job as it stands.

    Attributes:
        id: Names it for ever.
        kind: Which kind of job.
        parent_id: The job that submitted it; None where a user did.
        label: A user's name for it.
        owner: The name of the token that submitted it; None without tokens.
        state: Where it is.
        reason: Why it failed, or does not advance.
        core_version: That accepted it, or of a tuning computes it; of a sweep each run names its own.
        schema_version: Of the scenario in the request.
        request: What was asked, defaults written out.
        sweep: The points of a sweep, as they were sent; None where they were not loaded.
        progress: What the kind keeps of how far it is; `problem` where planning failed.
        answer: The kind's result, once it is done.
        estimated_cost: Estimate [s of one core]; `UNPLANNED` until it is planned.
        total: Runs (0 until it is planned), or trials of a tuning.
        done: How many of them succeeded.
        failed: How many did not.
        request_hash: Of the request as it was accepted.
        created_at: When it was accepted.
        started_at: When it began.
        finished_at: When it ended.
    """

    id: str = field(default_factory=digest.random_id)
    kind: str
    parent_id: str | None = None
    label: str | None = None
    owner: str | None = None
    state: State = "queued"
    reason: str | None = None
    core_version: str = CORE_VERSION
    schema_version: int = SCHEMA_VERSION
    request: JsonObject
    sweep: JsonObject | None = None
    progress: JsonObject = field(default_factory=dict)
    answer: JsonObject | None = None
    estimated_cost: float = UNPLANNED
    total: int = 0
    done: int = 0
    failed: int = 0
    request_hash: str
    created_at: datetime = UNSTORED
    started_at: datetime | None = None
    finished_at: datetime | None = None

    @property
    def is_planned(self) -> bool:
        """Check whether its size and its cost are known."""
        return self.estimated_cost != UNPLANNED

    @property
    def scenario(self) -> JsonObject:
        """The request's as today's schema has it; as it was stored where a newer version of the service did that."""
        return upgraded(self.request["scenario"], min(self.schema_version, SCHEMA_VERSION))

    @property
    def road_ids(self) -> set[str]:
        """Return the ids of the measured roads that its request and its sweep name."""
        return measured_roads(self.request["scenario"]) | swept_roads(self.sweep or {})

    @property
    def open_runs(self) -> int:
        """Count those that have not ended; none of a job that is taken step by step, whose runs are other jobs'."""
        return 0 if "step" in self.progress else self.total - self.done - self.failed
