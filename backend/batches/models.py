"""The shapes of batch requests and answers."""

from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import ConfigDict, Field

from backend.batches.sweeps import Sweep
from backend.models import Answer, RequestModel, StrategyName
from backend.store.batches import State
from sim_core.scenario import Scenario


class BatchRequest(RequestModel):
    """What to run: each point of the sweep under each strategy."""

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {"strategies": ["lv", "passive"], "sweep": {"grid": {"road.bump.height": [0.05, 0.1]}}},
                {
                    "strategies": ["lqr"],
                    "sweep": {"latin_hypercube": {"ranges": {"speed.target_speed_kmh": [20, 40]}, "samples": 3}},
                },
                {"strategies": ["passive"], "sweep": {"list": [{"road.seed": 2}, {"road.seed": 3}]}, "dry_run": True},
            ]
        }
    )

    scenario: Scenario = Scenario()
    strategies: list[StrategyName] = Field(min_length=1, max_length=32)
    sweep: Sweep
    dry_run: bool = Field(False, description="Only check and estimate: nothing is stored or computed")


class BatchField(Answer):
    """A field the sweep changes."""

    name: str
    title: str
    unit: str


class Batch(Answer):
    """A batch as it stands; `done` runs succeeded, `failed` runs did not and say why in their rows."""

    id: str
    state: State
    reason: str | None = Field(description="Why the batch as a whole failed")
    total: int
    done: int
    failed: int
    core_version: str = Field(description="That accepted it; each row names the one that computed it")
    scenario: dict[str, Any]
    strategies: list[str]
    sweep: dict[str, Any]
    fields: list[BatchField]
    estimated_cost: float = Field(description="Upper estimate [s of one core]")
    created_at: datetime
    started_at: datetime | None
    finished_at: datetime | None


class Estimate(Answer):
    """What a batch would be."""

    points: int
    total: int = Field(description="Runs: points times strategies")
    contradictory: int = Field(description="Runs whose fields contradict each other: they would be failed rows")
    estimated_cost: float = Field(description="Upper estimate, which the limit is held against [s of one core]")
    estimated_seconds: float | None = Field(description="By some runs tried just now [s]; none where trying takes long")


class Batches(Answer):
    """The newest first."""

    batches: list[Batch]


class BatchTable(Answer):
    """A batch's rows column by column."""

    batch: str
    state: State
    units: dict[str, str]
    columns: dict[str, list[float | str | bool | list[float] | None]]


class BatchRow(Answer):
    """A run of a batch; further members are the swept fields by name and, of a run with status ok, its figures."""

    model_config = ConfigDict(json_schema_serialization_defaults_required=False)

    run: int
    strategy: str
    status: Literal["ok", "failed", "waiting", "cancelled"]
    reason: Annotated[str | None, Field(description="Of a failed run")] = None


class BatchResults(Answer):
    """Every run of a batch, in order."""

    batch: str
    core_version: str
    scenario: dict[str, Any]
    sweep: dict[str, Any]
    units: dict[str, str]
    rows: list[BatchRow]
