"""Recordings: placed where they were made, and nowhere else; gravity, signs and offsets in them; what is missing."""

import re
from functools import cache
from math import nan
from typing import Any

import numpy as np
import pytest

from sim_core import STRATEGIES, Bump, Mismatch, RidelabError, Road, Scenario, Speed, StrategyResult, Vehicle, simulate
from sim_core.arrays import FloatArray
from sim_core.catalogue import COMFORT, METRIC_SIGNALS, SIGNALS
from sim_core.errors import RefusedError, TooExpensiveError
from sim_core.recorded.alignment import LARGEST_SCALE_ERROR, find_placement
from sim_core.recorded.offsets import GRAVITY
from sim_core.recorded.result import recorded_result
from sim_core.result import RecordingReport
from sim_core.scenario.presets import preset
from sim_core.scenario.recorded import RecordedDrive
from tests.there import there

SCENARIO = Scenario()
PLACED = ("body_acceleration", "front_deflection")


@cache
def simulated(scenario: Scenario, strategy: str) -> StrategyResult:
    """`simulate`, once for many recordings of one road."""
    return simulate(scenario, strategy)


def recording(
    scenario: Scenario,
    strategy: str = "passive",
    *,
    start: float = 0.0,
    drift: float = 0.0,
    noise: float = 0.0,
    keys: tuple[str, ...] = PLACED,
) -> RecordedDrive:
    """A drive from `start` [s] on, every 4 ms, by a clock of its own that begins at 100 s."""
    series = simulated(scenario, strategy).series
    true = np.arange(start, series["time"][-1], 0.004)
    signals = {key: np.interp(true, series["time"], series[key]) for key in ("speed", *keys)}
    rng = np.random.default_rng(1)
    for key in keys:
        signals[key] += noise * signals[key].std() * rng.normal(size=len(true))
    return RecordedDrive.of({"time": 100 + (true - start) / (1 + drift), **signals})


def judged(drive: RecordedDrive, scenario: Scenario = SCENARIO) -> StrategyResult:
    """Return a recording's result."""
    return recorded_result(scenario, drive, simulated)


def report_of(drive: RecordedDrive, scenario: Scenario = SCENARIO) -> RecordingReport:
    """Return where a recording was placed, and what is said of it."""
    return there(judged(drive, scenario).recording)


def changed(drive: RecordedDrive, **signals: FloatArray) -> RecordedDrive:
    """The recording with other values of some signals."""
    return RecordedDrive.of({**drive.signals(), **signals})


def test_a_clock_that_is_far_off_is_found_on_a_long_road() -> None:
    """A first search that took no scale between none and the largest would see nothing alike at both ends."""
    position = np.arange(0, 400, 0.1)
    road = np.convolve(np.random.default_rng(1).normal(size=len(position)), np.hanning(11), "same")
    distance = np.arange(0, 380, 0.1)
    recorded = np.interp(20 + 0.985 * distance, position, road)
    found = there(find_placement(distance, recorded[None], {"passive": (position, road[None])}, [(1,)]))
    assert found.offset == pytest.approx(20, abs=0.001)
    assert found.scale == pytest.approx(0.985, abs=1e-5)


def test_what_was_not_recorded_has_no_metric() -> None:
    """A gap takes its windows, a missing signal its own metrics, and a part of the road all that reaches beyond."""
    series = simulated(SCENARIO, "passive").series
    acceleration = np.where(np.abs(series["position"] - 30) < 1, np.nan, series["body_acceleration"])
    signals = {"time": series["time"], "position": series["position"], "body_acceleration": acceleration}
    early, result = (
        judged(RecordedDrive.of({key: each[part] for key, each in signals.items()}))
        for part in (series["position"] < SCENARIO.road.bump.start, series["position"] > 20)
    )
    assert (early.events["bump_complete"], result.events["bump_complete"]) == (False, True)
    assert np.isnan(result.metrics["rough_road"]["body_acceleration"]["rms"])
    assert np.isfinite(result.metrics["bump"]["body_acceleration"]["rms"])
    assert np.isnan(result.metrics["bump"]["front_force"]["rms"])
    assert np.isnan(result.comfort["weighted_rms"])
    report = there(result.recording)
    assert set(report.missing) == set(METRIC_SIGNALS) - {"body_acceleration"}
    said = " ".join(report.notes)
    gaps = report_of(RecordedDrive.of(signals)).notes
    assert "Body acceleration has gaps: it has no metrics in Rough road, Whole run" in gaps
    assert all(SIGNALS[key].label.lower() in said for key in report.missing)
    assert "with the whole run those of comfort, events and travel time" in " ".join(there(early.recording).notes)


@pytest.mark.parametrize(("start", "end", "rms"), [(0.5, 149.5, 2.0), (0.51, 149.5, nan), (0.5, 149.49, nan)])
def test_half_a_metre_may_lack_at_either_end_of_the_road(start: float, end: float, rms: float) -> None:
    position = np.array([start, 100.0, end])
    drive = RecordedDrive.of({"time": position, "position": position, "body_acceleration": np.full(3, 2.0)})
    whole = judged(drive).metrics["whole"]
    assert whole["body_acceleration"]["rms"] == pytest.approx(rms, nan_ok=True)


def test_a_drive_without_time_and_speed_has_no_travel_time() -> None:
    """It is placed and judged as if at the initial speed, which says nothing of how long it took."""
    series = simulated(SCENARIO, "passive").series
    result = judged(RecordedDrive.of({key: series[key] for key in ("position", *PLACED)}))
    assert np.isfinite(result.metrics["bump"]["body_acceleration"]["rms"])
    assert np.isnan([result.travel_time, result.arrival_speed_kmh]).all()


def test_a_drive_somewhere_else_is_not_placed() -> None:
    x, signal = np.arange(0, 150, 0.1), np.random.default_rng(2).normal(size=(1, 1500))
    elsewhere = RecordedDrive.of({"time": x / 10, "position": x + 1000, "body_acceleration": signal[0]})
    with pytest.raises(RidelabError, match="no part of this road"):
        judged(elsewhere)


@pytest.mark.parametrize(
    ("position", "speed", "said"),
    [
        ([0.0, 150.0], None, "too few samples on this road"),
        ([0.0, 0.0, 150.0], None, "too few samples on this road"),
        ([-10.0, 160.0], None, "too few samples on this road"),
        ([-10.0, -10.0, 75.0, 160.0], None, "too few samples on this road"),
        (None, [0.0, 0.0, 0.0], "does not move"),
    ],
)
def test_too_few_samples_are_refused(position: list[float] | None, speed: list[float] | None, said: str) -> None:
    """Two ends say nothing of the road between them, with a jump at one of them neither."""
    given = np.array(position or speed)
    signals = {"position" if position else "speed": given, "body_acceleration": np.arange(len(given), dtype=float)}
    time = np.array([0.0, *np.cumsum(np.diff(given) / 10)]) if position else np.arange(len(given), dtype=float)
    with pytest.raises(RefusedError, match=said):
        judged(RecordedDrive.of({"time": time, **signals}))


CLASSES = (16e-6, 64e-6, 256e-6, 1024e-6)  # A to D


def of_another_road(number: int) -> RecordedDrive:
    """A drive at any speed by any strategy over another seed's road, with a bump there, elsewhere, or none."""
    rng = np.random.default_rng(number)
    length = float(rng.uniform(80, 250))
    bump = (
        Bump(start=min(100.0, length - 20)),
        Bump(start=float(rng.uniform(30, length - 20))),
        Bump(height=0, start=30),
    )
    road = Road(
        seed=int(rng.integers(100, 10_000)), roughness=float(rng.choice(CLASSES)), length=length, bump=bump[number % 3]
    )
    scenario = Scenario(road=road, speed=Speed(initial_speed_kmh=float(rng.uniform(25, 80))))
    keys = PLACED if number % 4 == 0 else PLACED[:1]
    return recording(scenario, str(rng.choice(list(STRATEGIES))), keys=keys)


@pytest.mark.parametrize("count", [8, pytest.param(200, marks=pytest.mark.thorough)])
def test_drives_of_other_roads_are_not_placed(count: int) -> None:
    """Of 200 at most one: chance places one in ten thousand, and Bartlett's variance is an estimate."""
    found = [report_of(of_another_road(number)).reference for number in range(count)]
    assert sum(reference is not None for reference in found) <= count // 200


SCALED, OTHER = 0.9 * LARGEST_SCALE_ERROR, {"mismatch": Mismatch(damping=0.7, body_mass=1.2)}
SOFTER = {"vehicle": Vehicle(front_damping=0.8 * 6000, rear_damping=0.8 * 6000)}
# Strategy, start [s], drift, the car that was driven, noise, signals; how far offset [m] and scale may be off. Without
# noise within the spacing of the refinement (2 cm) over twenty; of 150 m that is a drift of 7e-6. Another car moves it
# by half a wheel's oscillation, 35 ms or half a metre, at most; so does a third of noise of one signal.
MADE: list[tuple[str, float, float, dict[str, Any], float, tuple[str, ...], float, float]] = [
    ("passive", 0.0, 0.0, {}, 0.0, PLACED, 0.001, 1e-5),
    ("passive", 1.37, 0.002, {}, 0.0, PLACED, 0.001, 1e-5),
    ("passive", 3.1, -0.011, {}, 0.0, PLACED, 0.001, 1e-5),
    ("passive", 1.5, 0.001, SOFTER, 0.1, PLACED, 0.05, 5e-4),
    ("lv", 0.0, SCALED, {}, 0.3, PLACED[:1], 0.5, 0.003),
    ("suspension_only", 0.0, -SCALED, {}, 0.3, PLACED[:1], 0.5, 0.003),
    ("passive", 0.0, -SCALED, OTHER, 0.3, PLACED[:1], 0.5, 0.003),
]


@pytest.mark.parametrize(("strategy", "start", "drift", "car", "noise", "keys", "off", "scaled"), MADE)
def test_a_drive_of_this_road_is_placed(
    strategy: str, start: float, drift: float, car: dict[str, Any], noise: float, keys: Any, off: float, scaled: float
) -> None:
    driven = SCENARIO.model_copy(update=car)
    found = report_of(recording(driven, strategy, start=start, drift=drift, noise=noise, keys=keys))
    assert found.offset == pytest.approx(start * SCENARIO.speed.initial, abs=off)
    assert found.scale == pytest.approx(1 + drift, abs=scaled)
    assert found.reference == strategy or noise
    assert re.search(r"position = [01]\.\d{5} × distance [+−] \d+\.\d{3} m$", found.notes[1])


def test_a_drive_that_costs_too_much_is_not_compared_with_and_named() -> None:
    """The drive is placed against what remains; the ECU drives LV's controller and is never asked for."""
    asked = set()

    def affordable(scenario: Scenario, strategy: str) -> StrategyResult:
        asked.add(strategy)
        if strategy in ("lv", "suspension_only"):
            raise TooExpensiveError("Too many steps")
        return simulated(scenario, strategy)

    for seed in (SCENARIO.road.seed, 7):
        scenario = Scenario(road=Road(seed=seed))
        report = there(recorded_result(scenario, recording(SCENARIO), affordable).recording)
        assert report.reference == ("passive" if scenario == SCENARIO else None)
        labels = f"{STRATEGIES['lv'].label}, {STRATEGIES['suspension_only'].label}"
        assert f"Not compared with {labels}: simulating that on this road costs too much" in report.notes
    assert asked == set(STRATEGIES) - {"lv_hil"}


def test_a_bump_alone_says_nothing_of_a_rough_road_and_all_of_a_smooth_one() -> None:
    """The same bump on another road is said; on a road with nothing else the drive is placed there, at scale 1."""
    other = Scenario(road=Road(seed=16, bump=Bump(start=56)))
    found = report_of(recording(other))
    assert found.offset is None
    assert any("Its bump alone is like the simulated one" in note and "add 43.9 m" in note for note in found.notes)
    bump = preset("bump_only")
    shifted = report_of(recording(bump, start=2.0, noise=0.1), bump)
    assert (shifted.scale, shifted.reference) == (1, "passive")
    assert shifted.offset == pytest.approx(2 * bump.speed.initial, abs=0.1)


@pytest.mark.parametrize(("strategy", "placed"), [("passive", True), ("lv", True), ("passive", False)])
@pytest.mark.parametrize(
    ("sign", "added", "said"),
    [
        (1, GRAVITY, "The mean of body acceleration is 9.8 m/s²: it contains gravity, which was subtracted"),
        (-1, -GRAVITY, "it contains gravity, which was subtracted; z points down, so its sign was inverted"),
        (-1, 0.0, "has the opposite sign of the simulated drive (z points down); its sign was inverted"),
    ],
)
def test_gravity_and_a_sensor_that_points_down_change_nothing(
    strategy: str, sign: int, added: float, said: str, placed: bool
) -> None:
    """All metrics and curves are those of the drive without, placed or not; a sign alone shows where it was placed."""
    scenario = SCENARIO if placed else Scenario(road=Road(seed=7))
    drive = recording(SCENARIO, strategy)
    other = changed(drive, body_acceleration=sign * drive.signals()["body_acceleration"] + added)
    found, expected = (judged(each, scenario) for each in (other, drive))
    report = there(found.recording)
    assert (report.reference is not None) == placed
    if not (placed or added):
        assert not any("sign" in note for note in report.notes)
        return
    assert any(said in note for note in report.notes)
    for window, signals in expected.metrics.items():
        for statistic, value in signals["body_acceleration"].items():
            assert found.metrics[window]["body_acceleration"][statistic] == pytest.approx(value, rel=1e-6, nan_ok=True)
    for key in COMFORT:
        assert found.comfort[key] == pytest.approx(expected.comfort[key], rel=1e-4, nan_ok=True)
    np.testing.assert_allclose(found.series["body_acceleration"], expected.series["body_acceleration"], atol=1e-3)


@pytest.mark.parametrize("offset", [0.5, -3.0])
def test_an_offset_is_said_and_the_weighted_values_are_without_it(offset: float) -> None:
    """What it is remains open, so RMS and peaks are with it; Wk passes nothing at 0 Hz."""
    drive = recording(SCENARIO)
    other = changed(drive, body_acceleration=drive.signals()["body_acceleration"] + offset)
    found, expected = (judged(each) for each in (other, drive))
    assert any("The mean of body acceleration is" in note for note in there(found.recording).notes)
    for key in ("weighted_rms", "vibration_dose"):
        assert found.comfort[key] == pytest.approx(expected.comfort[key], rel=1e-3)
    whole = found.metrics["whole"]["body_acceleration"]["rms"]
    assert whole == pytest.approx(np.hypot(expected.metrics["whole"]["body_acceleration"]["rms"], offset), rel=0.02)


def test_compression_that_counts_positive_is_said_and_inverted() -> None:
    drive = recording(SCENARIO)
    found = judged(changed(drive, front_deflection=-drive.signals()["front_deflection"]))
    assert any("(compression counts positive); its sign was inverted" in note for note in there(found.recording).notes)
    series = simulated(SCENARIO, "passive").series
    shared = np.interp(series["position"], found.series["position"], found.series["front_deflection"])
    assert np.corrcoef(shared, series["front_deflection"])[0, 1] > 0.99


@pytest.mark.parametrize("strategy", STRATEGIES)
def test_nothing_is_said_of_a_drives_own_zeros(strategy: str) -> None:
    notes = report_of(recording(SCENARIO, strategy, keys=METRIC_SIGNALS)).notes
    assert not any("The mean of" in note or "sign" in note for note in notes)
