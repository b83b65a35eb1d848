"""Recordings: placed where they were made, and judged as the simulated drive they are a recording of."""

from math import nan

import numpy as np
import pytest

from sim_core import RidelabError, Scenario, Vehicle, simulate
from sim_core.catalogue import METRIC_SIGNALS
from sim_core.recorded.alignment import correlations, place
from sim_core.recorded.result import recorded_result
from sim_core.scenario.recorded import RecordedDrive
from tests.there import there

SCENARIO = Scenario()
PLACED = ("body_acceleration", "front_deflection")


def recording(scenario: Scenario, *, start: float = 0.0, drift: float = 0.0, noise: float = 0.0) -> RecordedDrive:
    """A passive drive from `start` [s] on, every 4 ms, by a clock of its own that begins at 100 s."""
    series = simulate(scenario, "passive").series
    true = np.arange(start, series["time"][-1], 0.004)
    signals = {key: np.interp(true, series["time"], series[key]) for key in ("speed", *PLACED)}
    rng = np.random.default_rng(1)
    for key in PLACED:
        signals[key] += noise * signals[key].std() * rng.normal(size=len(true))
    return RecordedDrive.of({"time": 100 + (true - start) / (1 + drift), **signals})


@pytest.mark.parametrize(("start", "drift"), [(0.0, 0.0), (1.37, 0.002), (3.1, -0.011)])
def test_start_and_drift_of_the_clock_are_found(start: float, drift: float) -> None:
    """Without noise within the spacing of the refinement (2 cm) over twenty; of 150 m that is a drift of 7e-6."""
    found = there(recorded_result(SCENARIO, recording(SCENARIO, start=start, drift=drift)).recording)
    assert found.reference == "passive"
    assert there(found.offset) == pytest.approx(start * SCENARIO.speed.initial, abs=0.001)
    assert there(found.scale) == pytest.approx(1 + drift, abs=1e-5)


def test_a_clock_that_is_far_off_is_found_on_a_long_road() -> None:
    """A first search that took no scale between none and the largest would see nothing alike at both ends."""
    position = np.arange(0, 400, 0.1)
    road = np.convolve(np.random.default_rng(1).normal(size=len(position)), np.hanning(11), "same")
    distance = np.arange(0, 380, 0.1)
    recorded = np.interp(20 + 0.985 * distance, position, road)
    found = there(place(distance, recorded[None], position, road[None]))
    assert found.offset == pytest.approx(20, abs=0.001)
    assert found.scale == pytest.approx(0.985, abs=1e-5)


def test_another_car_and_noise_do_not_move_it_far() -> None:
    """Softer dampers delay the motion: half a wheel's oscillation, 35 ms or half a metre, would be a wrong place."""
    softer = Vehicle(front_damping=0.8 * 6000, rear_damping=0.8 * 6000)
    other = SCENARIO.model_copy(update={"vehicle": softer})
    found = there(recorded_result(SCENARIO, recording(other, start=1.5, drift=0.001, noise=0.1)).recording)
    assert found.offset == pytest.approx(1.5 * SCENARIO.speed.initial, abs=0.05)
    assert found.scale == pytest.approx(1.001, abs=5e-4)


def test_its_metrics_are_those_of_the_drive() -> None:
    """Of every sample of a drive without held forces; tyre loads peak between samples too, which a recording cannot."""
    result = simulate(SCENARIO, "passive")
    drive = RecordedDrive.of({key: result.series[key] for key in result.series})
    found = recorded_result(SCENARIO, drive)
    for window, signals in result.metrics.items():
        for key, statistics in signals.items():
            ours = found.metrics[window][key]
            assert ours["rms"] == pytest.approx(statistics["rms"], rel=1e-4)
            assert ours["peak"] == pytest.approx(statistics["peak"], rel=0.01 if "load" in key else 1e-4)
    for key, value in result.comfort.items():
        assert found.comfort[key] == pytest.approx(value, rel=1e-3)
    assert found.events["airborne_ms"] == pytest.approx(result.events["airborne_ms"], abs=1.0)
    assert found.travel_time == pytest.approx(result.travel_time, rel=1e-4)


def test_what_was_not_recorded_has_no_metric() -> None:
    """A gap takes its windows, a missing signal its own metrics, and a part of the road all that reaches beyond."""
    series = simulate(SCENARIO, "passive").series
    acceleration = np.where(np.abs(series["position"] - 30) < 1, np.nan, series["body_acceleration"])
    signals = {"time": series["time"], "position": series["position"], "body_acceleration": acceleration}
    early, result = (
        recorded_result(SCENARIO, RecordedDrive.of({key: each[part] for key, each in signals.items()}))
        for part in (series["position"] < SCENARIO.road.bump.start, series["position"] > 20)
    )
    assert (early.events["bump_complete"], result.events["bump_complete"]) == (False, True)
    assert np.isnan(result.metrics["rough_road"]["body_acceleration"]["rms"])
    assert np.isfinite(result.metrics["bump"]["body_acceleration"]["rms"])
    assert np.isnan(result.metrics["bump"]["front_force"]["rms"])
    assert np.isnan(result.comfort["weighted_rms"])
    assert set(there(result.recording).missing) == set(METRIC_SIGNALS) - {"body_acceleration"}


@pytest.mark.parametrize(("start", "end", "rms"), [(0.5, 149.5, 2.0), (0.51, 149.5, nan), (0.5, 149.49, nan)])
def test_half_a_metre_may_lack_at_either_end_of_the_road(start: float, end: float, rms: float) -> None:
    position = np.array([start, 100.0, end])
    drive = RecordedDrive.of({"time": position, "position": position, "body_acceleration": np.full(3, 2.0)})
    whole = recorded_result(SCENARIO, drive).metrics["whole"]
    assert whole["body_acceleration"]["rms"] == pytest.approx(rms, nan_ok=True)


def test_a_drive_without_time_and_speed_has_no_travel_time() -> None:
    """It is placed and judged as if at the initial speed, which says nothing of how long it took."""
    series = simulate(SCENARIO, "passive").series
    result = recorded_result(SCENARIO, RecordedDrive.of({key: series[key] for key in ("position", *PLACED)}))
    assert np.isfinite(result.metrics["bump"]["body_acceleration"]["rms"])
    assert np.isnan([result.travel_time, result.arrival_speed_kmh]).all()


def test_a_drive_of_a_clock_alone_takes_as_long_as_its_road_says() -> None:
    """Without speed it is taken as driven at the initial one, which it holds; the last sample is 4 ms early at most."""
    signals = recording(SCENARIO, drift=-0.011).signals()
    result = recorded_result(SCENARIO, RecordedDrive.of({key: signals[key] for key in ("time", *PLACED)}))
    assert result.travel_time == pytest.approx(SCENARIO.road.length / SCENARIO.speed.initial, abs=0.005)


def test_a_signal_is_like_itself_from_another_zero() -> None:
    x = np.arange(0, 10, 0.1)
    assert correlations(x, np.sin(x)[None] + 3, x, np.sin(x)[None] + 5) == pytest.approx([1])


def test_a_drive_somewhere_else_is_not_placed() -> None:
    x, signal = np.arange(0, 150, 0.1), np.random.default_rng(2).normal(size=(1, 1500))
    series = simulate(SCENARIO, "passive").series
    assert place(x, signal, series["position"], series["body_acceleration"][None]) is None
    elsewhere = RecordedDrive.of({"time": x / 10, "position": x + 1000, "body_acceleration": signal[0]})
    with pytest.raises(RidelabError, match="no part of this road"):
        recorded_result(SCENARIO, elsewhere)


def test_where_both_axles_meet_the_bump_together_its_window_ends_with_it() -> None:
    road = SCENARIO.road.model_copy(update={"rear_axle": "together"})
    scenario = SCENARIO.model_copy(update={"road": road})
    driven = simulate(scenario, "passive")
    found = recorded_result(scenario, RecordedDrive.of({key: driven.series[key] for key in driven.series}))
    assert [span.end_position for span in found.stages] == pytest.approx([100.0, 104.0, driven.series["position"][-1]])
    for key in PLACED:
        ours, theirs = found.metrics["bump"][key], driven.metrics["bump"][key]
        assert ours["rms"] == pytest.approx(theirs["rms"], rel=1e-4)
        assert ours["peak"] == pytest.approx(theirs["peak"], rel=1e-4)
