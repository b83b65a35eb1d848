"""Every time-history figure, defined once, in plotly's form.

A template holds the layout and one empty trace for each signal of each strategy (`meta` names them); the browser
fills it with series, `filled` does the same here. Values are SI in series and references; `layout.meta.scale` makes
them the unit shown.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np

from backend.json_types import JsonObject
from backend.outcome import Outcome
from backend.runs.series import ROWS, SeriesArray, packed
from sim_core.catalogue import METRIC_SIGNALS, REFERENCES, SHOWN_UNITS, SIGNALS, STAGES
from sim_core.scenario.recorded import recording_id
from sim_core.strategies import label_of, strategies


@dataclass(frozen=True, slots=True, kw_only=True)
class Style:
    """The look of one strategy everywhere."""

    colour: str
    dark_colour: str  # on a dark screen
    dash: str


_DRAWN = tomllib.loads(Path(__file__).with_name("styles.toml").read_text("utf-8"))
STYLES = {name: Style(**style) for name, style in _DRAWN["strategies"].items()}
OTHERS = [Style(**style) for style in _DRAWN["others"]]  # for custom controllers, in turn
RECORDED = [Style(**style) for style in _DRAWN["recorded"]]  # for recordings, by their id
_GONE = Style(colour="#868E96", dark_colour="#868E96", dash="solid")  # of one that is there no more

NEUTRAL = "#868E96"  # reference lines and stages: 3:1 on white and on #1a1b1e
STAGE_FILLS = {"brake": "rgba(213, 94, 0, 0.10)", "bump": "rgba(0, 114, 178, 0.13)"}  # cruise stays clear
BRAKING = 0.02e6  # the brakes are on from this pressure [Pa]
# An axis spans at least this, in SI by SI unit: what nobody feels must not look like an event.
LEAST_SPANS = {"m/s": 10 / 3.6, "Pa": 0.5e6, "m/s^2": 1.0, "rad/s^2": 1.0, "N": 500.0, "m": 0.01}
BAND_FILL = "rgba(134, 142, 150, 0.2)"
AXES = ("position", "time")
_AXIS = {"zeroline": True, "gridcolor": "rgba(134, 142, 150, 0.25)", "zerolinecolor": "rgba(134, 142, 150, 0.5)"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Panel:
    """One figure: a signal, and the reference lines at `factor` times their value."""

    signal: str
    title: str | None = None
    references: tuple[tuple[str, tuple[float, ...]], ...] = ()
    band: tuple[str, str] | None = None  # centre and half width

    @property
    def shown(self) -> tuple[str, float]:
        """Unit shown and the factor from SI to it."""
        unit = SIGNALS[self.signal].unit
        return SHOWN_UNITS.get(unit, (unit.replace("^2", "²"), 1.0))


def _limits(signal: str) -> tuple[tuple[str, tuple[float, ...]], ...]:
    """The limits of an axle's signal: its travel and force both ways, its tyre's load where it leaves the road."""
    axle, _, what = signal.partition("_")
    line, factors = {"tyre_load": (f"{axle}_static_load", (-1.0,))}.get(what, (f"{what}_limit", (-1.0, 1.0)))
    return ((line, factors),) if line in REFERENCES else ()


# The body beside the tyre that carries it, the front axle before the rear one.
RIDE = ("body_acceleration", "front_tyre_load", "pitch_acceleration", "rear_tyre_load")

PANELS: dict[str, Panel] = {
    "road": Panel(signal="front_road", title="Road"),
    **{signal: Panel(signal=signal, references=_limits(signal)) for signal in dict.fromkeys((*RIDE, *METRIC_SIGNALS))},
    "speed": Panel(signal="speed", references=(("target_speed", (1.0,)),), band=("target_speed", "target_band")),
    "brake_pressure": Panel(signal="brake_pressure"),
}


def style_of(strategy: str) -> Style:
    """Return the look of a strategy."""
    if (recording := recording_id(strategy)) is not None:
        return RECORDED[sum(recording.encode()) % len(RECORDED)]
    if strategy in STYLES:
        return STYLES[strategy]
    others = [name for name in strategies() if name not in STYLES]
    return OTHERS[others.index(strategy) % len(OTHERS)] if strategy in others else _GONE


def templates() -> JsonObject:
    """Figure name -> plotly figure as plain JSON values, traces without data; in the order of display."""
    labels = tuple((name, each.label) for name, each in strategies().items())
    return {name: _template(panel, labels) for name, panel in PANELS.items()}


def filled(name: str, outcomes: Mapping[str, Outcome], axis: str) -> JsonObject:
    """One figure with a run's data, its stages shaded and its reference lines drawn.

    Args:
        name: A key of `PANELS`.
        outcomes: By strategy; those without series are left out.
        axis: `position` or `time`, for x.
    """
    members = {name: outcome.series for name, outcome in outcomes.items() if outcome.series is not None}
    offered = {name: each.label for name, each in strategies().items()}
    labels = {**offered, **{name: label_of(name) for name in members if name not in offered}}
    panel = PANELS[name]
    template = _template(panel, tuple(labels.items()))
    summaries = {name: outcomes[name].summary for name in members}
    scale = np.float32(panel.shown[1])
    traces = [
        {
            **trace,
            "x": packed(members[strategy][ROWS[axis]]),
            "y": packed(members[strategy][ROWS[panel.signal]] * scale),
        }
        for trace in template["data"]
        if (strategy := trace["meta"]["strategy"]) in members
    ]
    shapes = [*stage_shapes(summaries, members, axis), *_references(panel, summaries)]
    x_axis = {**template["layout"]["xaxis"], "title": {"text": _axis_title(axis)}}
    return {"data": traces, "layout": {**template["layout"], "xaxis": x_axis, "shapes": shapes}}


@lru_cache(4 * len(PANELS))
def _template(panel: Panel, labels: tuple[tuple[str, str], ...]) -> JsonObject:
    """A panel's figure with an empty trace for each strategy, given its id and label."""
    unit, scale = panel.shown
    title = panel.title or SIGNALS[panel.signal].label
    traces = [
        {
            "type": "scatter",
            "name": name,
            "mode": "lines",
            "line": {"color": style.colour, "dash": style.dash, "width": 1.5},
            "legendgroup": strategy,
            "hovertemplate": f"%{{y:.4~g}} {unit}" if unit != "1" else "%{y:.4~g}",
            "meta": {"strategy": strategy, "signal": panel.signal},
        }
        for strategy, name in labels
        for style in [style_of(strategy)]
    ]
    meta = {
        "title": title,
        "unit": unit,
        "scale": scale,
        "signal": panel.signal,
        "least_span": scale * LEAST_SPANS.get(SIGNALS[panel.signal].unit, 0.0),
        "braking": BRAKING,
        "reference": [key for key, _ in panel.references],
        "reference_factors": {key: list(factors) for key, factors in panel.references},
        "reference_labels": {key: REFERENCES[key].label for key, _ in panel.references},
        "band": list(panel.band) if panel.band else None,
        "axes": {key: _axis_title(key) for key in AXES},
        "stage_fills": STAGE_FILLS,
        "band_fill": BAND_FILL,
        "neutral": NEUTRAL,
    }
    layout = {
        **_DRAWN["layout"],
        "title": {"text": title},
        "meta": meta,
        "xaxis": {"title": {"text": _axis_title(AXES[0])}, **_AXIS},
        "yaxis": {"title": {"text": f"{title} [{unit}]"}, **_AXIS},
    }
    return {"data": traces, "layout": layout}


def _axis_title(axis: str) -> str:
    return f"{SIGNALS[axis].label} [{SIGNALS[axis].unit}]"


def stage_shapes(
    summaries: Mapping[str, JsonObject], members: Mapping[str, SeriesArray], axis: str
) -> list[JsonObject]:
    """Shaded bands: the stages of the first strategy that brakes, else of the first; they lie at the same places.

    Braking is shaded only where there is pressure. The page has the same rule (frontend/src/plots/shapes.ts).
    """
    staged = next((name for name in summaries if "brake" in _names(summaries[name])), next(iter(summaries), None))
    if staged is None:
        return []
    spans = [(span["stage"], (span[f"start_{axis}"], span[f"end_{axis}"])) for span in summaries[staged]["stages"]]
    bounded = [(stage, _pressed(members[staged], axis, ends) if stage == "brake" else ends) for stage, ends in spans]
    return [
        {
            "type": "rect",
            "xref": "x",
            "yref": "paper",
            "x0": ends[0],
            "x1": ends[1],
            "y0": 0,
            "y1": 1,
            "layer": "below",
            "line": {"width": 0},
            "fillcolor": STAGE_FILLS[stage],
            "name": STAGES[stage].label,
        }
        for stage, ends in bounded
        if stage in STAGE_FILLS and ends is not None
    ]


def _names(summary: JsonObject) -> list[str]:
    return [span["stage"] for span in summary["stages"]]


def _pressed(series: SeriesArray, axis: str, ends: tuple[float, float]) -> tuple[float, float] | None:
    """From the first to the last sample between the ends at which the brakes are on; None where there is none."""
    x, pressure = series[ROWS[axis]], series[ROWS["brake_pressure"]]
    at = x[(x >= ends[0]) & (x <= ends[1]) & (pressure >= BRAKING)]
    return (float(at[0]), float(at[-1])) if len(at) else None


def _references(panel: Panel, summaries: Mapping[str, JsonObject]) -> list[JsonObject]:
    """Horizontal lines, each distinct value once, and the band around one of them."""
    scale = panel.shown[1]
    common: dict[str, float] = {}
    for summary in summaries.values():
        common |= {key: value for key, value in summary["reference"].items() if value is not None}
    lines = [
        _across(factor * common[key] * scale, factor * common[key] * scale, REFERENCES[key].label)
        for key, factors in panel.references
        if key in common
        for factor in factors
    ]
    if panel.band and all(key in common for key in panel.band):
        centre, half = (common[key] * scale for key in panel.band)
        lines.append(_across(centre - half, centre + half, f"{REFERENCES[panel.band[0]].label} ± {half:.3g}"))
    return lines


def _across(low: float, high: float, label: str) -> JsonObject:
    """A line over the whole width, or a band where the two values differ."""
    shape = {"xref": "paper", "yref": "y", "x0": 0, "x1": 1, "y0": low, "y1": high, "layer": "below", "name": label}
    if low == high:
        return {**shape, "type": "line", "line": {"color": NEUTRAL, "dash": "dash", "width": 1}}
    return {**shape, "type": "rect", "line": {"width": 0}, "fillcolor": BAND_FILL}
