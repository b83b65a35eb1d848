"""Pinned time histories: exactly what was computed, readable by any catalogue of signals."""

import io
from collections.abc import Mapping
from typing import Any

import numpy as np
import orjson
import pyarrow as pa
import pytest
from pyarrow import parquet

from backend.runs import exports, pins
from backend.runs.series import ROWS, SamplingHints, SeriesArray, decimate, pack, pack_all
from sim_core import Bump, Road, Scenario, Speed, __version__, simulate
from sim_core.catalogue import SIGNALS

SCENARIO = Scenario(road=Road(length=20, bump=Bump(start=8, width=2)), speed=Speed(detection_distance=6))


@pytest.fixture(scope="module")
def pinned() -> dict[str, bytes]:
    return pins.make(SCENARIO, ["lv", "passive"])


@pytest.fixture(scope="module")
def stages() -> dict[str, SamplingHints]:
    return {
        name: SamplingHints.of((span.stage, span.start_time, span.end_time) for span in simulate(SCENARIO, name).stages)
        for name in ("lv", "passive")
    }


def export(**change: Any) -> exports.Export:
    settings = {"strategies": ["lv", "passive"], "signals": list(SIGNALS), "points": None, "encoding": "list"}
    return exports.Export(**{**settings, "core_version": "b", "sources": {}, **change})


def test_a_pin_is_every_sample_bit_for_bit(pinned: dict[str, bytes], stages: dict[str, SamplingHints]) -> None:
    opened = pins.opened(pinned, stages, None)
    for name, array in opened.items():
        np.testing.assert_array_equal(array, pack_all(simulate(SCENARIO, name)))
        assert array.dtype == np.float32


def test_a_pin_names_its_signals_units_strategy_and_version(pinned: dict[str, bytes]) -> None:
    magic, head, _ = pinned["lv"].split(b"\n", 2)
    assert magic == b"ridelab pin 1"
    units = {key: quantity.unit for key, quantity in SIGNALS.items()}
    assert orjson.loads(head) == {"units": units, "strategy": "lv", "core_version": __version__}


def rewritten(columns: Mapping[str, SeriesArray], units: Mapping[str, str]) -> bytes:
    """The pin of a core until 0.3.0 with these signals and units."""
    fields = [pa.field(key, pa.float32(), False, {"unit": units[key]}) for key in columns]
    sink = io.BytesIO()
    parquet.write_table(pa.table(list(columns.values()), schema=pa.schema(fields)), sink)
    return sink.getvalue()


@pytest.mark.parametrize("points", [None, 60])
def test_another_catalogue_reads_what_it_knows(stages: dict[str, SamplingHints], points: int | None) -> None:
    """Columns in another order, one that today's core does not know, one missing, one in another unit."""
    signals = [key for key in reversed(SIGNALS) if key not in ("rear_force", "brake_pressure")]
    own = pins.columns(pins.make(SCENARIO, ["lv"])["lv"], stages["lv"], None)
    units = {key: SIGNALS[key].unit for key in signals}
    old = rewritten(
        {**{key: own[key] for key in signals}, "tyre_temperature": own["speed"], "brake_pressure": own["time"]},
        {**units, "tyre_temperature": "K", "brake_pressure": "bar"},
    )
    (array,) = pins.opened({"lv": old}, stages, points).values()
    shared = [key for key in SIGNALS if key in signals]
    rows = [ROWS[key] for key in shared]
    driven = (pack_all if points is None else pack)(simulate(SCENARIO, "lv"))
    expected = decimate(driven[rows], points, stages["lv"])
    np.testing.assert_array_equal(array[rows], expected)
    assert np.isnan(array[[ROWS["rear_force"], ROWS["brake_pressure"]]]).all()

    answer = orjson.loads(
        exports.render_pinned({"lv": old}, stages, export(strategies=["lv"], file_format="json"), None)
    )
    assert list(answer["series"]) == list(answer["units"]) == shared
    text = exports.render_pinned({"lv": old}, stages, export(strategies=["lv"], file_format="csv"), None).decode()
    assert text.splitlines()[0].split(",") == [f"{key} [{SIGNALS[key].unit}]" for key in shared]


def test_very_many_samples_are_not_pinned_and_not_driven_for_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pins, "MOST_PINNED", 1000)
    monkeypatch.setattr(pins, "simulate", None)
    assert pins.make(SCENARIO, ["lv", "passive"]) == {}
