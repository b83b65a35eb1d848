"""What the client makes of answers: typed results, intervals, arrays, errors."""

import base64
import io
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pyarrow import parquet

from ridelab import Interval, Ridelab, RidelabAPIError
from sim_core import __version__ as CORE_VERSION
from tests.client.conftest import ADDRESS, RUN, SHORT, SLUG, Prepared

PEAK = "bump.body_acceleration.peak"


def test_a_run_is_typed(ridelab: Ridelab, outcomes: dict[str, Any]) -> None:
    run, answer = ridelab.run(SHORT, ["lv", "passive"]), outcomes["lv"]
    outcome = run["lv"]
    assert list(run.strategies) == ["lv", "passive"]
    with pytest.raises(KeyError, match="lqr did not run; there are lv, passive"):
        run["lqr"]
    assert (outcome.status, outcome.cached, outcome.stages) == ("ok", False, answer["stages"])
    assert outcome.figures()[PEAK] == answer["metrics"]["bump"]["body_acceleration"]["peak"]
    assert (outcome.travel_time, outcome.arrival_speed_kmh) == (answer["travel_time"], answer["arrival_speed_kmh"])
    assert (run.core_version, run.units[PEAK], run.scenario["road"]["length"]) == (CORE_VERSION, "m/s^2", 61)
    assert ridelab.get_run(RUN)["lv"].metrics == outcome.metrics
    with pytest.raises(RidelabAPIError) as caught:
        ridelab.get_run("no/such")
    assert caught.value.status == 404
    with pytest.raises(ValueError, match="JSON"):
        ridelab.run({"road": {"length": float("nan")}}, ["lv"])


def test_a_scenario_is_a_preset_with_named_fields_changed(ridelab: Ridelab) -> None:
    changes = {"road.bump.height": "12 cm", "speed.target_speed_kmh": 20, "mpc.preview": "none", "lqr.weights.1": "2.5"}
    scenario, preset = ridelab.scenario("watts_hump", changes), ridelab.scenario("watts_hump")
    changed = scenario["road"]["bump"]["height"], scenario["speed"]["target_speed_kmh"], scenario["mpc"]["preview"]
    assert changed == (0.12, 20, "none")
    assert scenario["lqr"]["weights"] == [1, 2.5, 1]
    assert scenario["road"]["bump"]["width"] == preset["road"]["bump"]["width"]
    for wrong, message in (
        (("papr", {}), "papr: there is no such preset"),
        (("paper", {"road.bump.hight": "12 cm"}), r"road\.bump\.hight: there is no such name"),
        (("paper", {"road.bump.height.0": 1}), "no such place"),
    ):
        with pytest.raises(ValueError, match=message):
            ridelab.scenario(*wrong)


def test_parquet_is_made_of_csv_with_its_units(ridelab: Ridelab, prepared: Prepared) -> None:
    """Whole numbers of a quantity are numbers like the others, and an empty column is one of texts."""
    csv = b"strategy,speed [m/s],front_force [N],reason\nlv,13.5,0,\nlv,,2,\n"
    prepared.answers[f"GET /runs/{RUN}/series"] = csv
    content = b"".join(ridelab.series_content(RUN, "parquet", strategies=["lv"]))
    table = parquet.read_table(io.BytesIO(content))
    assert table.to_pydict() == {
        "strategy": ["lv", "lv"],
        "speed [m/s]": [13.5, None],
        "front_force [N]": [0.0, 2.0],
        "reason": [None, None],
    }
    assert [str(field.type) for field in table.schema] == ["string", "double", "double", "string"]
    assert table.schema.field("speed [m/s]").metadata == {b"unit": b"m/s"}


def test_the_address_may_come_from_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("RIDELAB_SERVER", ADDRESS)
    with Ridelab() as ridelab:
        assert ridelab.address == ADDRESS
    monkeypatch.delenv("RIDELAB_SERVER")
    with pytest.raises(ValueError, match="RIDELAB_SERVER"):
        Ridelab()


def interval(mean: float, half: float) -> dict[str, float]:
    return {"mean": mean, "low": mean - half, "high": mean + half}


def test_several_roads_come_as_means_with_intervals(ridelab: Ridelab, prepared: Prepared) -> None:
    peaks = {"bump": {"body_acceleration": {"peak": interval(-60, 4)}}}
    entry = {"status": "ok", "compute_ms": 1.0, "metrics": peaks, "comfort": {"weighted_rms": interval(0.5, 0)}}
    answer = {"id": RUN, "core_version": "1", "scenario": SHORT, "strategies": {"lv": entry}, "roads": 3}
    prepared.answers["POST /runs"] = {**answer, "baseline": "lqr", "changes": {"lv": peaks, "lqr": {"comfort": None}}}
    prepared.answers[f"GET /runs/{RUN}/changes"] = {"changes": {"lv": peaks}}
    run = ridelab.run(SHORT, ["lv"], roads=3, baseline="lqr")
    expected = Interval(mean=-60, low=-64, high=-56)
    assert (run.roads, run.baseline) == (3, "lqr")
    assert run["lv"].metrics["bump"]["body_acceleration"]["peak"] == expected
    assert isinstance(run["lv"].comfort["weighted_rms"], Interval)
    assert run["lv"].figures()[PEAK] == -60
    assert run.changes["lv"]["bump"]["body_acceleration"]["peak"].half == 4
    assert ridelab.changes(run, against=run)["lv"]["bump"]["body_acceleration"]["peak"] == expected


@pytest.mark.parametrize(
    ("mean", "half", "shown"), [(2148.3, 354.2, "2148 ± 354"), (1.0284, 0.034, "1.028 ± 0.034"), (0.5, 0, "0.5 ± 0.0")]
)
def test_an_interval_has_as_many_digits_as_it_knows(mean: float, half: float, shown: str) -> None:
    assert repr(Interval(mean=mean, low=mean - half, high=mean + half)) == shown


def test_time_histories_are_arrays_or_a_file(ridelab: Ridelab, prepared: Prepared, tmp_path: Path) -> None:
    speed = np.array([13.9, 6.25], dtype="<f4")
    packed = {"speed": {"dtype": "f4", "bdata": base64.b64encode(speed.tobytes()).decode()}}
    prepared.answers[f"GET /runs/{RUN}/series"] = {"series": packed}
    prepared.answers[f"GET /runs/{RUN}/bands"] = {"strategies": {"lv": {"mean": packed, "minimum": {}, "maximum": {}}}}
    np.testing.assert_array_equal(ridelab.series(RUN, "lv", ["speed"])["speed"], speed)
    band = ridelab.band(RUN, "lv")
    assert list(band) == ["mean", "minimum", "maximum"]
    np.testing.assert_array_equal(band["mean"]["speed"], speed)
    prepared.answers[f"GET /runs/{RUN}/series"] = b"speed [m/s]\n13.9\n"
    path = tmp_path / "it.csv"
    assert ridelab.download_series(RUN, path, strategies=["lv"], signals=["speed"], points=200) == path
    assert path.read_bytes() == b"speed [m/s]\n13.9\n"


@pytest.mark.parametrize("kind", ["run", "batch"])
def test_a_link_opens_as_what_it_pins(ridelab: Ridelab, prepared: Prepared, kind: str) -> None:
    run: Any = prepared.answers[f"GET /runs/{RUN}"]
    batch: Any = prepared.answers[f"GET /batches/{prepared.job('batch')}"]
    pinned = {"run": run, "batch": None} if kind == "run" else {"run": None, "batch": batch}
    plain = {"kind": kind, "created_at": "", "core_version": "1", "current_core_version": "2", "scenario": SHORT}
    link = {"slug": SLUG, "url": f"/s/{SLUG}", "view": {"zoom": [1.0, 2.5]}, "series_pinned": True, **plain, **pinned}
    prepared.answers |= {"POST /links": link, f"GET /links/{SLUG}": link}
    shared = ridelab.get_run(RUN) if kind == "run" else ridelab.get_batch(batch["id"])
    assert ridelab.link(shared).url == f"{ADDRESS}/s/{SLUG}"
    assert prepared.bodies("POST /links") == [{f"{kind}_id": shared.id}]
    opened = ridelab.open_link(SLUG)
    assert (opened.kind, opened.view, opened.current_core_version) == (kind, {"zoom": [1.0, 2.5]}, "2")
    assert (opened.run is None, opened.batch is None) == (kind == "batch", kind == "run")
