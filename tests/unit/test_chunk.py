"""A batch's chunk in the process that computes it."""

import json

import pytest

from backend.compute.chunk_messages import Chunk
from backend.compute.compute_chunk import compute_chunk
from backend.job_run import JobRun
from backend.json_types import JsonObject
from backend.outcome import Outcome
from backend.runs.compute_run import compute
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import Scenario

BASE = Scenario().model_dump(mode="json")


def waiting(*heights: float, strategy: str = "passive") -> list[JobRun]:
    changes = [json.dumps({"road.bump.height": height}) for height in heights]
    return [JobRun(number, text, strategy, text) for number, text in enumerate(changes)]


def computed(runs: list[JobRun], base: JsonObject = BASE) -> list[Outcome]:
    return compute_chunk(
        Chunk(
            compute=compute,
            group="",
            core_version=CORE_VERSION,
            schema_version=1,
            base=base,
            runs=runs,
            roads={},
            budget=60,
            timeout=60,
        )
    )


def test_equal_runs_are_computed_once_and_each_has_its_own_scenario() -> None:
    outcomes = computed(waiting(0.05, 0.05, 0.08))
    assert [run.key for run in outcomes] == [waiting(0.05)[0].key, waiting(0.08)[0].key]
    peaks = [run.summary["metrics"]["bump"]["body_acceleration"]["peak"] for run in outcomes]
    assert peaks[1] == pytest.approx(1.6 * peaks[0], rel=0.2), "the passive car is linear, the road adds a little"


def test_a_run_that_is_too_expensive_is_a_failure_to_be_stored() -> None:
    """As it is of a single run."""
    steps = {"sample_time": 0.002, "prediction_horizon": 200, "control_horizon": 100}
    endless = Scenario.model_validate({"road": {"length": 3000}, "speed": {"initial_speed_kmh": 20}, "mpc": steps})
    (of_batch,) = computed([JobRun(0, "{}", "lv", "key")], endless.model_dump(mode="json"))
    for each in (compute(endless, "lv", "key"), of_batch):
        assert (each.status, each.cacheable, each.summary["kind"]) == ("failed", True, "too-expensive")
        assert each.summary["reason"].endswith(f"; change {' or '.join(each.summary['fields'])}")
