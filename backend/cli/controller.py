"""`ridelab controller` and `ridelab hil`: LV's controller as an ECU's program."""

import json
from collections.abc import Mapping
from typing import Annotated, Any

import typer

from backend.cli import fields, options, output, targets
from backend.cli.reporting import InputError, note
from backend.cli.services import Services
from backend.cli.tables import aligned
from sim_core.catalogue import SIGNALS, WINDOWS


def controller(
    scenario: options.Scenario = "paper",
    out: Annotated[
        str | None,
        typer.Option("--out", "-o", metavar="FILE", help="Write the C sources there, as a zip; - is stdout."),
    ] = None,
    report: Annotated[bool, typer.Option("--report", help="Say whether it fits an STM32F103, and what does.")] = False,
    changes: options.Changes = None,
    as_json: Annotated[bool, typer.Option("--json", help="The whole report, as JSON.")] = False,
    server: options.Server = None,
    data_dir: options.DataDir = None,
) -> None:
    """Export the scenario's lv_hil controller as C sources with a README and a Makefile, or measure it for its part."""
    if (out is None) is not report:
        raise InputError("controller takes one of --out FILE and --report")
    with Services(server, data_dir) as services:
        chosen = fields.changed(targets.find(scenario, services).scenario, changes or [])
        ridelab = services.at()
        if out is not None:
            output.deliver(iter([ridelab.controller(chosen)]), out)
            return
        note("Building and driving each controller; this takes about ten seconds")
        found = ridelab.controller_report(chosen)
    typer.echo(json.dumps(found, indent=1) if as_json else "\n".join(_fit(found)))


def hil(
    scenario: options.Scenario = "paper",
    changes: options.Changes = None,
    as_json: Annotated[bool, typer.Option("--json", help="The whole report with its histograms, as JSON.")] = False,
    server: options.Server = None,
    data_dir: options.DataDir = None,
) -> None:
    """Drive lv_hil once by the clock: latency, jitter and missed deadlines, and what they change.

    It takes as long as the drive. The figures are this machine's at this moment, under an ordinary operating system.
    """
    with Services(server, data_dir) as services:
        chosen = fields.changed(targets.find(scenario, services).scenario, changes or [])
        ridelab = services.at()
        note("Driving by the clock; this takes as long as the drive")
        found = ridelab.realtime(chosen)
    typer.echo(json.dumps(found, indent=1) if as_json else "\n".join(_clock(found)))


def _fit(found: Mapping[str, Any]) -> list[str]:
    part = found["part"]
    head = ["Np", "Nc", "limits", "iterations", "flash", "RAM", "operations", "on the part", "fits", "worst change"]
    rows = [[_cell(row, column) for column in range(len(head))] for row in found["rows"]]
    reasons = [
        f"Np {row['prediction_horizon']}, Nc {row['control_horizon']}, {row['checked']} limits: {reason}"
        for row in found["rows"]
        for reason in row["reasons"]
    ]
    return [
        f"{part['name']}; {part['flash'] // 1024} KB flash, {part['ram'] // 1024} KB RAM",
        f"One step every {1000 * found['sample_time']:g} ms; times within {100 * found['spread']:.0f} %",
        *aligned(head, rows, {2}),
        *reasons,
        "Worst change: of Tables 9 and 10's eight figures against lv simulated",
    ]


def _cell(row: Mapping[str, Any], column: int) -> str:
    operations, time = row["operations"], row["time"]
    cells = [value for window in row["changes"].values() for value in window.values() if value is not None]
    return [
        str(row["prediction_horizon"]),
        str(row["control_horizon"]),
        f"{row['checked']} ({row['checked_rows']})",
        str(row["iterations"]),
        f"{(row['code'] + row['constants']) / 1024:.1f} KB",
        f"{row['variables'] / 1024:.1f} KB",
        f"{operations['least']} to {operations['most']}",
        f"{1000 * time['least']:.1f} to {1000 * time['most']:.1f} ms",
        "yes" if row["fits"] else "no",
        f"{max(cells):+.1f} %" if cells else "none",
    ][column]


def _clock(found: Mapping[str, Any]) -> list[str]:
    lines = [f"{found['steps']} steps of {1000 * found['deadline']:g} ms, {found['misses']} deadlines missed"]
    head = ["", "median", "99 %", "most", "deviation"]
    named = {"latency": "frame to answer", "wake_up": "plant woken late", "computing": "program's own time"}
    keys = ("median", "percentile_99", "most", "deviation")
    rows = [
        [label, *(f"{1e6 * found[key][item]:.0f} µs" for item in keys)]
        for key, label in named.items()
        if found[key] is not None
    ]
    changed = [
        f"{WINDOWS[window].label}, {SIGNALS[key].label}: {value:+.2f} %"
        for window, row in found["changes"].items()
        for key, value in row.items()
        if value is not None
    ]
    return [*lines, *aligned(head, rows, {0}), "Against the same drive in lock-step:", *changed]
