"""The report of the paper's reproduction."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from backend.runs.reports import inputs
from backend.runs.reports.drawings import caption, framed
from backend.runs.reports.keys import label
from backend.runs.reports.numbers import exact, percent, pretty_unit, significant
from backend.runs.reports.page import Report, render
from sim_core import __version__ as CORE_VERSION
from sim_core.catalogue import COMFORT, RUN_FIGURES, SIGNALS, STATISTICS, WINDOWS

MARKS = {"reached": "✔", "smaller": "◐", "contradicts": "✘"}
UNAVAILABLE = "unavailable"  # a verdict that is none
_MINUS = re.compile(r"(?<![\w-])-(?=\d)")
FACTORS = {"speed": "Lower speed", "preview": "Preview", "switching": "Switching weights"}


def report(
    reproduction: Mapping[str, Any],
    attribution: Mapping[str, Any],
    figures: Sequence[Mapping[str, Any]],
    *,
    compressed: bool,
) -> Report:
    """The paper, checked, as one file.

    Args:
        reproduction: As `PaperAnswer`.
        attribution: As `AttributionAnswer`.
        figures: As in `PaperFigures`.
        compressed: Whether whoever asked takes gzip.
    """
    drawn = {f"figure-{item['number']}": framed(item["figure"]) for item in figures}
    captions = [
        {
            **caption(name, figure),
            "heading": f"Fig. {item['number']}: {item['title']}",
            "caption": item["caption"],
        }
        for item, (name, figure) in zip(figures, drawn.items(), strict=True)
    ]
    values = {
        "core_version": CORE_VERSION,
        "seeds": reproduction["seeds"],
        "first_seed": reproduction["first_seed"],
        "interpretation": reproduction["interpretation"],
        "interpretations": reproduction["interpretations"],
        "reached": reproduction["reached"],
        "total": reproduction["total"],
        "counts": [_count(name, number, reproduction["total"]) for name, number in reproduction["counts"].items()],
        "unavailable": reproduction["unavailable"],
        "without": reproduction["without_preview"],
        "readings": [_reading(item) for item in reproduction["readings"]],
        "parts": inputs.parts(reproduction["scenario"]),
        "tables": [_table(table, reproduction["cells"]) for table in reproduction["tables"]],
        "sentences": [_MINUS.sub("−", text) for text in attribution["sentences"]],
        "factors": FACTORS,
        "shares": [_share(item) for item in attribution["shares"]],
        "span": _span(attribution["shares"]),
        "combinations": _combinations(attribution["rows"]),
        "equal_speed": _equal_speed(attribution["equal_speed"]),
        "figures": captions,
        "errata": reproduction["errata"],
        "rules": reproduction["rules"],
        "marks": MARKS,
    }
    return render("paper.html", values, drawn, compressed=compressed)


def _count(verdict: str, number: int, total: int) -> dict[str, Any]:
    return {"verdict": verdict, "mark": MARKS[verdict], "number": number, "share": round(100 * number / total, 2)}


def _reading(item: Mapping[str, Any]) -> dict[str, Any]:
    choices = {choice["id"]: choice for choice in item["choices"]}
    chosen = choices[item["chosen"]]
    default = next(choice["label"] for choice in item["choices"] if choice["default"])
    return {
        "title": item["title"],
        "description": item["description"],
        "chosen": chosen["label"],
        "source": chosen["source"],
        "default": None if chosen["default"] else default,
        "others": [choice["label"] for choice in item["choices"] if choice is not chosen],
    }


def _table(table: Mapping[str, Any], cells: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """One of the paper's tables: its two comparisons below each other, a row for each signal."""
    return {
        "number": table["number"],
        "title": table["title"],
        "comparisons": [
            {
                "title": f"{label(pair['strategy'])} against {_inside(label(pair['against']))}",
                "rows": [
                    _row(cell)
                    for cell in cells
                    if (cell["table"], cell["strategy"], cell["against"])
                    == (table["number"], pair["strategy"], pair["against"])
                ],
            }
            for pair in table["columns"]
        ],
    }


def _row(cell: Mapping[str, Any]) -> dict[str, Any]:
    quantity = SIGNALS[cell["signal"]]
    misprint = cell["misprint"]
    return {
        "id": f"{cell['table']}.{cell['strategy']}.{cell['against']}.{cell['signal']}",
        "signal": quantity.label,
        "unit": pretty_unit(quantity.unit),
        "paper": [exact(cell["paper_base"]), exact(cell["paper_value"])],
        "paper_change": _printed(cell["paper_change"]),
        "follows": None if misprint is None else _printed(misprint["follows"]),
        "ours": [significant(cell["our_base"]), _shown(cell["our_value"])],
        "judged": _judged(cell),
        "without": None if cell["without_preview"] is None else _judged(cell["without_preview"]),
    }


def _shown(value: float | None) -> str:
    return "–" if value is None else significant(value)


def _judged(item: Mapping[str, Any]) -> dict[str, Any]:
    if item["verdict"] == UNAVAILABLE:
        return {"verdict": UNAVAILABLE, "change": "–"}
    return {
        "raw": item["our_change"],
        "change": percent(item["our_change"]),
        "interval": " to ".join(percent(end) for end in item["ci"]),
        "verdict": item["verdict"],
        "certain": item["certain"],
    }


def _printed(printed: float) -> str:
    """A change as the paper prints it, with all of its digits."""
    sign = "−" if printed < 0 else "+"
    return f"{sign}{abs(printed):g}\u2009%"


def _share(item: Mapping[str, Any]) -> dict[str, Any]:
    return {
        "figure": _figure(item),
        "total": percent(item["total_change"]),
        "parts": {factor: f"{item[factor]:.0f}".replace("-", "−") for factor in FACTORS},
        "raw": {factor: item[factor] for factor in FACTORS},
    }


def _span(shares: Sequence[Mapping[str, Any]]) -> tuple[float, float]:
    """Where the bars of all shares begin and end: negative ones lie left of zero, the others right of it [%]."""
    parts = [[item[factor] for factor in FACTORS] for item in shares]
    low = min(sum(part for part in each if part < 0) for each in parts)
    return low, max(sum(part for part in each if part > 0) for each in parts)


def _combinations(rows: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Every combination: travel time and comfort beside its eight figures."""
    comfort, time = COMFORT["weighted_rms"], RUN_FIGURES["travel_time"]
    metrics = rows[0]["metrics"]
    return {
        "heads": [
            {"label": time.label, "unit": time.unit},
            {"label": comfort.label, "unit": pretty_unit(comfort.unit)},
            *({"label": _figure(item), "unit": pretty_unit(SIGNALS[item["signal"]].unit)} for item in metrics),
        ],
        "rows": [
            {
                "label": row["label"],
                "same_as": None if row["is"] is None else label(row["is"]),
                "cells": [
                    {"shown": significant(row["travel_time"]), "change": None},
                    {"shown": significant(row["comfort"]["weighted_rms"]["value"]), "change": None},
                    *(
                        {"shown": significant(item["value"]), "change": percent(item["change_vs_passive"])}
                        for item in row["metrics"]
                    ),
                ],
            }
            for row in rows
        ],
    }


def _equal_speed(pairs: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    return {
        "heads": [_figure(cell) for cell in pairs[0]["cells"]],
        "rows": [
            {
                "label": pair["label"],
                "cells": [
                    {
                        "change": percent(cell["our_change"]),
                        "interval": " to ".join(percent(end) for end in cell["ci"]),
                        "verdict": "better" if cell["ci"][1] < 0 else "worse" if cell["ci"][0] > 0 else "",
                    }
                    for cell in pair["cells"]
                ],
            }
            for pair in pairs
        ],
    }


def _figure(item: Mapping[str, Any]) -> str:
    """`RMS, rough road: body acceleration`."""
    statistic, window = STATISTICS[item["statistic"]].label, WINDOWS[item["window"]].label.lower()
    return f"{statistic}, {window}: {_inside(SIGNALS[item['signal']].label)}"


def _inside(text: str) -> str:
    """A label inside a sentence: `passive`, but `LQR`."""
    return text if text[:2].isupper() else text[:1].lower() + text[1:]
