"""Values of many runs as the paper page's answers."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

from backend.jobs.reproduction.rows import Rows
from sim_core import __version__ as CORE_VERSION
from sim_core.study import paper
from sim_core.study.attribution import COMFORT_FIGURES, EQUAL_SPEED, FACTORS, VARIANTS, compared, sentences, shares
from sim_core.study.errata import ERRATA
from sim_core.study.interpretations import INTERPRETATIONS, interpretation_of
from sim_core.study.intervals import Interval, change_with_interval, mean_with_interval
from sim_core.study.paper import FIGURES, Judged
from sim_core.study.paper_tables import TABLES, PaperCell, cells
from sim_core.study.readings import READINGS, changes_of


def reproduction(
    chosen: Mapping[str, str],
    roads: range,
    ours: paper.Values,
    without_preview: paper.Values,
    named: Mapping[str, paper.Values],
    rows: Rows,
) -> dict[str, Any]:
    """`PaperAnswer`.

    Args:
        chosen: Reading -> choice, all of them.
        roads: Their seeds.
        ours: By strategy, under these readings, of those that are complete.
        without_preview: The same without preview.
        named: The same under each named set.
        rows: What all are made of; where hardware in the loop is not available all are judged without it.
    """
    if rows.reason is not None:
        ours, without_preview = _simulated(ours), _simulated(without_preview)
        named = {name: _simulated(values) for name, values in named.items()}
    judged, blind = paper.judge(ours), paper.judge(without_preview)
    blind_counts = paper.count(blind)
    by_cell, blind_by_cell = ({item.cell: item for item in items} for items in (judged, blind))
    return {
        "core_version": CORE_VERSION,
        **_roads(roads),
        "interpretation": interpretation_of(chosen),
        **_counted(judged),
        "interpretations": [
            {
                "id": item.id,
                "title": item.title,
                "description": item.description,
                "choices": item.choices,
                "changes": changes_of(item.otherwise),
                **_counted(paper.judge(named[item.id])),
            }
            for item in INTERPRETATIONS.values()
        ],
        "unavailable": unavailable(rows.reason),
        "complete": rows.complete,
        "progress": {"done": len(rows.by_key), "total": rows.total},
        "without_preview": {"reached": blind_counts["reached"], "counts": blind_counts},
        "scenario": paper.scenario_for(chosen, 1).model_dump(mode="json"),
        "cells": [_cell(cell, by_cell.get(cell), blind_by_cell.get(cell), ours, rows) for cell in cells()],
        "readings": [
            {
                "id": reading.id,
                "title": reading.title,
                "description": reading.description,
                "chosen": chosen[reading.id],
                "choices": [
                    {
                        "id": choice.id,
                        "label": choice.label,
                        "default": choice.id == reading.default,
                        "source": choice.source,
                    }
                    for choice in reading.choices
                ],
            }
            for reading in READINGS.values()
        ],
        "rules": paper.RULES,
        "tables": [
            {
                "number": table.number,
                "title": table.title,
                "columns": [{"strategy": strategy, "against": against} for strategy, against, _ in table.columns],
            }
            for table in TABLES
        ],
        "errata": [{"place": item.place, "printed": item.printed, "here": item.here} for item in ERRATA],
    }


def unavailable(reason: str | None) -> dict[str, Any] | None:
    """`Unavailable`: the cells of hardware in the loop, where there is a reason."""
    if reason is None:
        return None
    return {"cells": sum(cell.strategy == paper.IN_ECU for cell in cells()), "reason": reason}


def _simulated(values: paper.Values) -> paper.Values:
    return {name: values[name] for name in paper.SIMULATED if name in values}


def reading_row(reading: str, choice: str, base: Sequence[Judged], judged: Sequence[Judged]) -> dict[str, Any]:
    """`ReadingRow`."""
    counts, before = paper.count(judged), {item.cell: item.verdict for item in base}
    return {
        "reading": reading,
        "choice": choice,
        "reached": counts["reached"],
        "total": len(judged),
        "counts": counts,
        "changed": sum(before.get(item.cell, item.verdict) is not item.verdict for item in judged),
    }


def _roads(roads: range) -> dict[str, int]:
    return {"seeds": len(roads), "first_seed": roads[0]}


def _counted(judged: Sequence[Judged]) -> dict[str, Any]:
    """`Counted`."""
    counts, (simulated, in_ecu) = paper.count(judged), paper.split(judged)
    return {
        "reached": counts["reached"],
        "total": len(judged),
        "counts": counts,
        "simulated": _part(simulated),
        "ecu": _part(in_ecu),
        "agreement": asdict(paper.agreement(judged)),
    }


def _part(judged: Sequence[Judged]) -> dict[str, int]:
    return {"reached": paper.count(judged)["reached"], "total": len(judged)}


def attribution(roads: range, runs: Sequence[Mapping[str, Mapping[str, Any]]]) -> dict[str, Any]:
    """`AttributionAnswer` from a row for each road: variant -> its figures."""
    values = {variant.id: _of_variant(variant.id, runs) for variant in VARIANTS}
    passive = values["passive-constant"]
    return {
        "core_version": CORE_VERSION,
        **_roads(roads),
        "rows": [
            {
                "id": variant.id,
                "label": variant.label,
                "controller": variant.controller,
                "speed": variant.speed,
                "preview": variant.preview,
                "weights": variant.weights,
                "is": variant.known_as,
                "travel_time": mean_with_interval(values[variant.id]["travel_time"]).value,
                "metrics": [
                    {
                        **_named(figure),
                        **_interval(mean_with_interval(values[variant.id][figure])),
                        "change_vs_passive": change_with_interval(values[variant.id][figure], passive[figure]).value,
                    }
                    for figure in FIGURES
                ],
                "comfort": {key: _interval(mean_with_interval(values[variant.id][key])) for key in COMFORT_FIGURES},
            }
            for variant in VARIANTS
        ],
        "shares": [
            {
                **_named(item.figure),
                **{factor: getattr(item, factor) for factor in FACTORS},
                "total_change": item.total,
            }
            for item in shares(values)
        ],
        "sentences": sentences(values),
        "equal_speed": [
            {
                "label": label,
                "strategy": first,
                "against": second,
                "cells": [
                    {**_named(figure), "our_change": change.value, "ci": [change.low, change.high]}
                    for figure, change in zip(FIGURES, compared(first, second, values), strict=True)
                ],
            }
            for label, first, second in EQUAL_SPEED
        ],
    }


def _of_variant(name: str, runs: Sequence[Mapping[str, Mapping[str, Any]]]) -> dict[Any, list[float]]:
    found: dict[Any, list[float]] = {
        figure: [run[name]["figures"][index] for run in runs] for index, figure in enumerate(FIGURES)
    }
    return found | {key: [run[name][key] for run in runs] for key in ("travel_time", *COMFORT_FIGURES)}


def _cell(cell: PaperCell, item: Judged | None, blind: Judged | None, ours: paper.Values, rows: Rows) -> dict[str, Any]:
    base = ours.get(cell.against, {}).get((cell.window, cell.statistic, cell.signal))
    looks_ahead = {cell.strategy, cell.against} & set(paper.PREVIEWED)
    return {
        "table": cell.table,
        "window": cell.window,
        "signal": cell.signal,
        "statistic": cell.statistic,
        "strategy": cell.strategy,
        "against": cell.against,
        "paper_value": cell.value,
        "paper_base": cell.base,
        "paper_change": cell.printed,
        "misprint": None if cell.follows is None else {"printed": cell.printed, "follows": cell.follows},
        "our_value": None if item is None else item.value,
        "our_base": None if base is None else sum(base) / len(base),
        **_judgement(item, rows),
        "without_preview": _judgement(blind, rows) if looks_ahead else None,
    }


def _judgement(item: Judged | None, rows: Rows) -> dict[str, Any]:
    if item is None:
        verdict = "unavailable" if rows.complete else "pending"
        return {"our_change": None, "ci": None, "verdict": verdict, "certain": None}
    return {
        "our_change": item.change.value,
        "ci": [item.change.low, item.change.high],
        "verdict": item.verdict.value,
        "certain": item.certain,
    }


def _named(figure: tuple[str, str, str]) -> dict[str, str]:
    return dict(zip(("window", "statistic", "signal"), figure, strict=True))


def _interval(found: Interval) -> dict[str, float]:
    return {"value": found.value, "low": found.low, "high": found.high}
