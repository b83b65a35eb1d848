"""The paper's weights and the tuned ones side by side, on the training roads and on the validation roads."""

import math
from collections.abc import Mapping, Sequence

from backend.store.trials import StoredTrial
from backend.tunings import front
from backend.tunings.comparison_models import ComparedFigure, ComparedPoint, TunedChange, TunedFigures, Verdict
from backend.tunings.measure import Aims, Failure, Measured, RunsByRoad, mean
from sim_core.comparison.intervals import change_with_interval, mean_with_interval

PAPER, SCENARIO, KNEE = "paper", "scenario", "knee"


def roles(trials: Sequence[StoredTrial], objectives: int, *, own: bool) -> dict[int, list[str]]:
    """Return the trials worth comparing, by number, with what each is: the paper's, the scenario's, the best, the knee.

    Args:
        trials: All of them; the paper's first, and the scenario's own behind it if it is there (`own`).
        objectives: How many there are.
        own: Whether the scenario has weights of its own.
    """
    roles_by_number = {0: [PAPER]}
    if own:
        roles_by_number[1] = [SCENARIO]
    named = [(f"best.{index}", front.best(trials, index)) for index in range(objectives)]
    for role, trial in [*named, (KNEE, front.knee(front.front(trials)))]:
        if trial is not None:
            roles_by_number.setdefault(trial.number, []).append(role)
    return roles_by_number


def columns(aims: Aims) -> list[ComparedFigure]:
    """Return the columns: the objectives, the limits, the paper's eight."""
    named = {f"objectives.{index}": objective for index, objective in enumerate(aims.objectives)} | aims.metrics
    return [ComparedFigure(key=key, label=each.label, unit=each.unit) for key, each in named.items()]


def compared(
    trials: Sequence[StoredTrial],
    roles: Mapping[int, list[str]],
    measured: Mapping[int, RunsByRoad],
    training: Sequence[int],
    fresh: Sequence[int],
    aims: Aims,
) -> list[ComparedPoint]:
    """Compare each set of weights with the paper's over both sets of roads.

    Args:
        trials: All of them.
        roles: Those to compare (`roles`), the paper's first.
        measured: Their runs.
        training: Seeds trained on.
        fresh: Seeds that nothing was trained on.
        aims: What the tuning is after.
    """
    points = []
    for number, names in roles.items():
        ours, papers, tuned = measured[number], measured[0], number != 0
        points.append(
            ComparedPoint(
                trial=number,
                roles=names,
                weights=trials[number].weights,
                training=_over(training, ours, papers, aims, tuned=tuned),
                fresh=_over(fresh, ours, papers, aims, tuned=tuned),
                verdict=[_verdict(fresh, ours, papers, index) for index in range(len(aims.objectives))]
                if tuned
                else None,
                failures=[f"Road {seed}: {run.reason}" for seed, run in ours.items() if isinstance(run, Failure)],
            )
        )
    return points


def _over(
    seeds: Sequence[int], ours: RunsByRoad, papers: RunsByRoad, aims: Aims, *, tuned: bool
) -> dict[str, TunedFigures]:
    """Compare by key over the roads on which both sets of weights could be run."""
    both = _both(seeds, ours, papers)
    figures = {}
    for key in both[0][0] if both else ():
        values, base = [one[key] for one, _ in both], [other[key] for _, other in both]
        change = _change(values, base) if tuned else None
        quantile = None if aims.quantile is None else aims.over(values)
        figures[key] = TunedFigures(mean=mean(values), worst=max(values), quantile=quantile, change=change)
    return figures


def _both(seeds: Sequence[int], ours: RunsByRoad, papers: RunsByRoad) -> list[tuple[Measured, Measured]]:
    pairs = [(ours[seed], papers[seed]) for seed in seeds]
    return [(one, other) for one, other in pairs if not isinstance(one, Failure) and not isinstance(other, Failure)]


def _change(values: Sequence[float], base: Sequence[float]) -> TunedChange | None:
    change = change_with_interval(values, base)
    if not math.isfinite(change.value):
        return None
    low, high = (each if math.isfinite(each) else None for each in (change.low, change.high))
    return TunedChange(value=change.value, low=low, high=high)


def _verdict(seeds: Sequence[int], ours: RunsByRoad, papers: RunsByRoad, objective: int) -> Verdict:
    """Check whether the objective's change is sure: its interval (against zero: the difference's) leaves out 0."""
    key = f"objectives.{objective}"
    both = _both(seeds, ours, papers)
    if len(both) < 2:
        return "unclear"
    values, base = [one[key] for one, _ in both], [other[key] for _, other in both]
    change = change_with_interval(values, base)
    if not math.isfinite(change.value):
        change = mean_with_interval([value - other for value, other in zip(values, base, strict=True)])
    if change.high < 0:
        return "better"
    return "worse" if change.low > 0 else "unclear"
