"""`ridelab fmu`: a controller or a vehicle as an FMU."""

import io
import zipfile
from typing import Annotated

from ridelab.cli import fields, options
from ridelab.cli.reporting import DIFFERENT, InputError, check_out, deliver, failed, note
from ridelab.cli.service import Services

_OUT = "Write it there; - is stdout."
_STRATEGY = "Strategy whose controller it is."
_PLATFORM = "With the program for linux64, win64 or darwin64 alone, with commas or repeated; all three by default."
_FMI = "Version of the Functional Mock-up Interface."
_PLATFORMS = ("linux64", "win64", "darwin64")


def fmu(
    services: Services,
    scenario: options.Scenario = "paper",
    out: Annotated[str, options.option("FILE", _OUT, "--out", "-o")] = "ridelab.fmu",
    strategy: Annotated[str, options.option("ID", _STRATEGY, "--strategy", "-s", completes="strategies")] = "lv",
    vehicle: Annotated[bool, options.flag("The scenario's vehicle in place of a controller.", "--vehicle")] = False,
    fmi: Annotated[str, options.option("2.0|3.0", _FMI)] = "2.0",
    platform: Annotated[list[str] | None, options.option("NAME", _PLATFORM, "--platform")] = None,
    changes: options.Changes = None,
    as_json: options.AsJson = False,
) -> None:
    """Export a controller, or the vehicle, as an FMU for co-simulation, with its C and programs.

    The exit code is 1 where there is a program for no platform.
    """
    if fmi not in ("2.0", "3.0"):
        raise InputError("--fmi is 2.0 or 3.0")
    check_out(out, as_json=as_json)
    strategy = options.one_strategy(strategy)
    wanted = options.listed(platform, "--platform") or _PLATFORMS
    design = fields.scenario_of(scenario, changes, services)
    content = services.at().fmu(
        design, strategy, of="vehicle" if vehicle else "controller", version=fmi, platforms=wanted
    )
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        inside = [name.split("/")[1] for name in archive.namelist() if name.startswith("binaries/")]
    deliver([content], out, as_json=as_json, platforms=inside)
    if not inside:
        reason = "no tool loads it before its sources are compiled; documentation/index.html inside says why"
        raise failed(DIFFERENT, [f"It has a binary for no platform: {reason}"])
    missing = "" if len(inside) == len(wanted) else "; documentation/index.html inside says why others are missing"
    note(f"Binaries for {', '.join(inside)}{missing}")
