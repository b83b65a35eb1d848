"""Figures of a report: the part of each axis that is shown, and the words below it."""

import numpy as np

from backend.json_types import JsonObject
from backend.runs.reports.keys import line_of
from backend.runs.series import unpacked
from sim_core.comparison.numbers import ZERO_TOLERANCE, significant, with_unit

NEAR = 0.6  # a reference line at most so far beyond the curves is brought into view [spans of the curves]
PADDING = 0.05


def framed(figure: JsonObject) -> JsonObject:
    """A filled figure with its y axis around the curves and those reference lines that are near them.

    The axis has no title: the heading above the figure says signal and unit.
    """
    values = [unpacked(trace["y"]) for trace in figure["data"]]
    values = [there for each in values if len(there := each[np.isfinite(each)])]
    if not values:
        return figure
    low, high = min(float(each.min()) for each in values), max(float(each.max()) for each in values)
    margin = NEAR * max(high - low, ZERO_TOLERANCE)
    for shape in figure["layout"].get("shapes", ()):
        if shape["yref"] == "y" and low - margin <= shape["y0"] and shape["y1"] <= high + margin:
            low, high = min(low, shape["y0"]), max(high, shape["y1"])
    missing = max(0.0, figure["layout"]["meta"]["least_span"] - (high - low)) / 2
    low, high = low - missing, high + missing
    room = PADDING * (high - low) if high > low else max(abs(high), 1.0)
    y_axis = {**figure["layout"]["yaxis"], "range": [low - room, high + room], "title": None}
    return {**figure, "layout": {**figure["layout"], "yaxis": y_axis}}


def caption(name: str, figure: JsonObject) -> JsonObject:
    """A figure's title, unit, key of lines, and what is shaded, dashed, or outside the axis."""
    layout = figure["layout"]
    low, high = layout["yaxis"].get("range", (0.0, 0.0))
    shapes = layout.get("shapes", ())
    shaded = {shape["name"] for shape in shapes if shape["xref"] == "x"}
    lines = [shape for shape in shapes if shape["yref"] == "y"]
    near = {shape["name"] for shape in lines if low <= shape["y0"] and shape["y1"] <= high}
    far: dict[str, list[float]] = {}
    for shape in lines:
        if shape["name"] not in near:
            far.setdefault(shape["name"], []).append(shape["y0"])
    unit = layout["meta"]["unit"]
    notes = [f"shaded: {', '.join(sorted(shaded)).lower()}"] if shaded else []
    notes += [f"grey: {', '.join(sorted(near)).lower()}"] if near else []
    notes += [
        f"beyond the plot: {each.lower()} ({', '.join(with_unit(significant(value), unit) for value in values)})"
        for each, values in sorted(far.items())
    ]
    return {
        "name": name,
        "title": layout["meta"]["title"],
        "unit": unit,
        "keys": [line_of(trace) for trace in figure["data"]],
        "notes": "; ".join(notes),
    }
