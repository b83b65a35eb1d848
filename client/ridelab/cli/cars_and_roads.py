"""`ridelab vehicle` and `ridelab road`.

Vehicles with their sources, vehicle files, half-cars made from data sheets; measured roads, and scenarios on them.
"""

import json
import re
from collections.abc import Iterator, Mapping
from decimal import Decimal
from pathlib import Path
from typing import Annotated, Any

import typer

from ridelab.cli import options, tables
from ridelab.cli.fields import VEHICLE, vehicle_of
from ridelab.cli.lists import vehicles
from ridelab.cli.reporting import InputError, check_out, deliver, print_json, show_cautions, show_table, with_unit
from ridelab.cli.service import Services
from ridelab.cli.targets import document
from ridelab.client import Ridelab

_WHICH = "A vehicle's name, or a file with one; without it all are listed."
_SHEET = "Make it from this whole car's data sheet, a JSON file."
_AXLES, _PARTS = ("front", "rear"), {"body": "natural frequency, body", "wheel": "natural frequency, wheel"}
_OUT = "Write it there as a vehicle file, which --set vehicle=FILE and the page read; - is stdout."
Which = Annotated[
    str | None, typer.Argument(metavar="VEHICLE", help=_WHICH, autocompletion=options.completes("vehicles"))
]


def vehicle(
    services: Services,
    which: Which = None,
    sheet: Annotated[Path | None, options.option("FILE", _SHEET, exists=True, dir_okay=False)] = None,
    out: Annotated[str | None, options.option("FILE", _OUT, "--out", "-o")] = None,
    as_json: options.AsJson = False,
) -> None:
    """List the vehicles with sources, show or export one, or make one from a data sheet.

    A data sheet has front_ and rear_ axle_load, axle_mass, frequency, damping_ratio, tyre_stiffness, and wheelbase.
    """
    if which is not None and sheet is not None:
        raise InputError("vehicle takes a VEHICLE or --sheet FILE, not both")
    if which is None and sheet is None:
        if out is not None:
            raise InputError("--out needs a VEHICLE or --sheet FILE")
        vehicles(services, as_json=as_json)
        return
    if out is not None:
        check_out(out, as_json=as_json)
    content = _of_sheet(sheet, services) if sheet is not None else _named(str(which), services)
    if out is not None:
        deliver([json.dumps(content, indent=1).encode() + b"\n"], out, as_json=as_json)
    elif as_json:
        print_json(content)
    else:
        _show(content, services.names.fields)
        facts = _facts(content, services)
        _show_characteristics(facts["characteristics"])
        show_cautions(facts)


def _named(which: str, services: Services) -> Mapping[str, Any]:
    vehicles = {} if Path(which).is_file() else services.at().vehicles()
    return vehicles.get(which) or {VEHICLE: vehicle_of(which, services)}


def _of_sheet(sheet: Path, services: Services) -> Mapping[str, Any]:
    data_sheet = document(sheet.read_bytes(), str(sheet))
    if not isinstance(data_sheet, dict):
        raise InputError(f"{sheet}: this has to be a JSON object")
    return {VEHICLE: services.at().half_car(data_sheet), "derived": ["From the data sheet"], "data_sheet": data_sheet}


def _facts(content: Mapping[str, Any], services: Services) -> Mapping[str, Any]:
    """Return an answer with characteristics and cautions: that of a known vehicle, or a run of another."""
    if "characteristics" in content:
        return content
    return services.at().run({VEHICLE: content[VEHICLE]}, ["passive"]).answer


def _show_characteristics(of: Mapping[str, Any]) -> None:
    sag, frequencies, ratios = of["static_sag"], of["natural_frequencies"], of["damping_ratios"]
    rows = [
        ["static sag [m]", sag["front"], sag["rear"]],
        *([f"{words} [Hz]", *(frequencies[f"{axle}_{part}"] for axle in _AXLES)] for part, words in _PARTS.items()),
        *([f"damping ratio, {part} [1]", *(ratios[f"{axle}_{part}"] for axle in _AXLES)] for part in _PARTS),
    ]
    typer.echo()
    show_table(["characteristics", *_AXLES], [[name, *(f"{value:.3g}" for value in values)] for name, *values in rows])


def _show(content: Mapping[str, Any], units: Mapping[str, str]) -> None:
    fields = content[VEHICLE].items()
    show_table(
        ["field", "value"], [[with_unit(name, units.get(f"{VEHICLE}.{name}", "")), value] for name, value in fields]
    )
    for title in ("sources", "derived"):
        for line in content.get(title, ()):
            typer.echo(f"{title[:-1] if title == 'sources' else title}: {line}")


_ROAD = "A measured profile: a table of distance and height, ERD, a spreadsheet, OpenCRG; or the id of one sent."
_WHEEL = "Of OpenCRG: where the {} wheel runs beside the reference line, v [m]; {} if nothing is said."
_SAVE = "Write the road itself there, every height: as CSV, or OpenCRG where the name ends in .crg."
_SCENARIO_OUT = "Write a scenario on that road there, for every command that takes one; - is stdout."
_ID = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{21}")
_NARROWEST, _WIDEST = 0.1, 100.0  # bump of a scenario [m]
_HEADS = ("bump at [m]", "width [m]", "height [m]")


def road(
    services: Services,
    which: Annotated[str, typer.Argument(metavar="FILE|ID", help=_ROAD)],
    out: Annotated[str | None, options.option("FILE", _SCENARIO_OUT, "--out", "-o")] = None,
    save: Annotated[str | None, options.option("FILE", _SAVE, "--save")] = None,
    left: Annotated[float | None, options.option("M", _WHEEL.format("left", "0.75"), "--left")] = None,
    right: Annotated[float | None, options.option("M", _WHEEL.format("right", "-0.75"), "--right")] = None,
    table: tables.Table = None,
    as_json: options.AsJson = False,
) -> None:
    """Send a measured road, or show one: what was done to the file, its length, the bumps in it.

    In the scenario of --out the car brakes for the largest bump that was found, and none is added. Where none was
    found, there is none to brake for: its place is beyond the road's end.
    """
    ridelab = services.at()
    profile = _measured_road(which, ridelab, left, right, table)
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
        show_cautions(profile)
        if profile["bumps"]:
            show_table(_HEADS, [[bump["start"], bump["width"], bump["height"]] for bump in profile["bumps"]])
        else:
            typer.echo("No bump was found in it: with road.bump.height=0 none is added")


def _measured_road(
    which: str, ridelab: Ridelab, left: float | None, right: float | None, table: str | None
) -> dict[str, Any]:
    if Path(which).is_file():
        return tables.sent(lambda said: ridelab.upload_road(which, left=left, right=right, table=said), table, which)
    if (left, right, table) != (None, None, None):
        raise InputError("--left, --right and --table are about a file that is sent")
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
    place: dict[str, float] = {"start": length}
    for bump in profile["bumps"][:1]:
        start = round(min(max(1.0, bump["start"]), length - _NARROWEST), 2)
        place = {"start": start, "width": min(bump["width"], round(length - start, 2), _WIDEST)}
    return {"road": {"profile": profile["id"], "length": length, "bump": {"height": 0, **place}}}
