"""Builds the paper page's answers from the values of many runs."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from typing import Any

from backend.json_types import JsonObject
from backend.paper import claims, models
from backend.paper.absolutes import absolutes
from backend.paper.attribution import COMFORT_FIGURES, EQUAL_SPEED, VARIANTS, compared, sentences, shares
from backend.paper.claims import FIGURES, Judged
from backend.paper.errata import ERRATA
from backend.paper.interpretations import (
    INTERPRETATIONS,
    OPEN_QUESTIONS,
    Interpretation,
    OpenQuestion,
    changes_of,
    interpretation_of,
    load_factor,
)
from backend.paper.rows import Rows
from backend.paper.tables import TABLES, PaperCell, PaperTable, cells
from sim_core import __version__ as CORE_VERSION
from sim_core.comparison.intervals import change_with_interval, mean_with_interval

RunsByVariant = Sequence[Mapping[str, JsonObject]]  # of each road


def reproduction(
    choices: Mapping[str, str],
    roads: range,
    ours: claims.Values,
    without_preview: claims.Values,
    named: Mapping[str, claims.Values],
    rows: Rows,
) -> models.PaperAnswer:
    """The answer with every cell.

    Args:
        choices: Question -> choice, all of them.
        roads: Their seeds.
        ours: By strategy, under these choices, of those that are complete.
        without_preview: Our values without preview.
        named: Our values under each named set.
        rows: What all are made of; where hardware in the loop is not available all are judged without it.
    """
    if rows.reason is not None:
        ours, without_preview = _simulated(ours), _simulated(without_preview)
        named = {name: _simulated(values) for name, values in named.items()}
    judged, blind = claims.judge(ours), claims.judge(without_preview)
    blind_counts = claims.count(blind)
    by_cell, blind_by_cell = ({item.cell: item for item in items} for items in (judged, blind))
    return models.PaperAnswer(
        **_head(roads),
        **_counted(judged),
        interpretation=interpretation_of(choices),
        interpretations=[_interpretation(item, named[item.id]) for item in INTERPRETATIONS.values()],
        unavailable=unavailable(rows.reason),
        complete=rows.complete,
        progress=models.Progress(done=len(rows.by_key), total=rows.total),
        without_preview=models.WithoutPreview(reached=blind_counts["reached"], counts=blind_counts),
        scenario=claims.scenario_for(choices, 1),
        cells=[
            _cell(cell, by_cell.get(cell), blind_by_cell.get(cell), ours, rows, load_factor(choices, cell.signal))
            for cell in cells()
        ],
        absolutes=absolutes(named),
        readings=[_reading(reading, choices[reading.id]) for reading in OPEN_QUESTIONS.values()],
        rules=claims.RULES,
        tables=[_table(table) for table in TABLES],
        errata=ERRATA,
    )


def _interpretation(item: Interpretation, values: claims.Values) -> models.Interpretation:
    changes = changes_of(item.otherwise)
    counted = _counted(claims.judge(values))
    return models.Interpretation(**asdict(item), choices=item.choices, changes=changes, **counted)


def _reading(reading: OpenQuestion, choice: str) -> models.ReadingAnswer:
    own = asdict(reading)
    choices = [{**each, "default": each["id"] == reading.default} for each in own.pop("choices")]
    return models.ReadingAnswer(**own, chosen=choice, choices=choices)


def _table(table: PaperTable) -> models.TableAnswer:
    columns = [{"strategy": strategy, "against": against} for strategy, against, _ in table.columns]
    return models.TableAnswer(number=table.number, title=table.title, columns=columns)


def unavailable(reason: str | None) -> models.Unavailable | None:
    """The cells of hardware in the loop, with the reason why it is not available."""
    if reason is None:
        return None
    return models.Unavailable(cells=sum(cell.strategy == claims.IN_ECU for cell in cells()), reason=reason)


def _simulated(values: claims.Values) -> claims.Values:
    return {name: values[name] for name in claims.SIMULATED if name in values}


def reading_row(reading: str, choice: str, base: Sequence[Judged], judged: Sequence[Judged]) -> models.ReadingRow:
    """Count the verdicts under one choice of a question, and how many of them it changes."""
    counts, before = claims.count(judged), {item.cell: item.verdict for item in base}
    changed = sum(before.get(item.cell, item.verdict) is not item.verdict for item in judged)
    return models.ReadingRow(
        reading=reading, choice=choice, reached=counts["reached"], total=len(judged), counts=counts, changed=changed
    )


def attribution(roads: range, runs: RunsByVariant) -> models.AttributionAnswer:
    """Return what each part contributes, from a row for each road: variant -> its metrics."""
    values = {variant.id: _of_variant(variant.id, runs) for variant in VARIANTS}
    return models.AttributionAnswer(
        **_head(roads),
        rows=[
            models.CombinationRow.model_validate(
                {name: getattr(variant, name) for name in ("id", "label", "controller", "speed", "preview", "weights")}
                | {"is": variant.known_as}
                | _means(values[variant.id], values["passive-constant"])
            )
            for variant in VARIANTS
        ],
        shares=shares(values),
        sentences=sentences(values),
        equal_speed=[
            models.EqualSpeed(
                label=label,
                strategy=first,
                against=second,
                cells=[
                    models.Change(**_named(figure), our_change=change.value, ci=[change.low, change.high])
                    for figure, change in zip(FIGURES, compared(first, second, values), strict=True)
                ],
            )
            for label, first, second in EQUAL_SPEED
        ],
    )


def _head(roads: range) -> dict[str, str | int]:
    return {"core_version": CORE_VERSION, "seeds": len(roads), "first_seed": roads[0]}


def _counted(judged: Sequence[Judged]) -> dict[str, Any]:
    """The fields of `Counted`."""
    counts, (simulated, in_ecu) = claims.count(judged), claims.split(judged)
    return {
        "reached": counts["reached"],
        "total": len(judged),
        "counts": counts,
        "simulated": models.Part(reached=claims.count(simulated)["reached"], total=len(simulated)),
        "ecu": models.Part(reached=claims.count(in_ecu)["reached"], total=len(in_ecu)),
        "agreement": agreement(judged),
    }


def agreement(judged: Sequence[Judged]) -> models.Agreement:
    """Count the simulated changes that are close to the paper's; a misprint is taken as its absolutes have it."""
    simulated, _ = claims.split(judged)
    return models.Agreement(
        cells=len(simulated),
        within=sum(abs(item.change.value - item.cell.claim) <= claims.AGREEMENT for item in simulated),
        in_interval=sum(item.change.low <= item.cell.claim <= item.change.high for item in simulated),
    )


def _means(values: Mapping[Any, Sequence[float]], passive: Mapping[Any, Sequence[float]]) -> dict[str, Any]:
    """One variant's means over the roads with their intervals, as fields of `CombinationRow`."""
    return {
        "travel_time": mean_with_interval(values["travel_time"]).value,
        "metrics": [
            {
                **_named(figure),
                **asdict(mean_with_interval(values[figure])),
                "change_vs_passive": change_with_interval(values[figure], passive[figure]).value,
            }
            for figure in FIGURES
        ],
        "comfort": {key: mean_with_interval(values[key]) for key in COMFORT_FIGURES},
    }


def _of_variant(name: str, runs: RunsByVariant) -> dict[Any, list[float]]:
    by_figure: dict[Any, list[float]] = {
        figure: [run[name]["figures"][index] for run in runs] for index, figure in enumerate(FIGURES)
    }
    return by_figure | {key: [run[name][key] for run in runs] for key in ("travel_time", *COMFORT_FIGURES)}


def _cell(
    cell: PaperCell, item: Judged | None, blind: Judged | None, ours: claims.Values, rows: Rows, factor: float
) -> models.Cell:
    base = ours.get(cell.against, {}).get((cell.window, cell.statistic, cell.signal))
    looks_ahead = {cell.strategy, cell.against} & set(claims.PREVIEWED)
    return models.Cell(
        **asdict(cell),
        **dict(_judgement(item, rows)),
        paper_value=cell.value,
        paper_base=cell.base,
        paper_change=cell.printed,
        misprint=None if cell.follows is None else models.Misprint(printed=cell.printed, follows=cell.follows),
        our_value=None if item is None else factor * item.value,
        our_base=None if base is None else factor * sum(base) / len(base),
        our_factor=factor,
        without_preview=_judgement(blind, rows) if looks_ahead else None,
    )


def _judgement(item: Judged | None, rows: Rows) -> models.Judgement:
    if item is None:
        verdict = "unavailable" if rows.complete else "pending"
        return models.Judgement(our_change=None, ci=None, verdict=verdict, certain=None)
    change = item.change
    return models.Judgement(
        our_change=change.value, ci=[change.low, change.high], verdict=item.verdict.value, certain=item.certain
    )


def _named(figure: tuple[str, str, str]) -> dict[str, str]:
    return dict(zip(("window", "statistic", "signal"), figure, strict=True))
