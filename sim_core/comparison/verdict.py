"""The verdict of a comparison: the best strategy by metric, and as text with differences and speeds."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from sim_core.catalogue import (
    BUMP,
    METRICS,
    PAPER_SIGNALS,
    PAPER_VIEWS,
    PEAK,
    RMS,
    ROUGH_ROAD,
    SIGNALS,
    metric_key,
)
from sim_core.comparison.change import Change
from sim_core.comparison.numbers import percent
from sim_core.comparison.ranking import Ranking, in_catalogue_order
from sim_core.comparison.rows import Row, changes_between

MOST_GROUPS, MOST_NAMED = 3, 4  # of groups and strategies that one sentence names
_MOST_GROUPS_IN_WORDS, _MOST_WORDS = 2, 3  # of groups and of each one's metrics; beyond them, metrics are counted
_SPEED_TOLERANCE = 0.01  # arrival speeds closer than this part of each other print the same or nearly so
_TOGETHER = {PAPER_SIGNALS[:2]: "accelerations", PAPER_SIGNALS[2:]: "tyre loads"}
_HEADLINES = (metric_key(BUMP, PAPER_SIGNALS[0], PEAK), metric_key(ROUGH_ROAD, PAPER_SIGNALS[0], RMS))
_WINDOWS = {ROUGH_ROAD: ("RMS ", " on the rough road"), BUMP: ("peak ", " on the bump")}


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """The verdict of a comparison: the best strategy by metric, and as text.

    Attributes:
        text: Whole sentences: who is best in how many of the paper's metrics, by how much one that it is best in
            differs from the baseline's, and at which speed each was driven.
        best: Metric -> the strategy that is lower than every other one beyond random variation; None where none is. Of
            the paper's eight metrics those that every simulated strategy has.
        mixed: Whether every strategy has a metric in which another one is lower beyond random variation.

    Example:
        >>> from sim_core import Road, Scenario, compare, simulate
        >>> smooth = Scenario(road=Road(roughness=0))
        >>> verdict = compare({name: simulate(smooth, name) for name in ("speed_only", "passive")}).verdict
        >>> verdict.best["rough_road.front_tyre_load.rms"], verdict.best["bump.front_tyre_load.peak"], verdict.mixed
        ('passive', 'speed_only', True)
    """

    text: str
    best: Mapping[str, str | None]
    mixed: bool


def verdict_on(rows: Sequence[Row], baseline: Row | None) -> Verdict:
    """Return the verdict on the strategies of a comparison.

    Args:
        rows: One for each strategy; their order is of no account.
        baseline: What changes refer to; None where it failed.
    """
    ranking = Ranking(rows)
    return Verdict(
        text=" ".join(map(begin_sentence, _sentences(ranking, rows, baseline))),
        best={metric: None if best is None else best.key for metric, best in ranking.best.items()},
        mixed=len(ranking.rows) > 1 and bool(ranking.metrics) and not ranking.never_worse,
    )


def begin_sentence(text: str) -> str:
    """Return a sentence with a capital letter first, whatever the label that it begins with."""
    return text[:1].upper() + text[1:]


def _sentences(ranking: Ranking, rows: Sequence[Row], baseline: Row | None) -> Iterator[str]:
    """Return the sentences of a verdict, whose first word may be a label without a capital letter."""
    if len(rows) < 2:
        yield f"There is no other result to compare {rows[0].label} with." if rows else "There is no result to compare."
        return
    if len(ranking.rows) > 1 and ranking.metrics:
        yield _best_sentence(ranking)
    yield from _difference_sentence(ranking, baseline)
    yield from _speed_sentence(rows)


def _best_sentence(ranking: Ranking) -> str:
    """Return who is best, and in what."""
    winner, count, beyond = ranking.winner, len(ranking.metrics), _beyond(ranking.rows)
    if winner is None:
        return f"No clear winner: {_without_winner(ranking)}."
    wins = ranking.wins(winner)
    if wins == count:
        return f"{winner.label} is best in all {count} metrics."
    lead = f"{winner.label} is best in {wins} of {count} metrics"
    others = [group for group in _groups(ranking) if winner not in group[0]]
    if others:
        return f"{lead}, but {_clauses(others)}."
    rest = "the other one" if count - wins == 1 else f"the other {count - wins}"
    words = _MetricWords([metric for metric, best in ranking.best.items() if best is not winner])
    named = f" ({words.text})" if words.count <= _MOST_WORDS else ""
    return f"{lead}; in {rest}{named} no strategy is better{beyond}."


def _without_winner(ranking: Ranking) -> str:
    """Return what there is to say in place of a winner."""
    count, never_worse, beyond = len(ranking.metrics), ranking.never_worse, _beyond(ranking.rows)
    if len(never_worse) == len(ranking.rows):
        if not beyond:
            return f"{_labels(ranking.rows)} are equal in all {count} metrics"
        return f"{_labels(ranking.rows)} differ in none of {count} metrics{beyond}"
    if len(never_worse) > 1:
        return (
            f"{_labels(never_worse)} differ in none of {count} metrics{beyond}, and no strategy is better than they are"
        )
    if len(never_worse) == 1:
        others = "others are not beyond random variation of it" if beyond else "others equal it"
        return f"in no metric is any strategy better than {never_worse[0].label}{beyond}, but {others}"
    return _clauses(_groups(ranking))


Group = tuple[tuple[Row, ...], list[str]]


def _groups(ranking: Ranking) -> list[Group]:
    """Return the strategies that lead together, with the metrics they lead in; those with the most metrics first."""
    groups: dict[tuple[Row, ...], list[str]] = {}
    for metric, undominated in ranking.undominated.items():
        groups.setdefault(undominated, []).append(metric)
    # `ranking.rows` are in the catalogue's order, whatever the order of the results is.
    return sorted(groups.items(), key=lambda group: (-len(group[1]), len(group[0]), ranking.rows.index(group[0][0])))


def _clauses(groups: Sequence[Group]) -> str:
    """Return who has the lowest what, and in how many metrics who leads where that would be long."""
    words = [_MetricWords(metrics) for _, metrics in groups]
    if len(groups) > _MOST_GROUPS_IN_WORDS or any(each.count > _MOST_WORDS for each in words):
        return _counts(groups)
    parts: list[str] = []
    for (undominated, _), each in zip(groups, words, strict=True):
        verb = "" if parts else " has" if len(undominated) == 1 else " have"
        parts.append(f"{_labels(undominated)}{verb} the lowest {each.text}")
    return ", ".join(parts)


def _counts(groups: Sequence[Group]) -> str:
    """Return in how many metrics who leads: `LV control and LQR share the lead in 4 metrics; Passive leads in 3`."""
    parts: list[str] = []
    for undominated, metrics in groups[:MOST_GROUPS]:
        unit = "" if parts else " metric" if len(metrics) == 1 else " metrics"
        lead = "leads" if len(undominated) == 1 else "share the lead"
        parts.append(f"{_labels(undominated)} {lead} in {len(metrics)}{unit}")
    if rest := sum(len(metrics) for _, metrics in groups[MOST_GROUPS:]):
        parts.append(f"others lead in {rest}")
    return "; ".join(parts)


class _MetricWords:
    """Some of the paper's metrics in words: `accelerations`, `peak tyre loads on the bump`.

    Attributes:
        text: All of them.
        count: How many signals are named in it, those of a kind as one.
    """

    def __init__(self, metrics: Sequence[str]) -> None:
        signals = {
            window: [signal for signal in PAPER_SIGNALS if metric_key(window, signal, statistic) in metrics]
            for window, statistic in PAPER_VIEWS
        }
        both = [signal for signal in PAPER_SIGNALS if all(signal in each for each in signals.values())]
        words = _signals(both)
        parts = [_join_words(words)] if words else []
        self.count = len(words)
        for window, each in signals.items():
            if rest := _signals([signal for signal in each if signal not in both]):
                statistic, where = _WINDOWS[window]
                parts.append(f"{statistic}{_join_words(rest)}{where}")
                self.count += len(rest)
        self.text = _join_words(parts)


def _signals(signals: Sequence[str]) -> list[str]:
    """Return signals in words, those of a kind together."""
    words, rest = [], list(signals)
    for pair, together in _TOGETHER.items():
        if set(pair) <= set(rest):
            words.append(together)
            rest = [signal for signal in rest if signal not in pair]
    return [*words, *(SIGNALS[signal].label.lower() for signal in rest)]


def _difference_sentence(ranking: Ranking, baseline: Row | None) -> Iterator[str]:
    """Return by how much the ride differs from the baseline's, or from the next best where the baseline is best."""
    metric = _quoted_metric(ranking)
    if metric is None or not ranking.rows:
        return
    in_turn = sorted(ranking.rows, key=lambda row: row.means[metric])
    subject = ranking.winner or in_turn[0]
    rival = baseline if baseline is not subject else next((row for row in in_turn if row is not subject), None)
    if rival is None or metric not in rival.means:
        return
    if not rival.is_recorded and not changes_between(subject, rival, [metric])[metric].beyond_variation:
        return  # the first sentence says already that neither is better
    window, signal = METRICS[metric].path[1:3]
    statistic, where = _WINDOWS[window]
    is_only_one_named = subject is ranking.winner and subject in ranking.never_worse
    whose = "Its" if is_only_one_named else f"With {subject.label}, the"
    yield f"{whose} {statistic}{SIGNALS[signal].label.lower()}{where} {_compared(subject, rival, metric)}."


def _quoted_metric(ranking: Ranking) -> str | None:
    """Return the metric whose difference is said: of a winner one that it is best in."""
    winner = ranking.winner
    in_turn = [*_HEADLINES, *ranking.metrics]
    return next((key for key in in_turn if key in ranking.metrics and winner in (None, ranking.best[key])), None)


def _compared(subject: Row, rival: Row, metric: str) -> str:
    """Return how a metric of one strategy compares with that of another."""
    change, beyond = changes_between(subject, rival, [metric])[metric], _beyond([subject, rival])
    if not change.beyond_variation:
        return f"does not differ{beyond} from that with {rival.label}" if beyond else f"equals that with {rival.label}"
    if change.change is None:
        return f"cannot be compared in percent, because it is zero with {rival.label}"
    return f"is {_size(change)} {'lower' if change.change < 0 else 'higher'} than with {rival.label}"


def _size(change: Change) -> str:
    """Return the magnitude of a change, over several roads with half its interval."""
    half = 0.0 if change.low is None or change.high is None else (change.high - change.low) / 2
    return percent(abs(change.change or 0.0), half).removeprefix("+")


def _speed_sentence(rows: Sequence[Row]) -> Iterator[str]:
    """Return at which speed each strategy meets the bump, as far as it is known; `all` only where it is of all."""
    driven = sorted((row.speed, row.key, row) for row in rows if row.speed is not None)
    groups: list[tuple[float, list[Row]]] = []
    for speed, _, row in driven:
        if groups and speed - groups[-1][0] <= _SPEED_TOLERANCE * speed:
            groups[-1][1].append(row)
        else:
            groups.append((speed, [row]))
    is_of_all, names = len(driven) == len(rows), _labels([row for _, _, row in driven])
    if len(groups) == 1 and len(driven) > 1:
        together = "Both" if len(driven) == 2 else "All"
        yield f"{together if is_of_all else names} meet the bump at {_kmh(groups[0][0])}."
    elif len(groups) > MOST_GROUPS:
        yield f"{'They' if is_of_all else names} meet the bump at {_kmh(groups[0][0])} to {_kmh(groups[-1][0])}."
    elif groups:
        is_long = is_of_all and len(driven) > MOST_NAMED
        (speed, first), *others = sorted(groups, key=lambda group: len(group[1])) if is_long else groups
        parts = [f"{_labels(first)} {'meets' if len(first) == 1 else 'meet'} the bump at {_kmh(speed)}"]
        parts += [f"{_labels(group)} at {_kmh(speed)}" for speed, group in others]
        if is_long:  # the largest group comes last
            parts[-1] = f"the others at {_kmh(others[-1][0])}"
        yield ", ".join(parts) + "."


def _beyond(rows: Sequence[Row]) -> str:
    """Return what a difference has to be beyond, to count; nothing where nothing is random."""
    if any(len(values) > 1 for row in rows for values in row.values.values()):
        return " beyond random variation"
    return " beyond the random variation of one road" if any(row.is_random for row in rows) else ""


def _kmh(speed: float) -> str:
    return f"{speed:.{1 if speed < 99.95 else 0}f}\u00a0km/h"


def _labels(rows: Sequence[Row]) -> str:
    """Return the strategies' labels, in the catalogue's order."""
    return _join_words([row.label for row in in_catalogue_order(rows)])


def _join_words(words: Sequence[str]) -> str:
    """Return `a`, `a and b`, or `a, b and c`."""
    return " and ".join([*([", ".join(words[:-1])] if len(words) > 1 else []), *words[-1:]])
