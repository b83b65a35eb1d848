"""A controller of one's own for tests: its file, and the service that is told of it."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from sim_core.controller_files import VARIABLE
from tests.api.conftest import ROAD, Service

SCENARIO = {"road": {**ROAD, "length": 131}}  # not the run that tests share: it is new when it is asked for
LAW = '''"""Mine."""
from sim_core import Controller, option


class Mine(Controller):
    """Damps the body."""

    id, label = "mine", "Mine"
    damping: float = option(2000.0, unit="N s/m", ge=0, le=20_000, help="Force per velocity.")

    def force(self, seen):
        return -self.damping * seen.state[4], -self.damping * seen.state[4]
'''
BY_STAGE = """
import numpy as np
from sim_core import Controller, LinearLaw


class Harder(Controller):
    'Damps the body, on the bump twice as hard.'
    id, label = "harder", "Harder"

    def start(self, setup):
        gain = np.zeros((2, 10))
        gain[:, 4], gain[:, 8:] = -1000.0, np.eye(2) / 2
        self._laws = {stage: LinearLaw(gain=gain * (1 + (stage == "bump"))) for stage in setup.stages}

    def linear_law(self, stage):
        return self._laws[stage]
"""


@contextmanager
def told_of(service: Service, folder: Path) -> Iterator[Path]:
    """Files that are in this folder, or are written there, are strategies of the service."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(VARIABLE, str(folder))
        yield folder
    service.get("/api/v1/strategies")  # which forgets them


def own(service: Service) -> dict[str, Any]:
    """The service's own controllers by id."""
    return {each["id"]: each for each in service.get("/api/v1/strategies").json() if each["own"]}


def driven(service: Service, strategies: list[str], scenario: dict[str, Any] = SCENARIO) -> dict[str, Any]:
    """Their outcomes."""
    answer: dict[str, Any] = service.run(strategies, scenario).json()["strategies"]
    return answer
