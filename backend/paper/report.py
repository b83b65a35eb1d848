"""The report of the paper's reproduction; its words and tables are in templates/paper.html."""

from collections.abc import Sequence

from backend.paper.models import AttributionAnswer, PaperAnswer, PaperFigure, Share
from backend.runs.reports import inputs
from backend.runs.reports.drawings import caption, framed
from backend.runs.reports.page import Report, render
from sim_core.catalogue import COMFORT, RUN_FIGURES, SIGNALS

MARKS = {"reached": "✔", "smaller": "◐", "contradicts": "✘"}
FACTORS = {"speed": "Lower speed", "preview": "Preview", "switching": "Switching weights"}


def report(
    reproduction: PaperAnswer, attribution: AttributionAnswer, figures: Sequence[PaperFigure], *, compressed: bool
) -> Report:
    """The reproduction as one HTML file.

    Args:
        reproduction: Its tables and what is read how.
        attribution: What each part contributes.
        figures: Its figures.
        compressed: Whether whoever asked takes gzip.
    """
    drawn = {f"figure-{item.number}": framed(item.figure) for item in figures}
    captions = [
        {**caption(name, figure), "heading": f"Fig. {item.number}: {item.title}", "caption": item.caption}
        for item, (name, figure) in zip(figures, drawn.items(), strict=True)
    ]
    values = dict(reproduction) | {
        "parts": inputs.parts(reproduction.scenario.model_dump(mode="json")),
        "attribution": attribution,
        "span": _span(attribution.shares),
        "figures": captions,
        "factors": FACTORS,
        "marks": MARKS,
        "signals": SIGNALS,
        "heads": [RUN_FIGURES["travel_time"], COMFORT["weighted_rms"]],
    }
    return render("paper.html", values, drawn, compressed=compressed)


def _span(shares: Sequence[Share]) -> tuple[float, float]:
    """Return where the bars of all shares begin and end: negative ones lie left of zero, the others right of it [%]."""
    parts = [[getattr(item, factor) for factor in FACTORS] for item in shares]
    low = min(sum(part for part in each if part < 0) for each in parts)
    return low, max(sum(part for part in each if part > 0) for each in parts)
