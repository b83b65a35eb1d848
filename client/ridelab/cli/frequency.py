"""`ridelab frequency`: at which frequency a strategy wins, and how close it is to instability."""

from collections.abc import Sequence
from itertools import pairwise, zip_longest
from math import degrees
from typing import Annotated, Any

import typer

from ridelab.cli import fields, options
from ridelab.cli.reporting import InputError, print_json, show_table
from ridelab.cli.service import Services

_STAGES = ("cruise", "brake", "bump")
_STAGE = "Driving stage whose weights hold: cruise, brake or bump."
_WEIGHTED = "weighted_body_acceleration"
_SIGNAL = (
    "Whose RMS in each band: both accelerations, tyre loads and deflections by key; weighted is by ISO 2631-1's Wk."
)


def frequency(
    services: Services,
    scenario: options.Scenario = "paper",
    changes: options.Changes = None,
    strategy: options.Strategies = None,
    stage: Annotated[str, options.option("STAGE", _STAGE)] = "cruise",
    signal: Annotated[str, options.option("KEY", _SIGNAL)] = _WEIGHTED,
    baseline: options.Baseline = None,
    as_json: options.AsJson = False,
) -> None:
    """Show responses to the road by frequency, modes and stability margins of strategies in one driving stage.

    All of it while no limit binds; held forces, actuator lag, estimator, ECU delay and preview are inside. Changes are
    against passive, or against --baseline, which also shows at which frequencies the signal is below the baseline's;
    none is at no frequency, and - stands where there is nothing to compare.
    """
    if stage not in _STAGES:
        raise InputError(f"--stage is one of {', '.join(_STAGES)}")
    start = fields.scenario_of(scenario, changes, services)
    names = options.listed(strategy) or list(services.names.strategies)
    against = baseline or "passive"
    asked = names if against in names or (as_json and baseline is None) else [*names, against]
    answer = services.at().frequency(start, asked, stage=stage)
    if as_json:
        print_json(answer)
        return
    results = {services.names.label(name): answer["strategies"][name] for name in names}
    of_bands = {label: each["bands"] for label, each in results.items() if each["bands"] is not None}
    if of_bands and signal not in (keys := next(iter(of_bands.values()))):
        raise InputError(f"--signal is one of {', '.join(keys)}")
    weighted = signal == _WEIGHTED
    words = "body acceleration as ISO 2631-1 weighs it" if weighted else services.names.signal(signal)
    typer.echo(f"Stage {stage}, while no limit binds; {words}, against {services.names.label(against)}\n")
    heads = ["RMS [m/s^2]" if weighted else "RMS", *(f"{low:g}-{high:g} Hz" for low, high in answer["bands"])]
    base, frequencies = answer["strategies"][against], answer["frequency"]
    rows = [[label, *_bands(each, base["bands"], signal)] for label, each in of_bands.items()]
    if baseline is not None:
        heads.append(f"below {services.names.label(baseline)} [Hz]")
        for row, label in zip(rows, of_bands, strict=True):
            row.append(_below(results[label]["psd"], base["psd"], signal, frequencies))
    if rows:
        show_table(heads, rows)
        typer.echo()
    judged = [[label, *_margins(each)] for label, each in results.items() if each["modes"] is not None]
    if judged:
        show_table(
            ["margins", "gain front", "gain rear", "phase front", "phase rear", "disk of both", "least damping"], judged
        )
    for label, each in (results | {services.names.label(against): base}).items():
        if each["reason"] is not None:
            typer.echo(f"{label}  {each['reason']}")


def _below(
    psd: dict[str, list[float]], of_baseline: dict[str, list[float]] | None, signal: str, frequency: Sequence[float]
) -> str:
    """The frequencies at which a signal is less than the baseline's: `0.3-2.31, 4.1-30`."""
    if of_baseline is None or psd is of_baseline:
        return "-"
    differences = [value - base for value, base in zip(psd[signal], of_baseline[signal], strict=True)]
    edges = [frequency[0]] if differences[0] < 0 else []
    for (low, before), (high, after) in pairwise(zip(frequency, differences, strict=True)):
        if (before < 0) != (after < 0):
            edges.append(low + (high - low) * before / (before - after))
    spans = zip_longest(edges[::2], edges[1::2], fillvalue=frequency[-1])
    return ", ".join(f"{low:.4g}-{high:.4g}" for low, high in spans) or "none"


def _bands(bands: dict[str, list[float]], of_baseline: dict[str, list[float]] | None, signal: str) -> list[str]:
    values = bands[signal]
    base = of_baseline[signal] if of_baseline is not None and of_baseline is not bands else [0.0] * len(values)
    return [
        f"{value:.3g}{f' ({100 * (value / reference - 1):+z.0f} %)' if reference else ''}"
        for value, reference in zip(values, base, strict=True)
    ]


def _margins(result: dict[str, Any]) -> list[str]:
    """Gain as a factor, phase in degrees; a dash is without bound, or there is no loop."""
    least = f"{min(mode['damping_ratio'] for mode in result['modes']):.3f}"
    margins = result["margins"]
    if margins is None:
        return ["-"] * 5 + [least]
    axles = (margins["front"], margins["rear"])
    gains = ["-" if axle["gain"] is None else f"x {axle['gain']:.2f}" for axle in axles]
    phases = ["-" if axle["phase"] is None else f"{degrees(axle['phase']):.0f}°" for axle in axles]
    return [*gains, *phases, f"{margins['disk']:.3f}", least]
