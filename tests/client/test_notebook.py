"""What a notebook gets: frames, figures, and results that can be pickled."""

import pickle
import sys

import pytest

from ridelab import Ridelab
from tests.client.conftest import RUN, SHORT, Prepared

PEAK = "bump.body_acceleration.peak"


def test_a_run_is_a_frame_and_two_are_compared(ridelab: Ridelab) -> None:
    run = ridelab.run(SHORT, ["lv", "passive"])
    frame = run.frame()
    assert len(run) == len(frame) == 2
    assert frame.loc["lv", PEAK] == run["lv"].figures()[PEAK]
    assert frame.attrs["units"][PEAK] == "m/s^2"
    same = ridelab.compare(run, RUN)
    assert same.loc[("lv", PEAK), "unit"] == "m/s^2"
    assert same["change"].dropna().abs().max() == 0


def test_a_run_is_drawn_by_plotly(ridelab: Ridelab, prepared: Prepared) -> None:
    answer = {"data": [{"type": "scatter", "name": "LV", "x": [0, 1], "y": [1, 2], "meta": {}}], "layout": {}}
    prepared.answers[f"GET /runs/{RUN}/figures/speed"] = answer
    figure = ridelab.run(SHORT, ["lv", "passive"]).plot("speed", x="time")
    assert [(trace.name, tuple(trace.y)) for trace in figure.data] == [("LV", (1, 2))]


def test_results_are_pickled_without_a_login() -> None:
    ridelab = Ridelab("http://user:secret@example.test", token="also-secret")  # noqa: S106  # an example
    content = pickle.dumps(ridelab)
    assert b"secret" not in content
    assert pickle.loads(content).address == "http://example.test"  # noqa: S301  # our own


def test_a_run_outlives_pickling(ridelab: Ridelab) -> None:
    run = pickle.loads(pickle.dumps(ridelab.run(SHORT, ["lv", "passive"])))  # noqa: S301  # our own
    assert run["lv"].figures()[PEAK] == ridelab.get_run(RUN)["lv"].figures()[PEAK]


@pytest.mark.parametrize(("module", "asked"), [("pandas", "frame"), ("plotly.graph_objects", "plot")])
def test_what_is_missing_is_said(
    ridelab: Ridelab, prepared: Prepared, monkeypatch: pytest.MonkeyPatch, module: str, asked: str
) -> None:
    prepared.answers[f"GET /runs/{RUN}/figures/body_acceleration"] = {"data": [], "layout": {}}
    run = ridelab.run(SHORT, ["lv"])
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match=f"pip install {module.partition('.')[0]}"):
        getattr(run, asked)()
