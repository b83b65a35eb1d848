"""The paper's printed absolutes beside ours, and how far ours are from them."""

from collections.abc import Mapping, Sequence
from math import exp, log
from statistics import fmean, median, stdev

from backend.paper import models
from backend.paper.claims import FIGURES, SIMULATED, Values
from backend.paper.interpretations import DEFAULT, INTERPRETATIONS, NEAREST, Interpretation, load_factor
from backend.paper.tables import ABSOLUTES
from sim_core.catalogue import PAPER_SIGNALS

UNCONTROLLED = ("passive", "speed_only")  # those that no suspension control takes part in

Figure = tuple[str, str, str]  # window, statistic, signal


def absolutes(named: Mapping[str, Values]) -> models.Absolutes:
    """Return every printed absolute beside ours, and the distances of each interpretation.

    Args:
        named: Our values under each named set, of the strategies that are complete.
    """
    return models.Absolutes(
        rows=[_row(strategy, figure, named) for figure in FIGURES for strategy in ABSOLUTES[figure[:2]]],
        distances=[_distances(item, named[item.id]) for item in INTERPRETATIONS.values()],
    )


def printed(strategy: str, figure: Figure) -> float:
    """Return the printed absolute of a strategy in one of `claims.FIGURES` [SI]."""
    window, statistic, signal = figure
    return ABSOLUTES[window, statistic][strategy][PAPER_SIGNALS.index(signal)]


def distance(ours: Mapping[str, Mapping[Figure, float]]) -> models.Distance:
    """Return how far absolutes are from the printed ones, either way.

    Args:
        ours: Strategy -> figure of `claims.FIGURES` -> mean [SI].
    """
    factors = [
        abs(log(value / printed(strategy, figure)))
        for strategy, means in ours.items()
        for figure, value in means.items()
    ]
    return models.Distance(values=len(factors), median=exp(median(factors)), mean=exp(fmean(factors)))


def _row(strategy: str, figure: Figure, named: Mapping[str, Values]) -> models.AbsoluteRow:
    window, statistic, signal = figure
    default, nearest = (
        _ours(named[item.id].get(strategy, {}).get(figure), load_factor(item.choices, signal))
        for item in (DEFAULT, NEAREST)
    )
    return models.AbsoluteRow(
        window=window,
        statistic=statistic,
        signal=signal,
        strategy=strategy,
        printed=printed(strategy, figure),
        default=default,
        nearest=nearest,
    )


def _ours(values: Sequence[float] | None, factor: float) -> models.OurAbsolute | None:
    if values is None:
        return None
    return models.OurAbsolute(value=factor * fmean(values), spread=factor * stdev(values), factor=factor)


def _distances(item: Interpretation, values: Values) -> models.Distances:
    factors = {figure: load_factor(item.choices, figure[2]) for figure in FIGURES}

    def of(strategies: Sequence[str]) -> models.Distance | None:
        if not set(strategies) <= values.keys():
            return None
        return distance(
            {name: {figure: factors[figure] * fmean(values[name][figure]) for figure in FIGURES} for name in strategies}
        )

    return models.Distances(interpretation=item.id, uncontrolled=of(UNCONTROLLED), simulated=of(SIMULATED))
