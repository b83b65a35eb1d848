"""`ridelab compare`: two results, metric by metric; its exit code says whether they are the same."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from fnmatch import fnmatchcase
from typing import Annotated, Any

import typer

from ridelab.cli import options, recorded, requirements, tables, targets
from ridelab.cli.reporting import DIFFERENT, InputError, folder_of, print_json, show_table, shown, with_unit
from ridelab.cli.service import Services
from ridelab.requirements import FAIL, PASS, RequirementResult, failing
from ridelab.results import Figure, RunResult, flat

_RESULT = "File of a scenario or of a saved run (run --json), preset, run id, or address of a run or link."
Equal = Callable[[str, float, float], bool]
_RELATIVE, _ABSOLUTE = 1e-6, 1e-9  # room for rounding
_OTHER = "The same, or a recorded drive, a file .csv; changes are from A to B."
_COLUMN = "What a column of a recorded drive is, 'acc_z=body_acceleration [g]'; nothing behind = leaves it out."
_METRICS = "Only these metrics, such as bump.*.peak; with commas or repeated."
_PART = "Equal up to this part of A's value [default: 1e-6]; of some metrics: comfort.*=0.05. Of several the last."
_JUNIT = "Write there as JUnit XML which strategies are equal, and what becomes of requirements."
_MUCH = "Equal up to this much, in each metric's own unit [default: 1e-9]; likewise."


def compare(
    services: Services,
    a: Annotated[str, typer.Argument(metavar="A", help=_RESULT, autocompletion=options.completes("presets"))],
    b: Annotated[str, typer.Argument(metavar="B", help=_OTHER)],
    strategy: options.Strategies = None,
    metric: Annotated[list[str] | None, options.option("PATTERN", _METRICS, completes="metrics")] = None,
    tolerance: Annotated[list[str] | None, options.option("[PATTERN=]REL", _PART)] = None,
    tolerance_abs: Annotated[list[str] | None, options.option("[PATTERN=]ABS", _MUCH)] = None,
    worse: Annotated[
        bool, options.flag("Only what is worse in B: greater, no longer true, failed.", "--worse")
    ] = False,
    same_scenario: Annotated[
        bool, options.flag("Different scenarios are a difference, too.", "--same-scenario")
    ] = False,
    column: Annotated[list[str] | None, options.option("NAME=SIGNAL [UNIT]", _COLUMN)] = None,
    table: tables.Table = None,
    baseline: options.Baseline = None,
    require: requirements.Require = None,
    strict: requirements.Strict = False,
    junit: Annotated[str | None, options.option("FILE", _JUNIT)] = None,
    limit: Annotated[int, typer.Option(metavar="N", min=0, help="Show the N largest differences, 0 for all.")] = 20,
    as_json: options.AsJson = False,
) -> None:
    """Compare two results metric by metric, the largest change first.

    A and B are equal where |B - A| is at most the larger of ABS and REL times |A|. Scenarios are run first, with the
    strategies of the other side or those --strategy names.

    A recorded drive is compared with the one strategy that drove it: the metrics it has, and as signal.NAME the
    difference of both curves at the same positions. Its RMS, shown as B, is held to REL times the RMS of A's curve.

    --require holds B to limits; of a recorded drive changes are against the strategy that drove it.

    Exit codes: 0 equal within the tolerance, 1 different or a requirement fails, 2 bad input, 3 no service or it
    failed.
    """
    if a == b == "-":
        raise InputError("Only one of A and B can be standard input")
    equal = equal_within(tolerance or [], tolerance_abs or [])
    if junit is not None:
        folder_of(junit, "--junit")
    required = requirements.requirements_of(require, services)
    if baseline is not None and not required:
        raise InputError("--baseline is what requirements' changes are against: give some with --require")
    named, patterns = options.listed(strategy), options.listed(metric, "--metric")
    drive = None
    if b.lower().endswith(recorded.ENDINGS):
        side = targets.find(a, services)
        drive = recorded.beside(b, side, named, recorded.mapping(column or []), table, services)
        sides, first, second, names = [side], drive.simulated, drive.recorded, [drive.strategy]
    else:
        sides = [targets.find(target, services) for target in (a, b)]
        first, second = (_run(side, named, sides, services) for side in sides)
        names = named or list(dict.fromkeys([*first.strategies, *second.strategies]))
    check_patterns(first, second, {"--metric": patterns, **limited(tolerance or [], tolerance_abs or [])}, drive)
    patterns = patterns or ["*"]
    curves = [] if drive is None else [key for key in drive.curves if _fits(f"{recorded.SIGNAL}{key}", patterns)]
    if drive is not None:  # those that it has; none fits where only signals were asked for
        patterns = [metric for metric in drive.metrics if _fits(metric, patterns)] or [recorded.SIGNAL]
    differing = [item for item in differences(first, second, names, equal, patterns) if item.worse or not worse]
    if drive is not None:
        differing = sorted([*differing, *_apart(drive, curves, equal)], key=lambda item: -abs(item.change))
    held, base = (second, baseline) if drive is None else (first, baseline or drive.strategy)
    judged = requirements.judged(held, required, base, b, services)
    changed = inputs(first.scenario, second.scenario)
    other_scenario = same_scenario and bool(changed)
    if as_json:
        _print_json(first, second, drive, differing, changed, judged, equal=not (differing or other_scenario))
    else:
        for letter, side, run in zip("AB", sides, (first, second), strict=drive is None):
            over = f", mean of {run.roads} roads" if run.roads > 1 else ""
            typer.echo(f"{letter}  {side.name} (core {run.core_version}{over})")
        if drive is not None:
            typer.echo("\n   ".join([f"B  {b}", *drive.said]))
        _show_inputs(changed, services)
        if differing:
            _show(differing[: limit or None], len(differing))
        else:
            metrics = [metric for name in names for metric in _all(first, name) if metric != "status"]
            count = sum(_fits(metric, patterns) for metric in metrics) + len(curves)
            how = "Not worse beyond" if worse else "Equal within"
            typer.echo(f"{how} the tolerance: {count} metrics of {', '.join(names)}")
        if other_scenario:
            typer.echo(f"The scenarios differ in {len(changed)} field{'s' * (len(changed) > 1)}")
        if judged:
            typer.echo()
            requirements.show(judged, services)
    if junit is not None:
        cases = [*_cases(names, differing, changed if same_scenario else ()), *requirements.cases(judged, services)]
        requirements.write_junit(cases, junit, "ridelab compare", strict=strict)
    if differing or other_scenario or failing(judged, strict=strict):
        raise typer.Exit(DIFFERENT)


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
        """Check whether b is worse: smaller is better, true is better than false, and anything than a failure."""
        if isinstance(self.a, float | int) and isinstance(self.b, float | int):
            return self.a > self.b if isinstance(self.a, bool) else self.b > self.a
        return self.b is None or self.b in ("failed", "not run")


def differences(
    a: RunResult, b: RunResult, strategies: Sequence[str], equal: Equal, patterns: Sequence[str]
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
                same, change = equal(metric, x, y), (y - x) / abs(x) if x else math.inf
            if (metric == "status" or _fits(metric, patterns)) and not same:
                unit = a.units.get(metric, "1")
                differing.append(Difference(strategy=name, figure=metric, unit=unit, a=one, b=other, change=change))
    return sorted(differing, key=lambda item: -abs(item.change))


def _print_json(
    first: RunResult,
    second: RunResult,
    drive: recorded.RecordedSide | None,
    differing: Sequence[Difference],
    changed: Sequence[tuple[str, Any, Any]],
    judged: Sequence[RequirementResult],
    *,
    equal: bool,
) -> None:
    head: dict[str, Any] = {
        key: {"id": run.id, "core_version": run.core_version} for key, run in (("a", first), ("b", second))
    }
    if drive is not None:
        head["b"] = {"recording": drive.recorded[drive.strategy].recording, "notes": drive.said}
    fields = [{"field": name, "a": one, "b": other} for name, one, other in changed]
    listed = [{**asdict(item), "change": item.change if math.isfinite(item.change) else None} for item in differing]
    results = {"requirement_results": [asdict(each) for each in judged]} if judged else {}
    print_json({**head, "equal": equal, "inputs": fields, "differences": listed, **results})


def _show_inputs(changed: Sequence[tuple[str, Any, Any]], services: Services) -> None:
    units = services.names.fields if services.opened else {}
    for name, one, other in changed:
        typer.echo(f"   {with_unit(name, units.get(name, ''))}: {shown(one)} -> {shown(other)}")


def _cases(
    names: Sequence[str], differing: Sequence[Difference], changed: Sequence[tuple[str, Any, Any]]
) -> Iterator[requirements.Case]:
    """For a CI system: a case for each strategy, and one for scenarios that have to be the same and are not."""
    for name in names:
        said = [f"{each.figure}: {each.a} -> {each.b}" for each in differing if each.strategy == name]
        result, name_of_case = FAIL if said else PASS, "equal within the tolerance"
        yield requirements.Case(strategy=name, name=name_of_case, result=result, message="; ".join(said))
    if changed:
        message = "; ".join(f"{field}: {one} -> {other}" for field, one, other in changed)
        yield requirements.Case(strategy="scenario", name="the same", result=FAIL, message=message)


def _apart(drive: recorded.RecordedSide, curves: Sequence[str], equal: Equal) -> list[Difference]:
    """Signals whose curves differ: a is the RMS of the simulated one, b that of the difference."""
    apart = []
    for key in curves:
        size, difference = drive.curves[key]["baseline_rms"], drive.curves[key]["rms"]
        name = f"{recorded.SIGNAL}{key}"
        if not equal(name, size, size + difference):
            change = difference / size if size else math.inf
            apart.append(
                Difference(
                    strategy=drive.strategy, figure=name, unit=drive.units[key], a=size, b=difference, change=change
                )
            )
    return apart


def inputs(a: Mapping[str, Any], b: Mapping[str, Any]) -> list[tuple[str, Any, Any]]:
    """Fields of two complete scenarios that differ, by dotted name, with both values."""
    first, second = dict(flat(a)), dict(flat(b))
    pairs = [(name, first.get(name), second.get(name)) for name in dict.fromkeys([*first, *second])]
    return [(name, one, other) for name, one, other in pairs if one != other]


def check_patterns(
    a: RunResult, b: RunResult, patterns: Mapping[str, Sequence[str]], drive: recorded.RecordedSide | None = None
) -> None:
    """Refuse a pattern that fits no metric: a comparison of nothing would always pass.

    Raises:
        InputError: Naming the option and what the names of metrics begin with.
    """
    metrics = {name for run in (a, b) for outcome in run for name in outcome.figures()} or {*a.units, *b.units}
    if drive is not None:
        metrics = {*drive.metrics, *(f"{recorded.SIGNAL}{key}" for key in drive.curves)}
    for option, texts in patterns.items():
        for pattern in texts:
            if not any(fnmatchcase(metric, pattern) for metric in metrics):
                starts = sorted({metric.partition(".")[0] for metric in metrics})
                raise InputError(f"{option}: {pattern} fits no metric; their names begin with {', '.join(starts)}")


def limited(relative: Sequence[str], absolute: Sequence[str]) -> dict[str, list[str]]:
    """The patterns of both tolerances, by option."""
    texts = {"--tolerance": relative, "--tolerance-abs": absolute}
    return {option: [text.rpartition("=")[0] or "*" for text in patterns] for option, patterns in texts.items()}


def _fits(metric: str, patterns: Sequence[str]) -> bool:
    return any(fnmatchcase(metric, pattern) for pattern in patterns)


def equal_within(relative: Sequence[str], absolute: Sequence[str]) -> Equal:
    """Says whether |b − a| ≤ max(absolute, relative·|a|) for a metric, a and b; `absolute` is in the metric's unit."""
    part, much = _limits(relative, "--tolerance", _RELATIVE), _limits(absolute, "--tolerance-abs", _ABSOLUTE)
    return lambda metric, a, b: abs(b - a) <= max(much(metric), part(metric) * abs(a))


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
    """The run to compare: the stored one, or one computed now."""
    if item.batch is not None:
        raise InputError(f"{item.name}: compare takes single runs; export writes a batch's table")
    if item.run is not None:
        if missing := [name for name in named if name not in item.run.strategies]:
            raise InputError(f"{item.name}: it has no {', '.join(missing)}, only {', '.join(item.run.strategies)}")
        return item.run
    names = named or [name for other in both for name in other.strategies] or list(services.names.strategies)
    roads = max((other.run.roads for other in both if other.run is not None), default=1)
    return services.at().run(item.scenario, names, roads=roads)


def _all(run: RunResult, strategy: str) -> dict[str, Figure | str]:
    outcome = run.strategies.get(strategy)
    return {"status": "not run"} if outcome is None else {"status": outcome.status, **outcome.figures()}


def _number(value: Figure | str) -> float | None:
    return value if isinstance(value, float | int) and not isinstance(value, bool) else None


def _show(differing: list[Difference], total: int) -> None:
    typer.echo()
    changes = [f"{100 * item.change:+z.2f} %" if math.isfinite(item.change) else "-" for item in differing]
    rows = [[item.strategy, with_unit(item.figure, item.unit), item.a, item.b] for item in differing]
    show_table(["strategy", "metric", "A", "B", "change"], [[*row, at] for row, at in zip(rows, changes, strict=True)])
    more = f"; these are the {len(differing)} largest, --limit 0 shows all" if total > len(differing) else ""
    typer.echo(f"\n{total} metrics differ beyond the tolerance{more}")
