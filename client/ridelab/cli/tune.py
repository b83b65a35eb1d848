"""`ridelab tune`: look for better weights, and print a tuning's answer as text."""

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from ridelab.cli import fields, following, options
from ridelab.cli.names import Names
from ridelab.cli.reporting import DIFFERENT, InputError, note, print_json, show_table, shown, with_unit, write
from ridelab.cli.service import Services
from ridelab.jobs import Tuning

_NORMALISED = re.compile(r"(paper|peaks)(?:@(\w+))?(?::(.*))?")
_SPAN = re.compile(r"(\d+)(?:-(\d+))?")
_MOST_SEEDS = 1000
_OBJECTIVE = (
    "paper (Eq. 16), peaks (the same with peaks), or a figure such as bump.body_acceleration.peak; paper@bump is over "
    "that window, paper:2,1,1 has other q. Up to three: a Pareto front [default: paper]."
)
_LIMIT = "On every training road, such as events.travel_exceeded_mm=1."
_SEARCH = (
    "Only these weights, options, horizons or times, such as mpc.stage_weights.bump.2=0.1:20 or "
    "own.mine.damping=1kNs/m:9kNs/m [default: all weights, 0.05:50; of a law of your own all numbers with bounds: its "
    "switches and choices stay, and a sweep tries them]."
)
_STRATEGY = "lv, suspension_only, lqr, or a law of your own."
_PREVIEW = "Kinds of preview to try too, such as obstacle,lookahead."
_UNCERTAIN = "On every road another car, sensors and actuators, as in a robustness study."
_QUANTILE = "Minimise this quantile over the roads, such as 0.9, not the mean."
_OUT = "Write the scenario with the tuned weights, as JSON."


def tune(
    services: Services,
    scenario: options.Scenario = "paper",
    objective: Annotated[list[str] | None, options.option("OBJECTIVE", _OBJECTIVE)] = None,
    limit: Annotated[list[str] | None, options.option("METRIC=MOST", _LIMIT)] = None,
    strategy: Annotated[str, typer.Option("--strategy", "-s", metavar="ID", help=_STRATEGY)] = "lv",
    search: Annotated[list[str] | None, options.option("WEIGHT=LOW:HIGH", _SEARCH)] = None,
    preview: Annotated[str | None, options.option("KIND,KIND", _PREVIEW)] = None,
    uncertain: Annotated[bool, options.flag(_UNCERTAIN, "--uncertain")] = False,
    quantile: Annotated[float | None, options.option("SHARE", _QUANTILE, min=0.5, max=1)] = None,
    trials: Annotated[int | None, options.option("N", "Sets of weights in all [default: 200].", min=1)] = None,
    seeds: Annotated[str | None, options.option("SEEDS", "Training roads [default: 1-4].")] = None,
    fresh: Annotated[str | None, options.option("SEEDS", "Validation roads [default: 101-110].")] = None,
    population: Annotated[int | None, options.option("N", "Tried at once [default: 16].", min=1)] = None,
    seed: options.Seed = 0,
    changes: options.Changes = None,
    resume: Annotated[str | None, options.option("TUNING", "Go on with this one, or show it where it is done.")] = None,
    out: Annotated[Path | None, options.option("FILE", _OUT, "--out", "-o", dir_okay=False)] = None,
    label: options.Label = None,
    detach: options.Detach = False,
    dry_run: options.DryRun = False,
    as_json: options.AsJson = False,
) -> None:
    """Look for weights that minimise an objective, and compare them with the paper's on validation roads.

    Ctrl-C cancels; --resume goes on where it stopped. With several objectives --out takes the front's knee.
    """
    if detach:
        following.check_detachable(services)
    ridelab = services.at()
    if resume is not None:
        tuning, code = ridelab.get_tuning(resume), 0
        if tuning.state != "done" or trials not in (None, tuning.total):  # else it is only shown
            tuning.resume(trials)
    else:
        limits = [fields.limit_of(text, services.names.metrics, "events.travel_exceeded_mm=1") for text in limit or []]
        asked = {
            "objectives": [objective_of(text) for text in objective or ["paper"]],
            "limits": [{"figure": name, "at_most": most} for name, most in limits],
            "search": fields.ranges_of(search, "--search", services.names.fields) if search else None,
            "previews": preview.split(",") if preview is not None else None,
            "uncertain": uncertain or None,
            "quantile": quantile,
            "seeds": seeds_of(seeds, "--seeds"),
            "fresh_seeds": seeds_of(fresh, "--fresh"),
            "trials": trials,
            "population": population,
            "label": label,
        }
        start = fields.scenario_of(scenario, changes, services)
        request = {"scenario": start, "strategy": strategy, "seed": seed}
        request |= {name: value for name, value in asked.items() if value is not None}
        if dry_run:
            following.show_estimate(ridelab.estimate_tuning(request), "runs", "generations", as_json=as_json)
            return
        tuning, code = following.submit_job(lambda key: ridelab.tune(request, key), services)
    if detach:
        following.show_detached(tuning, services, as_json=as_json)
        raise typer.Exit(code)
    if code := code or following.follow_to_end(tuning, services):
        note(f"To go on: {following.resume_command(tuning, services)}")
        raise typer.Exit(code)
    if tuning.state != "done":
        raise typer.Exit(following.say_end(tuning))
    print_json(tuning.answer) if as_json else _show(tuning, services.names)
    best = tuning.knee or tuning.best[0]
    if out is not None and best is not None:
        tuned = fields.with_values(tuning.answer["scenario"], best["weights"])
        write([json.dumps(tuned, indent=1).encode() + b"\n"], out)
        note(f"{out} has the weights of trial {best['number']}")
    following.say_end(tuning)
    raise typer.Exit(DIFFERENT * (best is None))


def objective_of(text: str) -> dict[str, Any]:
    """`paper`, `peaks@bump:1,1,2`, or a figure's name."""
    match = _NORMALISED.fullmatch(text)
    if match is None:
        return {"kind": "figure", "figure": text}
    kind, window, q = match.groups()
    objective: dict[str, Any] = {"kind": kind} | ({"window": window} if window else {})
    if q is not None:
        try:
            objective["q"] = [float(each) for each in q.split(",")]
        except ValueError:
            raise InputError(f"--objective {kind}:Q1,Q2,Q3 takes three numbers") from None
    return objective


def seeds_of(text: str | None, option: str) -> list[int] | None:
    """The numbers of `1-4,7`."""
    if text is None:
        return None
    numbers: list[int] = []
    for item in text.split(","):
        span = _SPAN.fullmatch(item.strip())
        low, high = (int(span[1]), int(span[2] or span[1])) if span else (1, 0)
        if not 0 <= high - low < _MOST_SEEDS:
            raise InputError(f"{option} takes whole numbers and spans of them, such as 1-4,7")
        numbers += range(low, high + 1)
    return numbers


def _show(tuning: Tuning, names: Names) -> None:
    """Print the best trials, then the comparison on the validation roads."""
    answer, comparison = tuning.answer, tuning.comparison
    typer.echo(f"Ridelab core {answer['core_version']}, weights of {names.label(answer['strategy'])}")
    within = f", {tuning.feasible} within the limits" if answer["limits"] else ""
    typer.echo(f"{tuning.done} trials on roads {_spans(answer['seeds'])}{within}\n")
    _show_points(answer)
    best = [trial["number"] for trial in tuning.best if trial is not None]
    if best and tuning.paper is not None and set(best) == {tuning.paper["number"]}:
        first = _first(answer, "the paper's")
        typer.echo(f"\nNo weights that were tried are better than {first}; --resume with more --trials tries more.")
    for point in comparison["points"] if comparison is not None else []:
        if comparison is not None and point["verdict"] is not None:
            _show_compared(answer, comparison["figures"], comparison["points"][0], point)


def _first(answer: Mapping[str, Any], papers: str) -> str:
    """Return the first trial's name: the one given, or the defaults where the controller is one's own."""
    return papers if answer.get("source") is None else "the defaults"


def _show_points(answer: Mapping[str, Any]) -> None:
    """A row for each point of interest: its values and its weights."""
    named: dict[int, tuple[list[str], Mapping[str, Any]]] = {}
    several = len(answer["objectives"]) > 1
    roles = [(_first(answer, "the paper's"), answer["paper"]), ("the scenario's", answer["own"])]
    roles += [(f"best {index + 1}" if several else "best", trial) for index, trial in enumerate(answer["best"])]
    for role, trial in [*roles, ("knee", answer["knee"])]:
        if trial is not None:
            named.setdefault(trial["number"], ([], trial))[0].append(role)
    aims = [*answer["objectives"], *answer["limits"]]
    weights = list(next(iter(named.values()))[1]["weights"]) if named else []
    rows = []
    for names, trial in named.values():
        values = [*trial["values"], *trial["limits"]] if trial["status"] == "ok" else [None] * len(aims)
        tried = (trial["weights"][name] for name in weights)
        cells = [shown(value, 4) for value in values]
        cells += [each if isinstance(each, str) else shown(each, 6) for each in tried]
        rows.append([", ".join(names), trial["number"], *cells])
    heads = [with_unit(each["label"], each["unit"]) for each in aims] + [name.rpartition("mpc.")[2] for name in weights]
    show_table(["weights", "trial", *heads], rows)


def _show_compared(
    answer: Mapping[str, Any], figures: Sequence[Mapping[str, Any]], paper: Mapping[str, Any], point: Mapping[str, Any]
) -> None:
    """One point against the first trial, the training roads beside the validation roads."""
    roads = f"training roads {_spans(answer['seeds'])}, validation roads {_spans(answer['fresh_seeds'])}"
    weights, first = _first(answer, "the paper's weights"), _first(answer, "the paper").removeprefix("the ")
    typer.echo(f"\nTrial {point['trial']} against {weights}; {roads}")
    heads = ["mean of", first, "tuned", "change"]
    heads += [f"{first}, validation", "tuned, validation", "change, validation (95 %)", ""]
    rows = []
    for figure in figures:
        kind, _, index = figure["key"].partition(".")
        of_limit = kind == "limits"  # not its mean counts but its worst road
        cells = [with_unit(figure["label"] + (", worst" if of_limit else ""), figure["unit"])]
        for where in ("training", "fresh"):
            both = [each[where].get(figure["key"], {}) for each in (paper, point)]
            cells += [shown(each.get("worst" if of_limit else "mean"), 4) for each in both]
            cells.append("" if of_limit else _change(both[1].get("change"), interval=where == "fresh"))
        rows.append([*cells, point["verdict"][int(index)] if kind == "objectives" else ""])
    show_table(heads, rows)
    for failure in point["failures"]:
        typer.echo(failure)


def _change(change: Mapping[str, Any] | None, *, interval: bool) -> str:
    if change is None:
        return "-"
    text = f"{change['value']:+z.1f} %"
    return (
        f"{text} ({change['low']:+z.1f} .. {change['high']:+z.1f})" if interval and change["low"] is not None else text
    )


def _spans(numbers: Sequence[int]) -> str:
    """`1-4, 7`."""
    spans: list[list[int]] = []
    for number in numbers:
        if spans and number == spans[-1][1] + 1:
            spans[-1][1] = number
        else:
            spans.append([number, number])
    return ", ".join(str(low) if low == high else f"{low}-{high}" for low, high in spans)
