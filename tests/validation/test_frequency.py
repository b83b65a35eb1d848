"""Frequency responses: against sine roads that are driven, against python-control, and against what margins promise."""

from math import pi
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.signal import cont2discrete, zpk2ss

from sim_core import Controller, FloatArray, LinearLaw, Scenario, Seen, Setup
from sim_core.frequency.margins import margins, transfer
from sim_core.frequency.responses import BANDS, RESPONSES, _modes, frequency_response
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
CASES: list[tuple[str, dict[str, Any]]] = [
    ("passive", {}),
    ("lqr", {"lqr": {"preview": "lookahead"}}),
    ("lv", {}),
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


SWEPT = [
    ("passive", {}),
    ("lqr", {"lqr": {"preview": "lookahead"}}),
    ("lv", {}),
    ("skyhook", {"actuator": {"bandwidth": 15}}),
]


@pytest.mark.parametrize(("strategy", "parts"), SWEPT)
def test_a_swept_sine_gives_the_table_of_bands(strategy: str, parts: dict[str, Any]) -> None:
    """Within 0.5 %: the responses that a sweep from 0.5 to 16 Hz measures, over the road's density in each band.

    Before and behind the sweep the road is level, so a signal's spectrum over the road's is the response. As above,
    heights are whole micrometres, and each sample of a held force stands for the fine step behind it.
    """
    length, before, duration, low, high = 500.0, 2.0, 44.0, 0.5, 16.0
    time = np.clip(np.arange(0, length + 0.005, 0.01) / SPEED - before, 0, duration)
    sweep = np.sin(2 * pi * (low * time + (high - low) * time**2 / (2 * duration)))
    road = MeasuredRoad.of(0.004 * sweep * np.sin(pi * time / duration) ** 0.5)
    scenario = at_one_speed(road={"roughness": 1e-3}, **parts)
    bump = {"height": 0, "start": 496, "width": 1}
    swept = at_one_speed(road={"profile": road.id, "length": length, "bump": bump, "roughness": 1e-3}, **parts).on(road)
    table, series, car = (
        frequency_response(scenario, strategy),
        simulate(swept, strategy).series,
        half_car(swept.vehicle),
    )
    fine = float(series["time"][1] - series["time"][0])
    samples = round(100 / fine)  # with nothing behind the drive: a spectrum in steps of 0.01 Hz
    frequency = np.fft.rfftfreq(samples, fine)
    omega = 2j * pi * np.maximum(frequency, 1e-9)
    hold = 1 if "actuator" in parts else (1 - np.exp(-omega * fine)) / (omega * fine)
    forces = np.stack([series["front_force"], series["rear_force"]])
    road_here = np.fft.rfft(series["front_road"], samples)
    for row, name in enumerate(RESPONSES):
        of_forces = car.D[row] @ forces
        measured = np.fft.rfft(series[name] - of_forces, samples) + hold * np.fft.rfft(of_forces, samples)
        for band, (first, last) in enumerate(BANDS):
            inside = slice(round(100 * first), round(100 * last) + 1)
            density = 1e-3 * 0.1**2 / ((frequency[inside] / SPEED) ** 2 + 0.011**2) / SPEED  # ISO 8608, cut off
            power = np.abs(measured[inside] / road_here[inside]) ** 2 * density
            rms = np.sqrt(np.trapezoid(power, dx=0.01))
            assert rms == pytest.approx(there(table.bands)[name][band], rel=0.005), (name, first, last)


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


@pytest.mark.parametrize(("strategy", "parts"), CASES[1:])
def test_python_control_has_the_same_loop(strategy: str, parts: dict[str, Any]) -> None:
    """1e-9 of the greatest gain: both solve the same equations in double precision."""
    control = pytest.importorskip("control", reason="make development installs it")
    loop = loop_of(strategy, **parts)
    broken = control.ss(loop.A + loop.C @ loop.K, loop.B, loop.K, np.zeros((2, 2)), loop.step)
    omega = 2 * pi * np.geomspace(0.1, 45, 50)
    theirs = np.moveaxis(control.frequency_response(broken, omega).complex, 2, 0)
    np.testing.assert_allclose(transfer(loop, omega), theirs, atol=1e-9 * np.abs(theirs).max())


@pytest.mark.parametrize("strategy", ["lqr", "skyhook", "passive"])
def test_python_control_has_the_same_responses(strategy: str) -> None:
    """1e-9 of the greatest: its own sampling of the car, its own responses, no loop of ours but the law."""
    control = pytest.importorskip("control", reason="make development installs it")
    scenario, frequencies = at_one_speed(), np.geomspace(0.5, 30, 40)
    loop, car, omega = loop_of(strategy), half_car(scenario.vehicle), 2 * pi * frequencies
    nothing = np.zeros((8, 2))
    forces = control.ss(car.A, car.B, np.eye(8), nothing)
    road = control.frequency_response(control.ss(car.A, car.E[:, :2], np.eye(8), nothing), omega).complex
    held = control.frequency_response(control.sample_system(forces, loop.step, "zoh"), omega).complex
    freely = control.frequency_response(forces, omega).complex
    ours = there(frequency_response(scenario, strategy, frequencies.tolist()).responses)
    theirs = []
    for i, w in enumerate(1j * omega):
        without = road[:, :, i] @ (w * np.array([1, np.exp(-w * scenario.vehicle.wheelbase / SPEED)]))
        gain = loop.law.gain[:, :8]
        command = gain @ np.linalg.solve(np.eye(8) - held[:, :, i] @ gain, without)
        acting = command * (1 - np.exp(-w * loop.step)) / (w * loop.step)
        theirs.append(car.C @ (without + freely[:, :, i] @ acting) + car.D @ acting)
    for row, name in enumerate(RESPONSES):
        expected = np.array(theirs)[:, row]
        np.testing.assert_allclose(ours[name], expected, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize(("strategy", "parts"), CASES[1:])
def test_the_disk_margin_is_where_a_worst_change_of_both_loops_meets_instability(
    strategy: str, parts: dict[str, Any]
) -> None:
    """Within it none of many random changes of both gains makes the loop unstable; at a loop's own margin one does."""
    loop = loop_of(strategy, **parts)
    judged, generator = margins(loop), np.random.default_rng(1)
    inside = np.exp(generator.uniform(-1, 1, (200, 2)) * np.log(0.999 * min(judged.disk_gain, 100.0)))
    assert max(largest(loop, change) for change in inside) < 1
    for axle, one in enumerate((judged.front, judged.rear)):
        for bound in (one.gain, one.gain_reduction):
            if bound is not None:
                assert max(bound, 1 / bound) >= judged.disk_gain
                assert largest(loop, on_axle(axle, bound**0.999)) < 1 < largest(loop, on_axle(axle, bound**1.001))
        if one.phase is not None:
            assert one.phase >= judged.disk_phase
            within, beyond = (
                max(largest(loop, on_axle(axle, np.exp(sign * 1j * share * one.phase))) for sign in (-1, 1))
                for share in (0.999, 1.001)
            )
            assert within < 1 < beyond


@pytest.mark.parametrize(
    ("policy", "stage", "expected"), [("planned", "bump", 5), ("planned", "cruise", 15), ("constant", "bump", 15)]
)
def test_who_brakes_for_the_bump_meets_it_at_the_target_speed(policy: Any, stage: Any, expected: float) -> None:
    scenario = Scenario.model_validate(
        {"speed": {"initial_speed_kmh": 3.6 * 15, "target_speed_kmh": 3.6 * 5, "policy": policy}}
    )
    assert frequency_response(scenario, "lqr", [1.0], stage=stage).speed == pytest.approx(expected)


def test_a_slow_pair_of_poles_is_a_mode_and_an_integrator_is_none() -> None:
    (mode,) = _modes(np.array([0, -0.3 + 0.4j, -0.3 - 0.4j]))
    assert (mode.natural_frequency, mode.damping_ratio) == pytest.approx((0.5 / (2 * pi), 0.6))


def test_of_two_smaller_gains_that_meet_instability_the_nearer_one_is_the_margin() -> None:
    """A front loop that is stable with a ten thousandth of its gain too, and not in between."""
    continuous = zpk2ss([-10, -10], [-0.01, -1, -1, -300, -300], 1e7)
    A, B, C, _, step = cont2discrete(continuous, 1e-3)
    nothing = np.zeros((5, 1))
    loop: Any = SimpleNamespace(
        A=A, B=np.hstack([B, nothing]), C=np.zeros((5, 2)), K=-np.vstack([C, nothing.T]), step=step
    )
    bound = there(margins(loop).front.gain_reduction)
    assert [largest(loop, on_axle(0, factor)) < 1 for factor in (1, bound * 1.001, bound / 1.001, 1e-4)] == [
        *(True, True, False, True),
    ]


def test_the_disk_margin_of_two_delayed_gains() -> None:
    """k / z is nearest to -1 at z = -1, where its gain meets instability: the disk's factor is the smaller 1 / k."""
    nothing = np.zeros((2, 2))
    loop: Any = SimpleNamespace(A=nothing, B=np.eye(2), C=nothing, K=-np.diag([0.5, 0.8]), step=1e-3)
    judged = margins(loop)
    assert (judged.front.gain, judged.rear.gain, judged.disk_gain) == pytest.approx((2, 1.25, 1.25))
    assert (judged.disk, judged.disk_phase) == pytest.approx((2 / 9, 2 * np.arctan(1 / 9)))


def on_axle(axle: int, factor: complex) -> Any:
    change = np.ones(2, dtype=np.complex128)
    change[axle] = factor
    return change


def largest(loop: SampledLoop, change: Any) -> float:
    return float(np.abs(np.linalg.eigvals(loop.A + (loop.C + loop.B * change) @ loop.K)).max())


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
