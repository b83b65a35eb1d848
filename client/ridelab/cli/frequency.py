"""`ridelab frequency`: at which frequency a strategy wins, and how close it is to instability."""

from math import degrees
from typing import Annotated, Any

import typer

from ridelab.cli import fields, options
from ridelab.cli.reporting import InputError, print_json
from ridelab.cli.service import Services
from ridelab.cli.tables import show_table

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
    as_json: options.AsJson = False,
) -> None:
    """Show responses to the road by frequency, modes and stability margins of strategies in one driving stage.

    All of it while no limit binds; held forces, actuator lag, estimator, ECU delay and preview are inside.
    """
    if stage not in _STAGES:
        raise InputError(f"--stage is one of {', '.join(_STAGES)}")
    start = fields.scenario_of(scenario, changes, services)
    names = options.listed(strategy) or list(services.names.strategies)
    asked = names if "passive" in names or as_json else [*names, "passive"]
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
    typer.echo(f"Stage {stage}, while no limit binds; {words}, against passive\n")
    heads = [f"{low:g}-{high:g} Hz" for low, high in answer["bands"]]
    passive = answer["strategies"]["passive"]["bands"] if "passive" in answer["strategies"] else None
    rows = [[label, *_bands(each, passive, signal)] for label, each in of_bands.items()]
    if rows:
        show_table(["RMS [m/s^2]" if weighted else "RMS", *heads], rows)
        typer.echo()
    judged = [[label, *_margins(each)] for label, each in results.items() if each["modes"] is not None]
    if judged:
        show_table(
            ["margins", "gain front", "gain rear", "phase front", "phase rear", "disk of both", "least damping"], judged
        )
    for label, each in results.items():
        if each["reason"] is not None:
            typer.echo(f"{label}  {each['reason']}")


def _bands(bands: dict[str, list[float]], passive: dict[str, list[float]] | None, signal: str) -> list[str]:
    values = bands[signal]
    base = passive[signal] if passive is not None and passive is not bands else [0.0] * len(values)
    return [
        f"{value:.3g}{f' ({100 * (value / reference - 1):+.0f} %)' if reference else ''}"
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
