"""The cost of a run: bounds that hold, an estimate that grows with the work, and an end where it is too much."""

import pickle
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from backend.compute.fair_queue import SHORT
from backend.cost import affordable
from backend.cost import estimate as cost
from backend.cost.estimate import (
    check_affordable,
    cost_of,
    duration,
    estimate,
    limited_share,
    memory,
    references,
)
from backend.ecu import program, report
from backend.runs import bands, exports
from sim_core import STRATEGIES, PredictiveController, simulate
from sim_core.control import qp
from sim_core.errors import TooExpensiveError
from sim_core.scenario import Actuator, Brake, Bump, Estimation, Mpc, Road, Scenario, Speed, Vehicle
from sim_core.strategies import REFERENCE_STRATEGIES
from tests.results import event

AT_LIMITS = Scenario(road=Road(bump=Bump(height=0.14)), mpc=Mpc(solver="osqp", deflection_limit=0.03, force_limit=1500))
ENDLESS = Scenario(
    road=Road(length=3000),
    speed=Speed(initial_speed_kmh=20),
    mpc=Mpc(sample_time=0.002, prediction_horizon=200, control_horizon=100),
)
EXPORT = exports.Export(
    strategies=["lv"], signals=["time"], points=None, file_format="csv", encoding="list", core_version="", sources={}
)


@pytest.mark.parametrize("strategy", ["speed_only", "passive"])
@pytest.mark.parametrize(
    "scenario",
    [
        Scenario(),
        Scenario(road=Road(length=400), speed=Speed(initial_speed_kmh=20, target_speed_kmh=10)),
        Scenario(road=Road(bump=Bump(start=10)), speed=Speed(target_speed_kmh=80)),  # nothing to brake for
        Scenario(
            road=Road(length=130, bump=Bump(start=30, width=0.3)),
            speed=Speed(initial_speed_kmh=40, target_speed_kmh=10, detection_distance=20),
            brake=Brake(maximum_deceleration=8, pressure_lag=0.4),  # what they still hold takes the car below the band
        ),
    ],
)
def test_the_time_of_a_drive_is_known_beforehand(scenario: Scenario, strategy: str) -> None:
    assert simulate(scenario, strategy).travel_time == pytest.approx(duration(scenario, strategy), abs=0.02)


@pytest.mark.parametrize(
    ("strategy", "part"),
    [
        ("lv", {"mpc": Mpc(force_limit=800)}),
        ("lv", {"mpc": Mpc(deflection_limit=0.02)}),
        ("lv", {"mpc": Mpc(force_limit=800, preview="none")}),
        ("lv", {"mpc": Mpc(force_limit=800), "vehicle": Vehicle(front_damping=600, rear_damping=600)}),
        ("lv", {"mpc": Mpc(force_limit=800), "estimation": Estimation(kind="kalman")}),
        ("lv", {"road": Road(bump=Bump(height=0.16))}),
        ("suspension_only", {"actuator": Actuator(saturation=500)}),
        ("suspension_only", {"road": Road(roughness=256e-6)}),
        ("lqr", {"actuator": Actuator(saturation=500)}),
    ],
)
def test_limits_bind_about_as_often_as_expected(strategy: str, part: dict[str, Any]) -> None:
    """The estimate's promise is the scale: a factor of 3, where shares lie between 0.05 and 0.7."""
    scenario = Scenario(**part)
    result = simulate(scenario, strategy)
    counted = event(result, "limited_steps") * scenario.mpc.sample_time / result.travel_time
    assert 0.05 < counted < 0.7
    expected = limited_share(scenario, STRATEGIES[strategy], result.travel_time)
    assert counted / 3 < expected < counted * 3


def test_estimate_grows_with_what_costs() -> None:
    plain = estimate(Scenario(), "lv")
    assert estimate(Scenario(road=Road(length=1500)), "lv") > 3 * plain
    assert estimate(Scenario(mpc=Mpc(prediction_horizon=120)), "lv") > 2 * plain
    assert estimate(Scenario(mpc=Mpc(solver="osqp")), "lv") > 3 * plain
    assert estimate(AT_LIMITS, "lv") > estimate(Scenario(mpc=Mpc(solver="osqp")), "lv")
    assert estimate(Scenario(), "passive") < plain
    walk = Scenario(road=Road(length=3000), speed=Speed(initial_speed_kmh=5, target_speed_kmh=5))
    assert estimate(walk, "passive") > SHORT, "no short task: its arrays outgrow the processor's cache"


def test_a_recording_leaves_room_for_other_strategies_whatever_its_controllers_cost() -> None:
    """On the longest road, in the shortest steps, with the longest horizons; the ECU's drive is no reference."""
    most = Mpc(prediction_horizon=100, control_horizon=10, sample_time=0.002)
    long, short = Scenario(road=Road(length=3000), mpc=most), Scenario()
    hard = AT_LIMITS.model_copy(update={"road": Road(length=3000)})
    recorded = f"recording:{'A' * 22}"
    assert estimate(short, recorded) < 1.2
    assert estimate(long, recorded) < 20
    assert estimate(long, recorded) - cost_of(long, references(long)) > 5 * estimate(short, recorded)
    assert references(short) == REFERENCE_STRATEGIES
    assert "lv_hil" not in REFERENCE_STRATEGIES
    assert "suspension_only" in set(REFERENCE_STRATEGIES) - set(references(hard))


@pytest.mark.parametrize("strategy", STRATEGIES)
def test_a_run_with_too_many_steps_ends_before_it_begins(strategy: str) -> None:
    if strategy in ("lv", "suspension_only", "lv_hil"):
        with pytest.raises(TooExpensiveError) as refused:
            affordable.simulate(ENDLESS, strategy)
        assert "road.length" in refused.value.fields
        assert all(field in refused.value.message for field in refused.value.fields)
    else:
        assert estimate(ENDLESS, strategy) < 1


@pytest.mark.parametrize(
    "compute",
    [
        lambda path: report.report(ENDLESS),
        lambda path: program.driven(ENDLESS, path),
        lambda path: exports.render(ENDLESS, EXPORT, None),
        lambda path: bands.drive([ENDLESS], "lv", (path, 0), path),
    ],
    ids=["controller report", "own program", "export", "series over roads"],
)
def test_all_that_simulates_refuses_it(compute: Callable[[Path], object], tmp_path: Path) -> None:
    """Runs, solve and links: `compute_run`; batches, tunings, robustness and the paper: `compute_chunk`; below."""
    with pytest.raises(TooExpensiveError):
        compute(tmp_path / "file")


@pytest.mark.parametrize(
    ("solver", "effort"), [pytest.param("osqp", 0.05, marks=pytest.mark.thorough), ("daqp", 0.002)]
)
def test_a_run_whose_qps_take_too_much_ends_at_the_same_qp_each_time(
    solver: str, effort: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    scenario = AT_LIMITS.model_copy(update={"mpc": AT_LIMITS.mpc.model_copy(update={"solver": solver})})
    whole = event(simulate(scenario, "lv"), "qp_solves")
    monkeypatch.setattr(qp, "MAX_EFFORT", effort)
    solved = []
    end = PredictiveController.end

    def counting(controller: PredictiveController) -> None:
        end(controller)
        solved.append(controller.report.solves)

    monkeypatch.setattr(PredictiveController, "end", counting)
    for _ in range(2):
        with pytest.raises(TooExpensiveError) as refused:
            simulate(scenario, "lv")
    assert 1 < solved[0] == solved[1] < whole
    assert refused.value.fields[0] == ("mpc.solver" if solver == "osqp" else "mpc.control_horizon")
    sent = pickle.loads(pickle.dumps(refused.value))  # noqa: S301 - our own, as between processes
    assert (sent.message, sent.fields) == (refused.value.message, refused.value.fields)


WALK: dict[str, Any] = {"initial_speed_kmh": 5.0, "target_speed_kmh": 5.0}
MEASURE = """
import pathlib, re, sys
from sim_core.scenario import Scenario
from sim_core.simulate import simulate

def most():
    return 1024 * int(re.search(r"VmHWM:\\s+(\\d+)", pathlib.Path("/proc/self/status").read_text())[1])

scenario = Scenario.model_validate_json(sys.argv[1])
simulate(scenario.model_copy(update={"road": scenario.road.model_copy(update={"length": 100})}), sys.argv[2])
before = most()
simulate(scenario, sys.argv[2]).series["front_force"]
print(most() - before)
"""


@pytest.mark.thorough
@pytest.mark.parametrize(
    ("strategy", "mpc", "more"),
    [
        ("passive", Mpc(), {}),
        ("lqr", Mpc(sample_time=0.002), {"estimation": Estimation(kind="kalman")}),
        ("lv", Mpc(prediction_horizon=100, preview="none"), {}),
        ("lv", Mpc(prediction_horizon=100), {"speed": Speed(**WALK, detection_distance=1)}),  # 1.4 m are previewed
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_run_takes_no_more_memory_than_is_estimated(strategy: str, mpc: Mpc, more: dict[str, Any]) -> None:
    """With its time histories, in a process of its own, whose peak the system knows; other runs' caches take 28 MiB."""
    parts: dict[str, Any] = {"road": Road(length=600, bump=Bump(start=60)), "speed": Speed(**WALK), "mpc": mpc}
    scenario = Scenario(**parts | more)
    estimated = memory(scenario, STRATEGIES[strategy], duration(scenario, strategy))
    assert estimated > 8e7, "enough to be told from what any run takes"
    command = [sys.executable, "-c", MEASURE, scenario.model_dump_json(), strategy]
    measured = int(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    assert 0.4 * estimated < measured < 1.05 * estimated + 2e7


def test_a_run_that_takes_too_much_memory_is_refused_and_the_longest_walk_is_not(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    walk = Scenario(road=Road(length=3000), speed=Speed(initial_speed_kmh=5, target_speed_kmh=5))
    check_affordable(walk, "passive")
    monkeypatch.setattr(cost, "MAX_BYTES", 0.95 * cost.MAX_BYTES)
    with pytest.raises(TooExpensiveError):
        check_affordable(walk, "passive")
