"""Frequency responses: against sine roads that are driven, and against python-control."""

from math import pi
from typing import Any

import numpy as np
import pytest

from sim_core import Controller, FloatArray, LinearLaw, Scenario, Seen, Setup
from sim_core.frequency.responses import BANDS, RESPONSES, frequency_response
from sim_core.frequency.sampled_loop import SampledLoop, sampled_loop, stage_law
from sim_core.frequency.stability import least_damping
from sim_core.scenario.measured import MeasuredRoad
from sim_core.simulate import prepare, simulate
from sim_core.vehicle.half_car import half_car
from tests.there import there
from tests.validation.strategies import some

SPEED = 10.0  # [m/s]
FILTER = {"kind": "kalman"}
MISTAKEN = {
    "body_mass": 1.1,
    "preview_gain": 0.9,
    "preview_offset": 0.1,
    "preview_delay": 0.01,
    "preview_resolution": 1.0,
}
NEAR_SIGHTED = {"initial_speed_kmh": 3.6 * SPEED, "policy": "constant", "detection_distance": 1}
CASES: list[tuple[str, dict[str, Any]]] = [
    ("passive", {}),
    ("lqr", {"lqr": {"preview": "lookahead"}}),
    ("lv", {}),
    ("lqr", {"lqr": {"preview": "lookahead"}, "speed": NEAR_SIGHTED}),
    ("lv", {"mpc": {"preview": "wheelbase"}}),
    ("lv", {"mpc": {"preview": "none"}, "actuator": {"bandwidth": 10}}),
    ("lv", {"estimation": FILTER, "mismatch": MISTAKEN}),
    ("lqr", {"estimation": FILTER, "actuator": {"bandwidth": 20}, "lqr": {"preview": "lookahead"}}),
    ("skyhook", {"actuator": {"bandwidth": 15}}),
    ("passive", {"road": {"rear_axle": "together"}}),
    ("lv", {"road": {"rear_axle": "together"}, "estimation": FILTER}),
    ("lqr", {"road": {"rear_axle": "together"}, "lqr": {"preview": "wheelbase"}}),
    ("lv_hil", {"hil": {"bits": 24}}),
    ("lv_hil", {"hil": {"bits": 24, "compensation": "none"}, "mpc": {"preview": "none"}}),
    ("lv_hil", {"hil": {"bits": 24}, "estimation": FILTER}),
]
DRIVEN = [(frequency, *case) for frequency in (5.0, 1.25, 10.0) for case in CASES]


def at_one_speed(**parts: Any) -> Scenario:
    return Scenario.model_validate({"speed": {"initial_speed_kmh": 3.6 * SPEED, "policy": "constant"}, **parts})


@pytest.mark.parametrize(("frequency", "strategy", "parts"), some(len(CASES), DRIVEN))
def test_a_sine_road_gives_the_response(strategy: str, parts: dict[str, Any], frequency: float) -> None:
    """Within 0.5 %, or within 0.1 % of the passive car's response where that is more than five times as large.

    Periods fit control steps and the road's 10 mm; heights are whole micrometres, 0.05 % of 2 mm. The last 4 s of 12 s
    are taken: then no start is left. What the sensors' noise does is the same without the sine, and is taken off.
    """
    length = 120.0
    heights = 0.002 * np.sin(2 * pi * frequency * np.arange(0, length + 0.005, 0.01) / SPEED)
    road = MeasuredRoad.of(heights)
    bump = {"height": 0, "start": 116, "width": 1}
    measured = {"profile": road.id, "length": length, "bump": bump, "roughness": 0.001}
    scenario = at_one_speed(**{**parts, "road": measured | parts.get("road", {})}).on(road)
    result = frequency_response(scenario, strategy, [frequency])
    passive = frequency_response(scenario, "passive", [frequency])
    level = MeasuredRoad.of(0 * heights)
    still = scenario.model_copy(update={"road": scenario.road.model_copy(update={"profile": level.id})}).on(level)
    driven, alone = simulate(scenario, strategy).series, simulate(still, strategy).series
    series = {name: driven[name] - alone[name] for name in driven} | {"time": driven["time"]}
    time, car = series["time"], half_car(scenario.real_vehicle)
    start, fine = int(np.searchsorted(time, 7.0 - 1e-9)), float(time[1] - time[0])
    window = slice(start, start + round(4.0 / fine))
    turn = np.exp(-2j * pi * frequency * time[window])
    forces = np.stack([series["front_force"], series["rear_force"]])
    lagging = "bandwidth" in scenario.actuator.model_fields_set
    # A held force jumps: each of its samples stands for the fine step behind it.
    hold = 1 if lagging else (1 - np.exp(-2j * pi * frequency * fine)) / (2j * pi * frequency * fine)
    road_here = np.mean(series["front_road"][window] * turn)
    for row, name in enumerate(RESPONSES):
        of_forces = car.D[row] @ forces
        smooth = np.mean((series[name] - of_forces)[window] * turn)
        driven_response = (smooth + hold * np.mean(of_forces[window] * turn)) / road_here
        expected = complex(there(result.responses)[name][0])
        scale = max(abs(expected), abs(complex(there(passive.responses)[name][0])) / 5)
        assert abs(driven_response - expected) < 0.005 * scale, name


WEAKLY_DAMPED = [
    ("passive", {"vehicle": {"front_damping": 10, "rear_damping": 10}}),
    ("groundhook", {"vehicle": {"front_damping": 500, "rear_damping": 500}, "hook": {"groundhook_damping": 4000}}),
]


@pytest.mark.parametrize(("strategy", "parts"), WEAKLY_DAMPED)
def test_the_table_of_bands_has_all_of_a_narrow_peak(strategy: str, parts: dict[str, Any]) -> None:
    """Within 1e-6 of the trapezoidal rule in steps of a hundredth of the narrowest peak's width."""
    scenario, (low, high) = at_one_speed(**parts), BANDS[0]
    fine = np.linspace(low, high, 50_001)
    result = frequency_response(scenario, strategy, fine.tolist())
    for name, density in there(result.psd).items():
        rms = np.sqrt(np.trapezoid(density, fine))
        assert there(result.bands)[name][0] == pytest.approx(rms, rel=1e-6), name


def loop_of(strategy: str, **parts: Any) -> SampledLoop:
    run = prepare(at_one_speed(**parts), strategy)
    return sampled_loop(run, stage_law(run, "cruise"), run.scenario.real_vehicle, SPEED)


@pytest.mark.parametrize(("strategy", "parts"), CASES)
def test_modes_are_those_that_decide_stability(strategy: str, parts: dict[str, Any]) -> None:
    scenario = at_one_speed(**parts)
    least, result = least_damping(scenario, strategy), frequency_response(scenario, strategy)
    assert result.modes is not None
    if least is not None and strategy != "lv":  # of LV that is over the stages
        assert min(mode.damping_ratio for mode in result.modes) == pytest.approx(least, rel=1e-6)


@pytest.mark.parametrize(
    ("policy", "stage", "expected"), [("planned", "bump", 5), ("planned", "cruise", 15), ("constant", "bump", 15)]
)
def test_who_brakes_for_the_bump_meets_it_at_the_target_speed(policy: Any, stage: Any, expected: float) -> None:
    scenario = Scenario.model_validate(
        {"speed": {"initial_speed_kmh": 3.6 * 15, "target_speed_kmh": 3.6 * 5, "policy": policy}}
    )
    assert frequency_response(scenario, "lqr", [1.0], stage=stage).speed == pytest.approx(expected)


class Reacts(Controller):
    """Has a force and no linear law."""

    id, label = "reacts", "Reacts"

    def force(self, seen: Seen) -> FloatArray:
        return np.zeros(2)


class Designs(Controller):
    """Designs every stage before the run, and drives all with one's law."""

    id, label = "designs", "Designs"

    def start(self, setup: Setup) -> None:
        self._laws = {stage: LinearLaw(gain=np.zeros((2, 10))) for stage in setup.stages}

    def linear_law(self, stage: str) -> LinearLaw:
        return self._laws["cruise"]


def test_a_law_of_ones_own_is_given_every_stage_whichever_is_asked() -> None:
    assert frequency_response(at_one_speed(), Designs, stage="bump").responses is not None


@pytest.mark.parametrize(
    ("strategy", "parts", "why"),
    [
        (Reacts, {}, "no linear law in stage cruise: its method linear_law has to return one"),
        ("skyhook", {"hook": {"semi_active": True}}, "semi-active"),
        ("lqr", {"mismatch": {"rebound_ratio": 2}}, "unequal dampers"),
        ("passive", {"vehicle": {"bump_stop_clearance": 0.05}}, "bump stops"),
        ("lv_hil", {"hil": {"jitter": 0.005}}, "jitter"),
        ("lqr", {"mismatch": {"damping": 0.1}, "actuator": {"bandwidth": 2}}, "unstable"),
    ],
)
def test_what_is_not_linear_has_no_response_and_says_why(
    strategy: str | type[Controller], parts: dict[str, Any], why: str
) -> None:
    result = frequency_response(at_one_speed(**parts), strategy)
    assert result.responses is None
    assert result.margins is None
    assert why in there(result.reason)
