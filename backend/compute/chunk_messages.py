"""A chunk of a job's runs on its way to a worker, and what comes back. Workers import this, so it imports little."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

from backend.custom_controllers.registry import ControllerSource
from backend.job_run import JobRun
from backend.json_types import JsonObject
from backend.outcome import Outcome
from sim_core.scenario import Scenario
from sim_core.scenario.measured import MeasuredRoad

ComputeRun = Callable[[Scenario, str, str], Outcome]  # from its scenario, its strategy and its result's key


@dataclass(frozen=True, slots=True, kw_only=True)
class Chunk:
    """Runs of one job that one process computes together.

    Attributes:
        compute: What each run computes; a function of a module, as it travels by its name.
        group: Chunks of one group are stopped together; a job that is resumed gets another one.
        core_version: Of the service that asks; results of another would be stored under a wrong key.
        schema_version: Of the base.
        base: The job's plain scenario.
        runs: What to compute.
        roads: The measured roads that base and runs name, by id.
        budget: After so long no further run of it is begun [s].
        timeout: The whole chunk may take so long [s].
        priority: Those of the highest come first.
        controllers: Those of one's own that there are (`backend.custom_controllers.controller_sources`).
    """

    compute: ComputeRun
    group: str
    core_version: str
    schema_version: int
    base: JsonObject
    runs: Sequence[JobRun]
    roads: Mapping[str, MeasuredRoad]
    budget: float
    timeout: float
    priority: int = 0
    controllers: tuple[ControllerSource, ...] = ()


ChunkError = Literal["lost", "busy", "timeout", "version_mismatch", "bug"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ChunkOutcome:
    """The results of a chunk, or why there are none.

    Attributes:
        computed: Its results, perhaps of a part only; None where it got none.
        error: Why: its process died, and the one that tried again (`lost`); no process came up (`busy`); it took
            too long (`timeout`); the worker cannot serve, and `detail` says why (`version_mismatch`); an unforeseen
            exception (`bug`).
        detail: More, for the log.
    """

    computed: list[Outcome] | None = None
    error: ChunkError | None = None
    detail: str = ""
