"""Figures 3-6, 8, 10-17 and 19-22 of the paper, drawn from our own runs."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from backend.json_types import JsonObject
from backend.outcome import Outcome
from backend.paper.models import PaperFigure
from backend.paper.paper_rows import SPEEDS_KMH
from backend.runs.figures import PANELS, STYLES, filled, templates
from backend.runs.series import packed
from sim_core.catalogue import PAPER_SIGNALS, SIGNALS
from sim_core.comparison.intervals import mean_with_interval
from sim_core.strategies import STRATEGIES

# First figure of each group of four (one for every paper signal) -> its title and whom it shows.
GROUPS: dict[int, tuple[str, tuple[str, ...]]] = {
    10: ("single controls and no control", ("passive", "speed_only", "suspension_only")),
    14: ("LV control and single controls", ("speed_only", "suspension_only", "lv")),
    19: ("hardware in the loop, LV control and LQR", ("lv", "lv_hil", "lqr")),
}
SPEED_FIGURE, SPEED_STRATEGY = 8, "lv"
PEAK_FIGURE = 3
BAND = "rgba(28, 95, 223, 0.18)"

Peaks = Sequence[Mapping[str, Sequence[Sequence[float]]]]


def all_figures(peaks: Peaks, outcomes: Mapping[str, Outcome]) -> list[PaperFigure]:
    """Every figure, in the paper's order.

    Args:
        peaks: For each road the passive car's peaks over speed (`backend.paper.paper_rows.peaks_over_speed`).
        outcomes: The paper's scenario on its first road, by strategy, with time histories.
    """
    drawn = [_over_speed(PEAK_FIGURE + index, index, peaks) for index in range(len(PAPER_SIGNALS))]
    drawn.append(_speed_curve(outcomes))
    for first, (title, names) in GROUPS.items():
        for index, signal in enumerate(PAPER_SIGNALS):
            drawn.append(_histories(first + index, signal, title, {name: outcomes[name] for name in names}))
    return drawn


def _histories(number: int, signal: str, title: str, outcomes: Mapping[str, Outcome]) -> PaperFigure:
    figure = filled(signal, outcomes, "position")
    peaks = ", ".join(
        f"{STRATEGIES[name].label} {outcome.summary['metrics']['bump'][signal]['peak']:.4g}"
        for name, outcome in outcomes.items()
        if outcome.status == "ok"
    )
    unit = _unit(signal)
    missing = "".join(
        f" {STRATEGIES[name].label} is not available here. {outcome.summary['reason']}."
        for name, outcome in outcomes.items()
        if outcome.status != "ok"
    )
    return PaperFigure(
        number=number,
        title=f"{SIGNALS[signal].label}: {title}",
        caption=f"Road 1 of the paper's scenario. Peaks on the bump: {peaks} {unit}.{missing}",
        figure=figure,
    )


def _speed_curve(outcomes: Mapping[str, Outcome]) -> PaperFigure:
    lv = outcomes[SPEED_STRATEGY]
    arrival = lv.summary.get("arrival_speed_kmh")
    caption = "LV control did not run."
    if arrival is not None:
        caption = f"LV control reaches the bump at {arrival:.1f} km/h; the paper aims at 20 to 25 km/h."
    return PaperFigure(
        number=SPEED_FIGURE,
        title="Speed change curve",
        caption=caption,
        figure=filled("speed", {SPEED_STRATEGY: lv}, "position"),
    )


def _over_speed(number: int, index: int, peaks: Peaks) -> PaperFigure:
    signal = PAPER_SIGNALS[index]
    unit, scale = PANELS[signal].shown
    speeds = np.array(SPEEDS_KMH, dtype=np.float32)
    rough = [mean_with_interval([run["rough"][row][index] for run in peaks]) for row in range(len(speeds))]
    smooth = np.array([peaks[0]["smooth"][row][index] for row in range(len(speeds))])
    mean, low, high = (np.array([getattr(item, end) for item in rough]) for end in ("value", "low", "high"))
    colour = STYLES["passive"].colour
    band = np.concatenate([high, low[::-1]])
    layout = templates()[signal]["layout"]
    title = f"Peak {SIGNALS[signal].label[0].lower()}{SIGNALS[signal].label[1:]}"
    data = [
        {
            "type": "scatter",
            "name": "95 % interval",
            "x": packed(np.concatenate([speeds, speeds[::-1]])),
            "y": packed((band * scale).astype(np.float32)),
            "fill": "toself",
            "fillcolor": BAND,
            "line": {"width": 0},
            "mode": "lines",
            "hoverinfo": "skip",
        },
        _line(f"Passive, class B road, mean of {len(peaks)} roads", speeds, mean * scale, colour, "solid", unit),
        _line("Passive, smooth road", speeds, smooth * scale, STYLES["lv"].colour, "dash", unit),
    ]
    at_20, at_50 = (float(mean[SPEEDS_KMH.index(speed)]) for speed in (20, 50))
    rises = "rises" if mean[-1] > mean[0] else "falls"
    return PaperFigure(
        number=number,
        title=f"{title} over speed",
        caption=f"Ours {rises} from {at_20:.4g} {_unit(signal)} at 20 km/h to {at_50:.4g} {_unit(signal)} at "
        f"50 km/h, and is greatest at {SPEEDS_KMH[int(mean.argmax())]} km/h."
        + (" Section 2.2.3 says pitch acceleration falls with speed." if signal == "pitch_acceleration" else ""),
        figure={
            "data": data,
            "layout": {
                **layout,
                "title": {"text": title},
                "meta": {"title": title, "unit": unit, "least_span": 0.0},
                "xaxis": {**layout["xaxis"], "title": {"text": "Speed [km/h]"}},
                "yaxis": {**layout["yaxis"], "title": {"text": f"{title} [{unit}]"}},
            },
        },
    )


def _line(name: str, x: Any, y: Any, colour: str, dash: str, unit: str) -> JsonObject:
    return {
        "type": "scatter",
        "name": name,
        "mode": "lines+markers",
        "x": packed(x),
        "y": packed(np.asarray(y, dtype=np.float32)),
        "line": {"color": colour, "dash": dash, "width": 1.5},
        "hovertemplate": f"%{{y:.4~g}} {unit}",
    }


def _unit(signal: str) -> str:
    return SIGNALS[signal].unit.replace("^2", "²")
