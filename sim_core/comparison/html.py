"""A comparison as a notebook shows it: plain HTML without styles of its own."""

from collections.abc import Iterable, Iterator, Mapping
from html import escape

from sim_core.catalogue import METRICS, PAPER_METRICS
from sim_core.comparison.change import Change
from sim_core.comparison.numbers import NO_VALUE, percent
from sim_core.comparison.requirements import RequirementResult
from sim_core.strategies import label_of

_RANDOM = "*"
_NOTE = f"{_RANDOM} not beyond random variation"


def comparison_html(
    verdict: str,
    tables: Mapping[str, Mapping[str, Mapping[str, Change]]],
    requirements: Iterable[RequirementResult],
    cautions: Iterable[str],
) -> str:
    """Return a verdict, changes of the paper's metrics, requirement results and cautions as HTML.

    Args:
        verdict: Whole sentences.
        tables: Caption -> strategy -> metric -> change.
        requirements: The result of each strategy under each requirement.
        cautions: Whole sentences each.
    """
    lists = _list("Requirements", map(_requirement, requirements)), _list("Cautions", cautions)
    return "".join([f"<p>{escape(verdict)}</p>", *_tables(tables), *lists])


def _tables(tables: Mapping[str, Mapping[str, Mapping[str, Change]]]) -> Iterator[str]:
    """Return a table for each caption, with a row for each strategy; none where there are no changes."""
    for caption, changes in tables.items():
        if metrics := [metric for metric in PAPER_METRICS if any(metric in each for each in changes.values())]:
            rows = [_row("th", ["", *(METRICS[metric].label for metric in metrics)])]
            for strategy, each in changes.items():
                rows.append(_row("td", [label_of(strategy), *(_cell(each.get(metric)) for metric in metrics)]))
            yield f"<table><caption>{escape(caption)}; {_NOTE}</caption>{''.join(rows)}</table>"


def _row(tag: str, cells: Iterable[str]) -> str:
    return f"<tr>{''.join(f'<{tag}>{escape(cell)}</{tag}>' for cell in cells)}</tr>"


def _cell(change: Change | None) -> str:
    """Return a change in percent, over several roads with half its interval, and a mark where it may be random."""
    if change is None or change.change is None:
        return NO_VALUE
    half = 0.0 if change.low is None or change.high is None else (change.high - change.low) / 2
    return f"{percent(change.change, half)}{'' if change.beyond_variation else _RANDOM}"


def _requirement(result: RequirementResult) -> str:
    subject = f"{label_of(result.strategy)}, {METRICS[result.metric].label}, {result.limit_text}"
    return f"{subject}: {result.result}, {result.reason or result.value_text}"


def _list(title: str, items: Iterable[str]) -> str:
    listed = "".join(f"<li>{escape(item)}</li>" for item in items)
    return f"<p>{title}</p><ul>{listed}</ul>" if listed else ""
