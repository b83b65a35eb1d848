"""`ridelab road`: send measured roads to a service and write scenarios on them."""

import json
import re
from collections.abc import Iterator, Mapping
from decimal import Decimal
from pathlib import Path
from typing import Annotated, Any

import typer

from ridelab.cli import options
from ridelab.cli.reporting import InputError, deliver, print_json, show_table
from ridelab.cli.service import Services
from ridelab.client import Ridelab

_WHICH = (
    "A measured profile as OpenCRG, or as CSV with distance [m] and height [mm] in its header; or the id of one sent."
)
_WHEEL = "Of OpenCRG: where the {} wheel runs beside the reference line, v [m]; {} if nothing is said."
_SAVE = "Write the road itself there, every height: as CSV, or OpenCRG where the name ends in .crg."
_OUT = "Write a scenario on that road there, for every command that takes one; - is stdout."
_ID = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{21}")
_NARROWEST, _WIDEST = 0.1, 100.0  # bump of a scenario [m]
_HEADS = ("bump at [m]", "width [m]", "height [m]")


def road(
    services: Services,
    which: Annotated[str, typer.Argument(metavar="FILE|ID", help=_WHICH)],
    out: Annotated[str | None, options.option("FILE", _OUT, "--out", "-o")] = None,
    save: Annotated[str | None, options.option("FILE", _SAVE, "--save")] = None,
    left: Annotated[float | None, options.option("M", _WHEEL.format("left", "0.75"), "--left")] = None,
    right: Annotated[float | None, options.option("M", _WHEEL.format("right", "-0.75"), "--right")] = None,
    as_json: options.AsJson = False,
) -> None:
    """Send a measured road, or show one: what was done to the file, its length, the bumps in it.

    In the scenario of --out the car brakes for the largest bump that was found, and none is added. Where none was
    found, it brakes for a place 100 m on, or at the end of a shorter road.
    """
    ridelab = services.at()
    profile = _measured_road(which, ridelab, left, right)
    if save is not None:
        deliver(ridelab.road_content(profile["id"], "crg" if save.endswith(".crg") else "csv"), save)
    if out is not None:
        deliver([json.dumps(_scenario(profile), indent=1).encode() + b"\n"], out)
    elif as_json:
        print_json(profile)
    else:
        typer.echo(f"road.profile={profile['id']}, {profile['length']:g} m")
        for line in profile.get("warnings", ()):
            typer.echo(f"- {line}")
        for line in _indices(profile):
            typer.echo(line)
        if profile["bumps"]:
            show_table(_HEADS, [[bump["start"], bump["width"], bump["height"]] for bump in profile["bumps"]])
        else:
            typer.echo("No bump was found in it")


def _measured_road(which: str, ridelab: Ridelab, left: float | None, right: float | None) -> dict[str, Any]:
    if Path(which).is_file():
        return ridelab.upload_road(which, left=left, right=right)
    if left is not None or right is not None:
        raise InputError("--left and --right place the wheels of a file that is sent")
    if not _ID.fullmatch(which):
        raise InputError(f"{which}: neither a file nor a measured road's id")
    return ridelab.road(which)


def _indices(profile: Mapping[str, Any]) -> Iterator[str]:
    """IRI and class, as far as they are known."""
    if profile["iri"] is not None:
        tracks = [f"{value:.2f}" for value in profile["iri"]["tracks"]]
        each = f" (left {tracks[0]}, right {tracks[1]})" if len(tracks) == 2 else ""
        yield f"IRI {profile['iri']['mean']:.2f} m/km{each}"
    if profile["iso_class"] is not None:
        rough, waviness = profile["roughness"], profile["waviness"]
        of = [f"{Decimal(f'{1e6 * rough[name]:.3g}'):f}" for name in ("value", "low", "high")]
        yield (
            f"ISO 8608 class {profile['iso_class']}: roughness {of[0]}e-6 m^3 (95 %: {of[1]} to {of[2]}), "
            f"waviness {waviness['value']:.2f} ({waviness['low']:.2f} to {waviness['high']:.2f})"
        )


def _scenario(profile: Mapping[str, Any]) -> dict[str, Any]:
    length = profile["length"]
    bump = next(iter(profile["bumps"]), {"start": min(100.0, length - 4.0), "width": 4.0})
    start = round(min(max(1.0, bump["start"]), length - _NARROWEST), 2)
    width = min(bump["width"], round(length - start, 2), _WIDEST)
    return {"road": {"profile": profile["id"], "length": length, "bump": {"height": 0, "start": start, "width": width}}}
