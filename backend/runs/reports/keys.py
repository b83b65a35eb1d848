"""A strategy's label, and its line in a figure's key."""

from backend.json_types import JsonObject
from backend.runs import figures
from sim_core.strategies import label_of

# Plotly's named dashes as SVG's, for lines two wide; others are lengths.
_DASHES = {
    "solid": "",
    "dash": "7 3",
    "dashdot": "7 3 2 3",
    "longdash": "11 3",
    "longdashdot": "11 3 2 3",
    "dot": "2 3",
}


def inside(text: str) -> str:
    """A label within a sentence: `passive`, but `LQR`."""
    return text if text[:2].isupper() else text[:1].lower() + text[1:]


def key_of(strategy: str) -> dict[str, str]:
    """A strategy's label and line style."""
    style = figures.style_of(strategy)
    return {"id": strategy, "label": label_of(strategy), "colour": style.colour, "dash": _svg(style.dash)}


def line_of(trace: JsonObject) -> dict[str, str]:
    """The key of a line, or of a filled band, as its trace has it."""
    if "fillcolor" in trace:
        return {"label": trace["name"], "colour": trace["fillcolor"], "dash": "", "width": "10"}
    line = trace["line"]
    return {"label": trace["name"], "colour": line["color"], "dash": _svg(line["dash"])}


def _svg(dash: str) -> str:
    return _DASHES.get(dash, dash.replace("px", "").replace(",", " "))
