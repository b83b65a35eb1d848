"""`ridelab robustness`: how each strategy does where car, sensors and actuators are not what it believes."""

import json
import uuid
from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any

import typer

from backend.cli import fields, options, targets
from backend.cli.following import Table, interrupted, take
from backend.cli.reporting import DIFFERENT, InputError, UnavailableError, note, nothing_submitted
from backend.cli.services import Services
from backend.cli.tables import aligned, label, shown, with_unit
from backend.client import Batch, Ridelab

_FOLLOWED = 2  # fields named beside a figure
_CHANCE = 0.001  # what chance makes more often than this is not named


def robustness(
    scenario: options.Scenario = "paper",
    samples: Annotated[
        int | None, typer.Option(metavar="N", min=2, help="Points drawn [default: 200].", show_default=False)
    ] = None,
    ranges: Annotated[
        list[str] | None,
        typer.Option(
            "--range", metavar="FIELD=LOW:HIGH", help="Instead of, or beside, the default ranges.", show_default=False
        ),
    ] = None,
    exact: Annotated[
        list[str] | None,
        typer.Option(metavar="FIELD", help="Known exactly: not varied; with commas or repeated.", show_default=False),
    ] = None,
    only: Annotated[bool, typer.Option("--only", help="Vary only what --range names.")] = False,
    seed: Annotated[int, typer.Option(metavar="N", min=0, help="Same seed, same points.")] = 0,
    strategy: options.Strategies = None,
    baseline: Annotated[
        str | None, typer.Option(metavar="ID", help="Compare with this one [default: lv].", show_default=False)
    ] = None,
    changes: options.Changes = None,
    as_json: Annotated[bool, typer.Option("--json", help="The whole summary, as JSON.")] = False,
    server: options.Server = None,
    data_dir: options.DataDir = None,
) -> None:
    """Worst case and quantiles of each strategy over uncertain mass, stiffness, damping, preview and actuators.

    Every strategy runs at the same points of a Latin hypercube; the controllers know none of it. Without options it is
    the study that GET /robustness describes.
    """
    with Services(server, data_dir) as services:
        try:
            start = fields.changed(targets.find(scenario, services).scenario, changes or [])
            ridelab = services.at()
            usual = ridelab.get("/robustness")
            names = options.listed(strategy) or usual["strategies"]
            if baseline is not None and baseline not in names:
                raise InputError(f"--baseline: {baseline} is not among the strategies {', '.join(names)}")
            chosen = _ranges({} if only else usual["ranges"], fields.ranges_of(ranges or []), options.listed(exact))
            cube = {"ranges": chosen, "samples": samples or usual["samples"], "seed": seed}
        except KeyboardInterrupt:
            raise nothing_submitted() from None
        batch = _submit(ridelab, start, names, {"latin_hypercube": cube})
        take(batch, Table(out=None, server=server, data_dir=data_dir), ours=True)
        if batch.state == "failed":
            raise UnavailableError(f"The batch failed: {batch.reason}")
        summary = batch.summary(baseline=baseline)
    if as_json:
        typer.echo(json.dumps(summary, indent=1, ensure_ascii=False))
    else:
        for line in _lines(summary, chosen, batch.answer["core_version"]):
            typer.echo(line)
    note(f"batch {batch.id}: {batch.done} of {batch.total} runs done, {batch.failed} failed")
    if batch.failed or batch.state == "cancelled":
        raise typer.Exit(DIFFERENT)


def _submit(ridelab: Ridelab, scenario: dict[str, Any], strategies: list[str], sweep: dict[str, Any]) -> Batch:
    """Hand it in; interrupted meanwhile, the same key tells whether it was accepted, and it ends."""
    key = uuid.uuid4().hex
    try:
        return ridelab.submit(scenario, strategies, sweep, idempotency_key=key)
    except KeyboardInterrupt:
        batch = ridelab.submit(scenario, strategies, sweep, idempotency_key=key)
        raise interrupted(batch, Table(out=None)) from None


def _ranges(
    usual: Sequence[Mapping[str, Any]], given: Mapping[str, list[float]], exact: Sequence[str]
) -> dict[str, list[float]]:
    """What varies, the usual fields first.

    Raises:
        InputError: Nothing does, or a field that does not vary is to be exact.
    """
    found = {each["field"]: [each["low"], each["high"]] for each in usual} | dict(given)
    for name in exact:
        if found.pop(name, None) is None:
            raise InputError(f"--exact: {name} is not varied; what is: {', '.join(found) or 'nothing'}")
    if not found:
        raise InputError("Nothing is uncertain: every field is exact. Name one with --range FIELD=LOW:HIGH")
    return found


def _lines(summary: Mapping[str, Any], ranges: Mapping[str, Sequence[float]], version: str) -> Iterator[str]:
    """The summary as a person reads it."""
    names, baseline = list(summary["strategies"]), summary["baseline"]
    what = f"{summary['points']} points of {len(ranges)} uncertain fields"
    yield f"Ridelab core {version}: {what}; changes against {label(baseline)} at the same point"
    yield "  " + ", ".join(f"{name} {shown(low)}:{shown(high)}" for name, (low, high) in ranges.items())
    values = ["", "nominal", "median", "5 %", "95 %", "worst", "in run"]
    for key, unit in summary["units"].items():
        yield f"\n{with_unit(key, unit)}"
        event = key.startswith("events.")
        heads = [*values, *(["over 0"] if event else ["change, median", "5 %", "95 %", "better"]), "follows"]
        rows = [_row(name, summary["strategies"][name]["figures"][key], summary["quantiles"], event) for name in names]
        yield from aligned(heads, rows, left={0, len(heads) - 1})
    yield "\nleast damping ratio of the closed loop (below 0: unstable)"
    heads = ["", "nominal", "median", "lowest", "in run", "unstable", "follows"]
    rows = [_stability(name, summary["strategies"][name]["stability"], summary["quantiles"]) for name in names]
    yield from aligned(heads, rows, left={0, len(heads) - 1})
    for name in names:
        for reason, count in summary["strategies"][name]["reasons"].items():
            yield f"{label(name)}: {count} failed: {reason}"


def _row(name: str, figure: Mapping[str, Any], percents: Sequence[float], event: bool) -> list[str]:
    """What happens at few points only (an event) says at how many; a change in % would have nothing to refer to."""
    return [
        label(name),
        shown(figure["nominal"], 4),
        *(shown(_quantile(figure, percents, at), 4) for at in (50, 5, 95, 100)),
        "-" if figure["highest"] is None or (event and not figure["above_zero"]) else str(figure["highest"]["run"]),
        *([f"{figure['above_zero']} of {figure['n']}"] if event else _compared(figure["margin"], percents)),
        _follows(figure["sensitivity"]),
    ]


def _compared(margin: Mapping[str, Any] | None, percents: Sequence[float]) -> list[str]:
    if margin is None:
        return ["", "", "", ""]
    better = None if margin["better"] is None else 100 * margin["better"]
    return [*(_percent(_quantile(margin, percents, at)) for at in (50, 5, 95)), _percent(better, signed=False)]


def _stability(name: str, found: Mapping[str, Any], percents: Sequence[float]) -> list[str]:
    return [
        label(name),
        shown(found["nominal"], 3),
        shown(_quantile(found, percents, 50), 3),
        shown(_quantile(found, percents, 0), 3),
        "-" if found["lowest"] is None else str(found["lowest"]["run"]),
        f"{found['unstable']} of {found['known']}",
        _follows(found["sensitivity"]),
    ]


def _quantile(distribution: Mapping[str, Any], percents: Sequence[float], at: float) -> float | None:
    found = distribution["quantiles"]
    return None if found is None else float(found[list(percents).index(at)])


def _percent(value: float | None, *, signed: bool = True) -> str:
    return "-" if value is None else f"{value:{'+' if signed else ''}.0f} %"


def _follows(sensitivity: Sequence[Mapping[str, Any]]) -> str:
    """The fields that matter most, with their rank correlation."""
    named = [item for item in sensitivity if item["p_value"] < _CHANCE][:_FOLLOWED]
    return ", ".join(f"{item['field'].rpartition('.')[2]} {item['spearman']:+.2f}" for item in named)
