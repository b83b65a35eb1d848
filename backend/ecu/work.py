"""What a worker process does about controllers; no web here."""

import json

from backend.ecu import export
from backend.ecu.realtime import drive_by_clock as drive_by_clock
from backend.ecu.report import report as report
from sim_core.ecu.drive import ecu_calibration
from sim_core.scenario import Scenario


def archive(scenario: Scenario) -> bytes:
    """The scenario's controller as a zip of C sources.

    Raises:
        RidelabError: There is no stabilising controller.
    """
    text = json.dumps(scenario.model_dump(mode="json"), indent=1) + "\n"
    return export.zipped(ecu_calibration(scenario), text)
