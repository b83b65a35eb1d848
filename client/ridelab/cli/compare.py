"""`ridelab compare`: two results, metric by metric; its exit code says whether they are the same."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from fnmatch import fnmatchcase
from typing import Annotated, Any

import typer

from ridelab.cli import options, targets
from ridelab.cli.reporting import DIFFERENT, InputError, print_json
from ridelab.cli.service import Services
from ridelab.cli.tables import show_table, shown, with_unit
from ridelab.results import Figure, RunResult, flat

_RESULT = "File of a scenario or of a saved run (run --json), preset, run id, or address of a run or link."
_RELATIVE, _ABSOLUTE = 1e-6, 1e-9  # room for rounding


def compare(
    services: Services,
    a: Annotated[str, typer.Argument(metavar="A", help=_RESULT, autocompletion=options.completes("presets"))],
    b: Annotated[str, typer.Argument(metavar="B", help="The same; changes are from A to B.")],
    strategy: options.Strategies = None,
    metric: Annotated[
        list[str] | None,
        options.option(
            "PATTERN",
            "Only these metrics, such as bump.*.peak; with commas or repeated.",
            autocompletion=options.completes("metrics"),
        ),
    ] = None,
    tolerance: Annotated[
        list[str] | None,
        options.option(
            "[PATTERN=]REL",
            "Equal up to this part of A's value [default: 1e-6]; of some metrics: comfort.*=0.05. Repeated: the "
            "last that fits.",
        ),
    ] = None,
    tolerance_abs: Annotated[
        list[str] | None,
        options.option("[PATTERN=]ABS", "Equal up to this much, in each metric's own unit [default: 1e-9]; likewise."),
    ] = None,
    worse: Annotated[
        bool,
        typer.Option("--worse", help="Only where B is worse: greater, no longer true, or failed."),
    ] = False,
    limit: Annotated[int, typer.Option(metavar="N", min=0, help="Show the N largest differences, 0 for all.")] = 20,
    as_json: Annotated[bool, typer.Option("--json", help="Every difference, as JSON.")] = False,
) -> None:
    """Compare two results metric by metric, the largest change first.

    A and B are equal where |B - A| is at most the larger of ABS and REL times |A|. Scenarios are run first, with the
    strategies of the other side or those --strategy names.

    Exit codes: 0 equal within the tolerance, 1 different, 2 bad input, 3 no service or it failed.
    """
    if a == b == "-":
        raise InputError("Only one of A and B can be standard input")
    equal = Tolerance(
        relative=_limits(tolerance or [], "--tolerance", _RELATIVE),
        absolute=_limits(tolerance_abs or [], "--tolerance-abs", _ABSOLUTE),
    )
    sides = [targets.find(target, services) for target in (a, b)]
    named = options.listed(strategy)
    runs = [_run(side, named, sides, services) for side in sides]
    field_units = services.names.units() if services.used else {}
    names = named or list(dict.fromkeys([*runs[0].strategies, *runs[1].strategies]))
    patterns = options.listed(metric) or ["*"]
    differing = differences(runs[0], runs[1], names, equal, patterns)
    differing = [item for item in differing if item.worse or not worse]
    if as_json:
        _print_json(runs, differing)
    else:
        for letter, side, run in zip("AB", sides, runs, strict=True):
            over = f", mean of {run.roads} roads" if run.roads > 1 else ""
            typer.echo(f"{letter}  {side.name} (core {run.core_version}{over})")
        for name, one, other in inputs(runs[0].scenario, runs[1].scenario):
            typer.echo(f"   {with_unit(name, field_units.get(name, ''))}: {shown(one)} -> {shown(other)}")
        if differing:
            _show(differing[:limit] if limit else differing, len(differing))
        else:
            count = sum(
                _fits(metric, patterns) for name in names for metric in _all(runs[0], name) if metric != "status"
            )
            how = "Not worse beyond" if worse else "Equal within"
            typer.echo(f"{how} the tolerance: {count} metrics of {', '.join(names)}")
    if differing:
        raise typer.Exit(DIFFERENT)


@dataclass(frozen=True, slots=True, kw_only=True)
class Tolerance:
    """Values are equal when |b − a| ≤ max(absolute, relative·|a|), both by metric; `absolute` is in its unit."""

    relative: Callable[[str], float]
    absolute: Callable[[str], float]

    def holds(self, metric: str, a: float, b: float) -> bool:
        """Whether b equals a."""
        return abs(b - a) <= max(self.absolute(metric), self.relative(metric) * abs(a))


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """One metric of one strategy that is not the same; `change` is (b − a)/|a|, infinite where it has no number."""

    strategy: str
    figure: str
    unit: str
    a: Figure | str
    b: Figure | str
    change: float

    @property
    def worse(self) -> bool:
        """Whether b is the worse one: smaller is better, true is better than false, and anything than a failure."""
        if isinstance(self.a, float | int) and isinstance(self.b, float | int):
            return self.a > self.b if isinstance(self.a, bool) else self.b > self.a
        return self.b is None or self.b in ("failed", "not run")


def differences(
    a: RunResult, b: RunResult, strategies: Sequence[str], tolerance: Tolerance, patterns: Sequence[str]
) -> list[Difference]:
    """Every metric that differs, and what became of the strategies; the largest change first."""
    differing = []
    for name in strategies:
        first, second = _all(a, name), _all(b, name)
        for metric in dict.fromkeys([*first, *second]):
            one, other = first.get(metric), second.get(metric)
            x, y = _number(one), _number(other)
            if x is None or y is None:
                same, change = type(one) is type(other) and one == other, math.inf
            else:
                same, change = tolerance.holds(metric, x, y), (y - x) / abs(x) if x else math.inf
            if (metric == "status" or _fits(metric, patterns)) and not same:
                unit = a.units.get(metric, "1")
                differing.append(Difference(strategy=name, figure=metric, unit=unit, a=one, b=other, change=change))
    return sorted(differing, key=lambda item: -abs(item.change))


def inputs(a: Mapping[str, Any], b: Mapping[str, Any]) -> list[tuple[str, Any, Any]]:
    """Fields of two complete scenarios that differ, by dotted name, with both values."""
    first, second = dict(flat(a)), dict(flat(b))
    pairs = [(name, first.get(name), second.get(name)) for name in dict.fromkeys([*first, *second])]
    return [(name, one, other) for name, one, other in pairs if one != other]


def _fits(metric: str, patterns: Sequence[str]) -> bool:
    return any(fnmatchcase(metric, pattern) for pattern in patterns)


def _limits(texts: Sequence[str], option: str, default: float) -> Callable[[str], float]:
    """The limit of a metric: that of the last `PATTERN=VALUE` that fits, where `VALUE` alone fits all."""
    limits = [("*", default)]
    for text in texts:
        pattern, _, value = text.rpartition("=")
        try:
            limits.append((pattern or "*", float(value)))
        except ValueError:
            limits.append(("*", math.nan))
        if not limits[-1][1] >= 0:
            raise InputError(f"{option}: {text} is neither a number from 0 on nor PATTERN=NUMBER")
    return lambda metric: next(value for pattern, value in reversed(limits) if fnmatchcase(metric, pattern))


def _run(item: targets.Target, named: list[str], both: list[targets.Target], services: Services) -> RunResult:
    """The run to compare: as it is stored, or made now."""
    if item.batch is not None:
        raise InputError(f"{item.name}: compare takes single runs; export writes a batch's table")
    if item.run is not None:
        missing = [name for name in named if name not in item.run.strategies]
        if missing:
            raise InputError(f"{item.name}: it has no {', '.join(missing)}, only {', '.join(item.run.strategies)}")
        return item.run
    others = [name for other in both for name in targets.strategies_of(other)]
    roads = max((other.run.roads for other in both if other.run is not None), default=1)
    return services.at().run(item.scenario, named or others or list(services.names.strategies), roads=roads)


def _all(run: RunResult, strategy: str) -> dict[str, Figure | str]:
    outcome = run.strategies.get(strategy)
    return {"status": "not run"} if outcome is None else {"status": outcome.status, **outcome.figures()}


def _number(value: Figure | str) -> float | None:
    return value if isinstance(value, float | int) and not isinstance(value, bool) else None


def _print_json(runs: list[RunResult], differing: list[Difference]) -> None:
    listed = [{**asdict(item), "change": item.change if math.isfinite(item.change) else None} for item in differing]
    sides = [{"id": run.id, "core_version": run.core_version} for run in runs]
    changed = [{"field": name, "a": one, "b": other} for name, one, other in inputs(runs[0].scenario, runs[1].scenario)]
    print_json({"a": sides[0], "b": sides[1], "equal": not differing, "inputs": changed, "differences": listed})


def _show(differing: list[Difference], total: int) -> None:
    rows = [
        [
            item.strategy,
            with_unit(item.figure, item.unit),
            shown(item.a),
            shown(item.b),
            f"{100 * item.change:+.2f} %" if math.isfinite(item.change) else "-",
        ]
        for item in differing
    ]
    typer.echo()
    show_table(["strategy", "metric", "A", "B", "change"], rows, left={0, 1})
    more = f"; these are the {len(differing)} largest, --limit 0 shows all" if total > len(differing) else ""
    typer.echo(f"\n{total} metrics differ beyond the tolerance{more}")
