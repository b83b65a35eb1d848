"""`ridelab controller`: LV's controller as an ECU's program."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ridelab.cli import fields, options
from ridelab.cli.reporting import InputError, check_out, deliver, note, print_json, show_table
from ridelab.cli.service import Services, end_as_server

_OUT = "Write the C sources there, as a zip; - is stdout."
_PROGRAM = "Drive this program, built from those sources."


def controller(
    services: Services,
    scenario: options.Scenario = "paper",
    out: Annotated[str | None, options.option("FILE", _OUT, "--out", "-o")] = None,
    report: Annotated[bool, options.flag("Say whether it fits an STM32F103, and what does.", "--report")] = False,
    program: Annotated[Path | None, options.option("FILE", _PROGRAM, exists=True)] = None,
    changes: options.Changes = None,
    as_json: options.AsJson = False,
) -> None:
    """Export the scenario's lv_hil controller as C sources with a README and a Makefile, or measure it for its part.

    --program drives one that was built, on this machine, and says whether it does what Ridelab's own one does.
    """
    if sum((out is not None, report, program is not None)) != 1:
        raise InputError("controller takes one of --out FILE, --report and --program FILE")
    if out is not None:
        check_out(out, as_json=as_json)
    design = fields.scenario_of(scenario, changes, services)
    ridelab = services.at()
    if out is not None:
        deliver([ridelab.controller(design)], out, as_json=as_json)
        return
    if program is not None:  # a program of somebody's is run here, never by a service
        end_as_server("--drive", str(program), content=json.dumps(design).encode(), as_json=as_json)
    note("Building and driving each controller; this takes about ten seconds")
    measured = ridelab.controller_report(design)
    print_json(measured) if as_json else _show_fit(measured)


def _show_fit(measured: Mapping[str, Any]) -> None:
    part = measured["part"]
    typer.echo(f"{part['name']}; {part['flash'] // 1024} KB flash, {part['ram'] // 1024} KB RAM")
    typer.echo(f"One step every {1000 * measured['sample_time']:g} ms; times within {100 * measured['spread']:.0f} %")
    heads = ["Np", "Nc", "limits", "iterations", "flash", "RAM", "operations", "on the part", "fits", "worst change"]
    show_table(heads, list(map(_fit, measured["rows"])))
    for row in measured["rows"]:
        name = f"Np {row['prediction_horizon']}, Nc {row['control_horizon']}, {row['checked']} limits"
        for reason in row["reasons"]:
            typer.echo(f"{name}: {reason}")
    typer.echo("Worst change: of Tables 9 and 10's eight metrics against lv simulated")


def _fit(row: Mapping[str, Any]) -> list[Any]:
    operations, time = row["operations"], row["time"]
    changes = [value for window in row["changes"].values() for value in window.values() if value is not None]
    return [
        row["prediction_horizon"],
        row["control_horizon"],
        f"{row['checked']} ({row['checked_rows']})",
        row["iterations"],
        f"{(row['code'] + row['constants']) / 1024:.1f} KB",
        f"{row['variables'] / 1024:.1f} KB",
        f"{operations['least']} to {operations['most']}",
        f"{1000 * time['least']:.1f} to {1000 * time['most']:.1f} ms",
        row["fits"],
        f"{max(changes):+z.1f} %" if changes else "none",
    ]
