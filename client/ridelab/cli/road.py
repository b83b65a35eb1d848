"""`ridelab road`: send measured roads to a service and write scenarios on them."""

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ridelab.cli import options
from ridelab.cli.reporting import InputError, deliver, print_json
from ridelab.cli.service import Services
from ridelab.cli.tables import show_table
from ridelab.client import Ridelab

_WHICH = "A measured profile as CSV, distance [m] and height [mm] in its header; or the id of one that was sent."
_OUT = "Write a scenario on that road there, for every command that takes one; - is stdout."
_ID = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{21}")
_NARROWEST, _WIDEST = 0.1, 100.0  # bump of a scenario [m]
_HEADS = ("bump at [m]", "width [m]", "height [m]")


def road(
    services: Services,
    which: Annotated[str, typer.Argument(metavar="FILE|ID", help=_WHICH)],
    out: Annotated[str | None, options.option("FILE", _OUT, "--out", "-o")] = None,
    as_json: options.AsJson = False,
) -> None:
    """Send a measured road, or show one: what was done to the file, its length, the bumps in it.

    In the scenario of --out the car brakes for the largest bump that was found, and none is added. Where none was
    found, it brakes for a place 100 m on, or at the end of a shorter road.
    """
    ridelab = services.at()
    profile = _measured_road(which, ridelab)
    if out is not None:
        deliver([json.dumps(_scenario(profile), indent=1).encode() + b"\n"], out)
    elif as_json:
        print_json(profile)
    else:
        typer.echo(f"road.profile={profile['id']}, {profile['length']:g} m")
        for line in profile.get("warnings", ()):
            typer.echo(f"- {line}")
        if profile["bumps"]:
            show_table(_HEADS, [[bump["start"], bump["width"], bump["height"]] for bump in profile["bumps"]])
        else:
            typer.echo("No bump was found in it")


def _measured_road(which: str, ridelab: Ridelab) -> dict[str, Any]:
    if Path(which).is_file():
        return ridelab.upload_road(which)
    if not _ID.fullmatch(which):
        raise InputError(f"{which}: neither a file nor a measured road's id")
    return ridelab.road(which)


def _scenario(profile: Mapping[str, Any]) -> dict[str, Any]:
    length = profile["length"]
    bump = next(iter(profile["bumps"]), {"start": min(100.0, length - 4.0), "width": 4.0})
    start = round(min(max(1.0, bump["start"]), length - _NARROWEST), 2)
    width = min(bump["width"], round(length - start, 2), _WIDEST)
    return {"road": {"profile": profile["id"], "length": length, "bump": {"height": 0, "start": start, "width": width}}}
