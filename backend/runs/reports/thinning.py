"""Thinning of curves to the samples that a report shows."""

from collections.abc import Mapping

import numpy as np

from backend.json_types import JsonObject
from backend.runs.series import SamplingHints, decimate, packed, unpacked
from sim_core.catalogue import BUMP, STAGES

POINTS = 800  # a curve; no report is drawn finer
TOTAL = 40_000  # samples of all curves: 0.43 MB


def thinned(figures: Mapping[str, JsonObject]) -> dict[str, JsonObject]:
    """Figures whose curves keep their peaks and have at most `POINTS` samples; fewer where there are many curves."""
    curves = sum(len(figure["data"]) for figure in figures.values())
    points = min(POINTS, TOTAL // max(1, curves))
    return {name: _thinned(figure, points) for name, figure in figures.items()}


def _thinned(figure: JsonObject, points: int) -> JsonObject:
    spans = [shape for shape in figure["layout"].get("shapes", ()) if shape["xref"] == "x"]
    bump = next(((shape["x0"], shape["x1"]) for shape in spans if shape["name"] == STAGES[BUMP].label), None)
    stages = SamplingHints(tuple(sorted(shape[end] for shape in spans for end in ("x0", "x1"))), bump)
    return {**figure, "data": [_few(trace, points, stages) for trace in figure["data"]]}


def _few(trace: JsonObject, points: int, stages: SamplingHints) -> JsonObject:
    x, y = decimate(np.stack([unpacked(trace["x"]), unpacked(trace["y"])]), points, stages)
    return {**trace, "x": packed(x), "y": packed(y)}
