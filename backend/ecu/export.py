"""The controller of one scenario as C sources: the files, and a zip of them that is always the same to the byte."""

import io
import json
import zipfile
from collections.abc import Mapping

from backend.ecu import tables
from sim_core.ecu.calibration import Calibration
from sim_core.ecu.sources import SOURCES
from sim_core.scenario import Scenario
from sim_core.strategies.calibration import ecu_calibration

CONTROLLER = (
    "ridelab_tables.h",
    "ridelab_count.h",
    "ridelab_controller.h",
    "ridelab_controller.c",
    "ridelab_dual.h",
    "ridelab_dual.c",
)
HOST = ("host/ridelab_main.c",)
TARGET = ("target/ridelab_firmware.c", "target/stm32f103.ld")
FOLDER = "ridelab-controller"
_OLDEST = (1980, 1, 1, 0, 0, 0)  # the only time a zip can have that says nothing


def generated(calibration: Calibration) -> dict[str, str]:
    """Return the files that hold the scenario's numbers: name -> text."""
    return {
        "ridelab_calibration.h": tables.calibration_header(calibration),
        "ridelab_tables.c": tables.tables_source(calibration),
    }


def files(calibration: Calibration, scenario: str) -> dict[str, str]:
    """Return everything an exported controller consists of: name -> text.

    Args:
        calibration: Its numbers.
        scenario: JSON text of `scenario.json` beside them.
    """
    fixed = {name: (SOURCES / name).read_text() for name in (*CONTROLLER, *HOST, *TARGET, "Makefile", "README.md")}
    return {**fixed, **generated(calibration), "scenario.json": scenario}


def archive(scenario: Scenario) -> bytes:
    """Return the scenario's controller as a zip of C sources.

    Raises:
        RidelabError: There is no stabilising controller.
    """
    plain = json.dumps(scenario.model_dump(mode="json"), indent=1) + "\n"
    texts = sorted(files(ecu_calibration(scenario), plain).items())
    return zipped({f"{FOLDER}/{name}": text.encode() for name, text in texts})


def zipped(content: Mapping[str, bytes]) -> bytes:
    """Return a zip of files by name that is always the same to the byte."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=6) as archive:
        for name, data in content.items():
            entry = zipfile.ZipInfo(name, _OLDEST)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, data)
    return file.getvalue()
