"""Time histories: one content in every format, peaks kept however few the points."""

import base64
import csv
import io
from itertools import pairwise
from typing import Any

import httpx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from backend.models import Series
from backend.outcome import Sampling
from backend.runs.series import ROWS, SamplingHints, around, decimate, pack
from sim_core import Scenario, simulate
from sim_core.catalogue import METRIC_SIGNALS, SIGNALS

HEADER = [f"{key} [{quantity.unit}]" for key, quantity in SIGNALS.items()]


@pytest.fixture(scope="module")
def address(run: dict[str, Any]) -> str:
    return f"/api/v1/runs/{run['id']}/series"


def unpack(packed: dict[str, str]) -> np.ndarray:
    assert packed["dtype"] == "f4"
    return np.frombuffer(base64.b64decode(packed["bdata"]), dtype="<f4")


def table(client: httpx.Client, address: str, **query: Any) -> tuple[list[str], list[list[str]]]:
    response = client.get(address, params={"format": "csv", **query})
    assert response.status_code == 200, response.text
    assert response.headers["content-type"].startswith("text/csv")
    assert ".csv" in response.headers["content-disposition"]
    header, *rows = csv.reader(io.StringIO(response.text))
    return header, rows


def test_json_and_csv_hold_the_same_numbers(client: httpx.Client, address: str) -> None:
    answer = client.get(address, params={"strategy": "lv"}).json()
    Series.model_validate(answer)
    assert answer["strategy"] == "lv"
    assert list(answer["series"]) == list(SIGNALS)
    assert answer["units"] == {key: quantity.unit for key, quantity in SIGNALS.items()}
    numbers = np.array([answer["series"][key] for key in SIGNALS], dtype=np.float32)
    assert numbers.shape[1] > 5000, "the full resolution"
    steps, jumps = np.diff(numbers[0]), np.diff(numbers[ROWS["front_force"]]) != 0
    assert np.all(steps >= 0)
    assert np.all(jumps[steps == 0]), "the values before and after a jump"
    assert not np.any(jumps[steps > 0]), "held in between"

    header, rows = table(client, address, strategy="lv")
    assert header == HEADER
    np.testing.assert_array_equal(np.array(rows, dtype=np.float32).T, numbers)

    answer = client.get(address, params={"strategy": "lv", "encoding": "base64"}).json()
    np.testing.assert_array_equal(np.array([unpack(answer["series"][key]) for key in SIGNALS]), numbers)


def test_chosen_signals_come_with_time_and_position(client: httpx.Client, address: str) -> None:
    answer = client.get(address, params={"strategy": "lv", "signals": "rear_force,speed"}).json()
    assert list(answer["series"]) == ["time", "position", "speed", "rear_force"]
    few = table(client, address, strategy="lv", points=2)[1]
    assert len(few) == 2, "the ends"
    assert table(client, address, strategy="lv", signals="speed")[0] == ["time [s]", "position [m]", "speed [m/s]"]


@pytest.mark.parametrize("signals", [list(SIGNALS), ["speed"]])
def test_live_series_are_those_of_the_stored_run(service: Any, address: str, signals: list[str]) -> None:
    scenario = service.get(address.removesuffix("/series")).json()["scenario"]
    live = service.live(["lv"], scenario, points=300, signals=signals).json()["strategies"]["lv"]["series"]
    query: dict[str, Any] = {"strategy": "lv", "points": 300, "encoding": "base64", "signals": ",".join(signals)}
    assert live == service.get(address, params=query).json()["series"]


@pytest.mark.parametrize("start", [1.0, 143.0])
def test_the_bump_alone_keeps_its_peaks(start: float) -> None:
    """And has a sample on either side, where the road goes on there."""
    result = simulate(Scenario.model_validate({"road": {"bump": {"start": start}}}), "lv")
    bump = next(span for span in result.stages if span.stage == "bump")
    low, high = around(bump.start_position, bump.end_position)
    few, whole = pack(result, Sampling(100, "bump")), pack(result)
    places, shown = whole[ROWS["position"]], few[ROWS["position"]]
    assert shown[0] <= max(low, places[0])
    assert shown[-1] >= min(high, places[-1])
    inside, kept = (places >= low) & (places <= high), (shown >= low) & (shown <= high)
    assert 90 < len(shown) <= 100 < np.count_nonzero(inside)
    for key in METRIC_SIGNALS:
        assert np.ptp(whole[ROWS[key], inside]) <= np.ptp(few[ROWS[key]]) * (1 + 1e-6), key
        assert set(few[ROWS[key], kept]) <= set(whole[ROWS[key], inside]), key


@given(
    arrays.arrays(
        np.float32,
        st.tuples(st.integers(1, 4), st.integers(2, 400)),
        elements=st.floats(-1e6, 1e6, width=32) | st.just(np.nan),
    ),
    st.integers(2, 200),
    st.lists(st.floats(0, 400), max_size=3).map(sorted),
)
def test_decimation_keeps_to_its_points_with_ends_and_extremes(
    rows: np.ndarray, points: int, breaks: list[float]
) -> None:
    """Of the run, and in each stage, wherever the bump is; samples that are no number are passed over."""
    time = np.arange(rows.shape[1], dtype=np.float32)
    series = np.vstack([time, rows])
    ends = [*breaks, float(rows.shape[1])]
    spans = [("bump" if index == 1 else "cruise", *span) for index, span in enumerate(pairwise([0.0, *ends]))]
    few = decimate(series, points, SamplingHints.of(spans))
    assert min(2, series.shape[1]) <= few.shape[1] <= points
    assert np.all(np.diff(few[0]) > 0)
    indices = few[0].astype(int)
    np.testing.assert_array_equal(few, series[:, indices])
    assert (indices[0], indices[-1]) == (0, series.shape[1] - 1)
    windows = [(0.0, np.inf)] if points >= 4 * len(series) + 4 else []
    windows += list(pairwise([0, *breaks, np.inf])) if points >= 4 * len(series) * (len(breaks) + 1) + 4 else []
    for start, end in windows:
        whole, part = (each[:, (start <= each[0]) & (each[0] < end)] for each in (series, few))
        for extreme in (np.fmax, np.fmin):
            np.testing.assert_array_equal(
                extreme.reduce(part, axis=1, initial=np.nan), extreme.reduce(whole, axis=1, initial=np.nan)
            )
