"""Figure templates and filled figures."""

import json
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import plotly.graph_objects as go
import pytest

from backend.models import Figures
from backend.runs.figures import OTHERS, PANELS, STAGE_FILLS, STYLES, stage_shapes
from backend.runs.series import ROWS
from sim_core.catalogue import REFERENCES, SIGNALS
from sim_core.strategies import STRATEGIES
from tests.api.test_series import unpack


def luminance(colour: str) -> float:
    """Relative luminance (WCAG 2.2)."""
    channels = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    linear = [value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4 for value in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


DARK = "#1a1b1e"


def blended(fill: str, background: str) -> str:
    """The colour of a half transparent fill on a background."""
    *channels, alpha = (float(part) for part in fill.removeprefix("rgba(").removesuffix(")").split(","))
    below = [int(background[i : i + 2], 16) for i in (1, 3, 5)]
    return "#" + "".join(f"{round(low + alpha * (high - low)):02x}" for low, high in zip(below, channels, strict=True))


def test_colours_are_legible_on_both_themes_and_dashes_differ() -> None:
    assert list(STYLES) == list(STRATEGIES)
    styles = [*STYLES.values(), *OTHERS]
    for style in styles:
        assert min(contrast(style.colour, background) for background in ("#ffffff", DARK)) >= 3
        for background in (DARK, *(blended(fill, DARK) for fill in STAGE_FILLS.values())):
            assert contrast(style.dark_colour, background) >= 4.5
    assert len({style.dash for style in styles}) == len(styles)


def test_templates_name_what_fills_them(client: httpx.Client) -> None:
    answer = client.get("/api/v1/figures").json()
    Figures.model_validate(answer)
    assert list(answer["figures"]) == list(PANELS)
    for name, figure in answer["figures"].items():
        go.Figure(figure)  # plotly itself accepts it
        assert [trace["meta"]["strategy"] for trace in figure["data"]] == list(STRATEGIES)
        meta = figure["layout"]["meta"]
        assert {trace["meta"]["signal"] for trace in figure["data"]} == {meta["signal"]} <= set(SIGNALS)
        assert all("x" not in trace and "y" not in trace for trace in figure["data"])
        assert set(meta["reference"]) == set(meta["reference_factors"]) <= set(REFERENCES)
        assert meta["unit"] in figure["layout"]["yaxis"]["title"]["text"], name


@pytest.mark.parametrize("axis", ["position", "time"])
def test_filled_figures_hold_the_runs_data(client: httpx.Client, run: dict[str, Any], axis: str) -> None:
    answer = client.get(f"/api/v1/runs/{run['id']}/figures", params={"x": axis}).json()["figures"]
    assert list(answer) == list(PANELS)
    series = client.get(f"/api/v1/runs/{run['id']}/series?strategy=lv,lqr,passive&points=2000&encoding=base64").json()
    for name, figure in answer.items():
        go.Figure(figure)
        assert [trace["meta"]["strategy"] for trace in figure["data"]] == ["lv", "lqr", "passive"]
        scale = figure["layout"]["meta"]["scale"]
        for trace in figure["data"]:
            source = series["strategies"][trace["meta"]["strategy"]]
            np.testing.assert_array_equal(unpack(trace["x"]), unpack(source[axis]))
            expected = unpack(source[trace["meta"]["signal"]]) * np.float32(scale)
            np.testing.assert_allclose(unpack(trace["y"]), expected, rtol=1e-6)
        single = client.get(f"/api/v1/runs/{run['id']}/figures/{name}", params={"x": axis})
        assert single.json() == figure


def test_filled_figures_draw_the_references(client: httpx.Client, run: dict[str, Any]) -> None:
    reference = run["strategies"]["lv"]["reference"]
    figures = client.get(f"/api/v1/runs/{run['id']}/figures").json()["figures"]
    limit, target = reference["deflection_limit"] * 1000, reference["target_speed"] * 3.6
    for name, expected in (("front_deflection", {-limit, limit}), ("speed", {target}), ("body_acceleration", set())):
        drawn = {round(shape["y0"], 6) for shape in figures[name]["layout"]["shapes"] if shape["yref"] == "y"}
        assert {round(height, 6) for height in expected} <= drawn, name


@pytest.mark.parametrize("axis", ["position", "time"])
def test_stages_are_shaded_by_the_rule_the_page_has(axis: str) -> None:
    """The same file holds the page's renderer to it (frontend/src/plots/plots.test.ts)."""
    case = json.loads((Path(__file__).parents[1] / "data" / "stage_shapes.json").read_text())
    series = {}
    for name, strategy in case["strategies"].items():
        series[name] = np.zeros((len(ROWS), len(strategy["time"])), dtype=np.float32)
        for key in ("time", "position", "brake_pressure"):
            series[name][ROWS[key]] = strategy[key]
    shapes = stage_shapes(case["strategies"], series, axis)
    assert [(shape["fillcolor"], shape["x0"], shape["x1"]) for shape in shapes] == [
        (STAGE_FILLS[stage], low, high) for stage, low, high in case["shaded"][axis]
    ]
