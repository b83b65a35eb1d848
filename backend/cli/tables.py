"""Results as tables of plain text, each figure with its unit."""

from collections.abc import Iterator, Sequence, Set
from typing import Any

from backend.client import Interval, Outcome, RunResult
from sim_core.catalogue import PAPER_SIGNALS, SIGNALS
from sim_core.strategies import STRATEGIES

_COLUMNS = (("rough_road", "rms", "RMS on the rough road"), ("bump", "peak", "peak on the bump"))


def run_table(run: RunResult, baseline: str) -> Iterator[str]:
    """The lines of `python -m sim_core run`, for those strategies that ran; then why others did not."""
    ran = [outcome for outcome in run if outcome.status == "ok"]
    base = run[baseline] if run[baseline].status == "ok" else None
    for window, statistic, title in _COLUMNS:
        yield f"\n{title}"
        header = "".join(f"{f'{SIGNALS[s].label} [{SIGNALS[s].unit}]':>36}" for s in PAPER_SIGNALS)
        yield f"{'':26}{header}"
        for outcome in ran:
            cells = "".join(_cell(run, outcome, base, (window, s, statistic)) for s in PAPER_SIGNALS)
            yield f"{label(outcome.strategy):26}{cells}"
    title = f"road seed {run.scenario['road']['seed']} alone" if run.roads > 1 else ""
    yield f"\n{title:26}{'travel time':>14}{'at the bump':>14}{'airborne':>12}{'over travel':>14}{'QPs':>8}{'run':>12}"
    for outcome in ran:
        events = outcome.events
        yield (
            f"{label(outcome.strategy):26}{outcome.travel_time:>12.2f} s{outcome.arrival_speed_kmh:>9.1f} km/h"
            f"{events['airborne_ms']:>9.0f} ms{events['travel_exceeded_mm']:>11.1f} mm"
            f"{events['qp_solves']:>8}{outcome.compute_ms:>9.1f} ms"
        )
    for outcome in run:
        if outcome.status != "ok":
            yield f"{label(outcome.strategy):26}failed: {outcome.reason}"


def label(strategy: str) -> str:
    """What a strategy is called; its id where this version does not know it."""
    return STRATEGIES[strategy].label if strategy in STRATEGIES else strategy


def with_unit(name: str, unit: str) -> str:
    """A column's head: `bump.body_acceleration.peak [m/s^2]`; numbers without a unit stand alone."""
    return name if unit in ("", "1") else f"{name} [{unit}]"


def shown(value: Any, digits: int = 6) -> str:
    """One value, short."""
    if isinstance(value, bool) or value is None:
        return {True: "yes", False: "no", None: "-"}[value]
    if isinstance(value, float | int):
        return f"{value:.{digits}g}"
    if isinstance(value, list):
        return ",".join(shown(item, digits) for item in value)
    return str(value)


def aligned(heads: Sequence[str], rows: Sequence[Sequence[str]], left: Set[int]) -> Iterator[str]:
    """Lines of a table, columns as wide as they need; those in `left` begin at their left edge."""
    widths = [max(len(row[column]) for row in (heads, *rows)) for column in range(len(heads))]
    for row in (heads, *rows):
        cells = (
            f"{cell:<{width}}" if column in left else f"{cell:>{width}}"
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        )
        yield "  ".join(cells).rstrip()


def _cell(run: RunResult, outcome: Outcome, base: Outcome | None, place: tuple[str, str, str]) -> str:
    """A metric and its change; over several roads both with half their interval's width."""
    window, signal, statistic = place
    value = outcome.figures()[".".join(place)]
    assert isinstance(value, float | int)  # noqa: S101  # a metric
    text = f"{value:.4g}"
    if run.roads > 1:
        text = str(outcome.metrics[window][signal]["rms" if statistic == "rms" else "peak"])
        change = run.changes.get(outcome.strategy, {}).get(window, {}).get(signal, {}).get(statistic)
        if isinstance(change, Interval):
            text += f" ({change.mean:+.1f} ± {change.half:.1f} %)"
        return f"{text:>36}"
    reference = base.figures()[".".join(place)] if base is not None and base is not outcome else None
    against = f" ({100 * (value - reference) / reference:+.1f} %)" if reference else ""
    return f"{text + against:>36}"
