"""`ridelab vehicle`: vehicles with their sources, vehicle files, and half-cars made from data sheets."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ridelab.cli import options
from ridelab.cli.fields import VEHICLE, vehicle_of
from ridelab.cli.lists import vehicles
from ridelab.cli.reporting import InputError, check_out, deliver, print_json, show_table, with_unit
from ridelab.cli.service import Services
from ridelab.cli.targets import document

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
        _show_characteristics(_characteristics(content, services))


def _named(which: str, services: Services) -> Mapping[str, Any]:
    vehicles = {} if Path(which).is_file() else services.at().vehicles()
    return vehicles.get(which) or {VEHICLE: vehicle_of(which, services)}


def _of_sheet(sheet: Path, services: Services) -> Mapping[str, Any]:
    data_sheet = document(sheet.read_bytes(), str(sheet))
    if not isinstance(data_sheet, dict):
        raise InputError(f"{sheet}: this has to be a JSON object")
    return {VEHICLE: services.at().half_car(data_sheet), "derived": ["From the data sheet"], "data_sheet": data_sheet}


def _characteristics(content: Mapping[str, Any], services: Services) -> Mapping[str, Any]:
    """Those of a known vehicle come with it; a run says those of another."""
    characteristics: Mapping[str, Any] | None = content.get("characteristics")
    return characteristics or services.at().run({VEHICLE: content[VEHICLE]}, ["passive"]).answer["characteristics"]


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
