"""The Python client against the real service: what it returns is what the service stores."""

import csv
import io
from collections.abc import Iterator
from pathlib import Path

import httpx
import numpy as np
import pytest

from backend.means_over_roads import seeded
from ridelab import Batch, Interval, Ridelab, RidelabAPIError, RunResult
from sim_core.catalogue import SIGNALS
from sim_core.scenario import Bump, Road, Scenario
from sim_core.simulate import simulate

SHORT = Scenario(road=Road(length=112, bump=Bump(start=72)))  # nobody else's, so that nothing is stored yet
HEIGHTS = [0.03, 0.05, 0.07]


@pytest.fixture(scope="module")
def ridelab(client: httpx.Client) -> Iterator[Ridelab]:
    with Ridelab(str(client.base_url)) as ridelab:
        yield ridelab


@pytest.fixture(scope="module")
def shared(ridelab: Ridelab) -> RunResult:
    return ridelab.run(SHORT, ["lv", "passive"])


@pytest.fixture(scope="module")
def batch(ridelab: Ridelab) -> Batch:
    batch = ridelab.submit(SHORT, ["lv", "passive"], {"grid": {"road.bump.height": np.array(HEIGHTS)}})
    return batch.wait()


def test_a_run_is_what_the_core_computes(ridelab: Ridelab, shared: RunResult) -> None:
    expected = simulate(SHORT, "lv")
    outcome = shared["lv"]
    assert list(shared.strategies) == ["lv", "passive"]
    assert outcome.status == "ok"
    peak = outcome.metrics["bump"]["body_acceleration"]["peak"]
    assert peak == pytest.approx(expected.metrics["bump"]["body_acceleration"]["peak"], rel=1e-9)
    assert outcome.figures()["bump.body_acceleration.peak"] == peak
    assert (outcome.travel_time, outcome.arrival_speed_kmh) == pytest.approx(
        (expected.travel_time, expected.arrival_speed_kmh), rel=1e-9
    )
    assert [stage["stage"] for stage in outcome.stages] == [span.stage for span in expected.stages]
    assert shared.scenario == SHORT.model_dump(mode="json")
    again = ridelab.run(SHORT.model_dump(mode="json"), ["lv", "passive"])
    assert again["lv"].cached is True
    assert again.id == shared.id


def test_several_roads_come_as_means_with_intervals(ridelab: Ridelab) -> None:
    run = ridelab.run(SHORT, ["lv", "lqr", "passive"], roads=3, baseline="lqr")
    assert (run.roads, run.baseline) == (3, "lqr")
    peak = run["lv"].metrics["bump"]["body_acceleration"]["peak"]
    assert isinstance(peak, Interval)
    assert peak.low < peak.mean < peak.high
    assert [repr(Interval(mean=m, low=m - h, high=m + h)) for m, h in ((2148.3, 354.2), (1.0284, 0.034), (0.5, 0))] == [
        "2148 ± 354",
        "1.028 ± 0.034",
        "0.5 ± 0.0",
    ]
    assert run["lv"].figures()["bump.body_acceleration.peak"] == peak.mean
    assert isinstance(run["lv"].comfort["weighted_rms"], Interval)
    assert set(run.changes) == {"lv", "passive"}
    assert run.changes["lv"]["bump"]["body_acceleration"]["peak"].mean < 0
    assert run.changes["lv"]["comfort"]["weighted_rms"].half > 0
    assert ridelab.get_run(run.id).changes == run.changes
    assert repr(run) == f"RunResult({run.id}, core {run.core_version}, 3 roads: lv ok, lqr ok, passive ok)"
    assert len(repr(run["lv"])) < 240
    heavier = SHORT.model_copy(update={"vehicle": SHORT.vehicle.model_copy(update={"body_mass": 1300.0})})
    edited = ridelab.run(heavier, ["lv"], roads=3)
    change = ridelab.changes(edited, against=run)["lv"]["bump"]["body_acceleration"]["peak"]
    assert set(ridelab.changes(run, baseline="passive")) == {"lv", "lqr"}
    assert change.low < change.mean < change.high
    assert run.id in b"".join(ridelab.run_report(edited, against=run)).decode()
    with pytest.raises(RidelabAPIError, match="One of the strategies"):
        ridelab.run(SHORT, ["lv"], roads=3, baseline="lqr")


def test_a_stored_run_comes_back(ridelab: Ridelab, shared: RunResult) -> None:
    stored = ridelab.get_run(shared.id)
    assert stored["lv"].metrics == shared["lv"].metrics
    assert stored["lv"].cached is None
    with pytest.raises(RidelabAPIError) as caught:
        ridelab.get_run("no/such")
    assert caught.value.status == 404


def test_time_histories_as_arrays(ridelab: Ridelab, shared: RunResult) -> None:
    series = ridelab.series(shared, "lv", ["body_acceleration"])
    assert list(series) == ["time", "position", "body_acceleration"]
    expected = simulate(SHORT, "lv").series
    for key, values in series.items():
        assert values.dtype == np.float32
        np.testing.assert_allclose(values, expected[key], rtol=1e-6, atol=1e-6)  # float32
    assert set(ridelab.series(shared.id, "passive", points=300)) == set(SIGNALS)


def test_time_histories_over_roads(ridelab: Ridelab) -> None:
    """At each sample mean, minimum and maximum of the single runs, which share every sample's time and position."""
    run = ridelab.run(SHORT, ["lv", "lqr"], roads=4)
    for strategy in ("lv", "lqr"):
        singles = [simulate(road, strategy).series for road in seeded(SHORT, 4)]
        band = ridelab.band(run, strategy)
        assert list(band["mean"]) == list(SIGNALS)
        assert set(band["mean"]) - set(band["minimum"]) == {
            "time", "position", "speed", "brake_pressure", "brake_deceleration",
        }  # fmt: skip
        for part, over in (("mean", np.mean), ("minimum", np.min), ("maximum", np.max)):
            for key, values in band[part].items():
                drives = np.array([single[key] for single in singles], dtype=np.float32).astype(np.float64)
                np.testing.assert_allclose(values, over(drives, axis=0), rtol=1e-7)  # float32's half digit
                assert key in band["minimum"] or np.ptp(drives, axis=0).max() == 0
    few = ridelab.band(run, "lv", ["body_acceleration"], points=300)
    assert [list(part) for part in few.values()] == [
        ["time", "position", "body_acceleration"], ["body_acceleration"], ["body_acceleration"],
    ]  # fmt: skip
    everything = ridelab.band(run, "lv")
    kept = np.isin(everything["mean"]["time"], few["mean"]["time"])
    assert kept.sum() == len(few["mean"]["time"]) < 330
    for part in few:
        values = everything[part]["body_acceleration"]
        np.testing.assert_array_equal(few[part]["body_acceleration"], values[kept])
        assert (few[part]["body_acceleration"].min(), few[part]["body_acceleration"].max()) == (
            values.min(),
            values.max(),
        )
    with pytest.raises(RidelabAPIError, match="one road"):
        ridelab.band(ridelab.run(SHORT, ["lv"]), "lv")


def test_time_histories_as_a_file(ridelab: Ridelab, shared: RunResult, tmp_path: Path) -> None:
    path = tmp_path / "it.csv"
    assert ridelab.download_series(shared, path, strategies=["lv"], signals=["speed"], points=200) == path
    expected = ridelab.series(shared, "lv", ["speed"], points=200)["speed"]
    speeds = [float(row["speed [m/s]"]) for row in csv.DictReader(io.StringIO(path.read_text()))]
    np.testing.assert_allclose(speeds, expected, rtol=1e-6)


def test_refusals_name_the_field(ridelab: Ridelab) -> None:
    with pytest.raises(RidelabAPIError) as caught:
        ridelab.run({"road": {"bump": {"height": 9}, "length": 130}}, ["lv", "nothing"])
    assert caught.value.status == 422
    places = {place.field: place.message for place in caught.value.errors}
    assert set(places) == {"road.bump.height", "strategies[1]"}
    with pytest.raises(RidelabAPIError) as caught:
        ridelab.submit({}, ["lv"], {"grid": {"road.bump.height": [0.1, 9]}})
    assert [place.field for place in caught.value.errors] == ["road.bump.height[1]"]
    with pytest.raises(ValueError, match="JSON"):
        ridelab.run({"road": {"length": float("nan")}}, ["lv"])


def test_a_batch_is_followed_to_its_end(ridelab: Ridelab) -> None:
    heard: list[tuple[str, int]] = []
    sweep = {"grid": {"road.bump.width": [3, 3.5, 4.5], "road.seed": range(5)}}
    batch = ridelab.submit(SHORT, ["passive"], sweep)
    assert batch.total == 15
    batch.wait(lambda batch: heard.append((batch.state, batch.done)))
    assert heard[-1] == ("done", 15)
    assert [state for state, _ in heard].count("done") == 1
    assert [done for _, done in heard] == sorted(done for _, done in heard)
    assert batch.answer["finished_at"] is not None
    assert ridelab.get_batch(batch.id).answer == batch.answer


def test_a_batch_as_a_frame(batch: Batch) -> None:
    frame = batch.frame()
    assert list(frame["road.bump.height"]) == [height for height in HEIGHTS for _ in range(2)]
    assert frame.attrs["units"]["bump.body_acceleration.peak"] == "m/s^2"
    peaks = [row["metrics"]["bump"]["body_acceleration"]["peak"] for row in batch.rows()]
    np.testing.assert_allclose(frame["bump.body_acceleration.peak"], peaks)


def test_links_pin_a_run_and_a_batch(ridelab: Ridelab, shared: RunResult, batch: Batch) -> None:
    view = {"baseline": "lv", "axis": "time", "zoom": [1.0, 2.5]}
    link = ridelab.link(shared, view)
    assert link.url == f"{ridelab.address}/s/{link.slug}"
    opened = ridelab.open_link(link.slug)
    assert (opened.kind, opened.view, opened.scenario) == ("run", view, shared.scenario)
    assert opened.run is not None
    assert opened.run["lv"].metrics == shared["lv"].metrics
    assert opened.batch is None
    assert opened.core_version == opened.current_core_version == shared.core_version
    of_batch = ridelab.open_link(ridelab.link(batch).slug)
    assert of_batch.batch is not None
    assert (of_batch.kind, of_batch.batch.id, of_batch.run) == ("batch", batch.id, None)
    with pytest.raises(RidelabAPIError) as caught:
        ridelab.open_link("A" * 22)
    assert caught.value.status == 404
