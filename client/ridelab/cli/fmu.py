"""`ridelab fmu`: a controller as an FMU."""

import io
import zipfile
from typing import Annotated

from ridelab.cli import fields, options
from ridelab.cli.reporting import deliver, note
from ridelab.cli.service import Services

_OUT = "Write it there; - is stdout."
_STRATEGY = "Strategy whose controller it is."
_PLATFORM = "Compile for linux64, win64 or darwin64 alone, with commas or repeated; all three by default."
_PLATFORMS = ("linux64", "win64", "darwin64")


def fmu(
    services: Services,
    scenario: options.Scenario = "paper",
    out: Annotated[str, options.option("FILE", _OUT, "--out", "-o")] = "ridelab.fmu",
    strategy: Annotated[str, options.option("ID", _STRATEGY, "--strategy", "-s", completes="strategies")] = "lv",
    platform: Annotated[list[str] | None, options.option("NAME", _PLATFORM, "--platform")] = None,
    changes: options.Changes = None,
) -> None:
    """Export a controller as an FMU for co-simulation, with its C sources and what could be compiled of them."""
    wanted = options.listed(platform, "--platform") or _PLATFORMS
    design = fields.scenario_of(scenario, changes, services)
    content = services.at().fmu(design, strategy, platforms=wanted)
    deliver([content], out)
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        inside = [name.split("/")[1] for name in archive.namelist() if name.startswith("binaries/")]
    missing = "" if len(inside) == len(wanted) else "; documentation/index.html inside says why others are missing"
    note(f"Binaries for {', '.join(inside) or 'no platform'}{missing}")
