"""`ridelab road`: measured roads, sent to a service and made a scenario."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ridelab.cli import options
from ridelab.cli.reporting import deliver, print_json
from ridelab.cli.service import Services
from ridelab.cli.tables import show_table

_WHICH = "A measured profile as CSV, distance [m] and height [mm] in its header; or the id of one that was sent."
_OUT = "Write a scenario on that road there, for every command that takes one; - is stdout."
_HEADS = ("bump at [m]", "width [m]", "height [m]")


def road(
    services: Services,
    which: Annotated[str, typer.Argument(metavar="FILE|ID", help=_WHICH)],
    out: Annotated[str | None, options.option("FILE", _OUT, "--out", "-o")] = None,
    as_json: options.AsJson = False,
) -> None:
    """Send a measured road, or show one: what was done to the file, its length, the bumps in it.

    The scenario of --out goes by the largest bump that was found, and adds none; where none was, it keeps its own.
    """
    ridelab = services.at()
    found = ridelab.upload_road(which) if Path(which).is_file() else ridelab.road(which)
    if out is not None:
        deliver([json.dumps(_scenario(found), indent=1).encode() + b"\n"], out)
    elif as_json:
        print_json(found)
    else:
        typer.echo(f"road.profile={found['id']}, {found['length']:g} m")
        for line in found.get("warnings", ()):
            typer.echo(f"- {line}")
        if found["bumps"]:
            show_table(_HEADS, [[bump["start"], bump["width"], bump["height"]] for bump in found["bumps"]])
        else:
            typer.echo("No bump was found in it")


def _scenario(found: Mapping[str, Any]) -> dict[str, Any]:
    made: dict[str, Any] = {"profile": found["id"], "length": found["length"]}
    if found["bumps"]:
        bump = found["bumps"][0]
        start = max(1.0, bump["start"])
        made["bump"] = {"height": 0, "start": start, "width": min(bump["width"], round(found["length"] - start, 2))}
    return {"road": made}
