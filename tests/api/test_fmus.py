"""A controller as an FMU over HTTP: FMPy validates it and runs it, and it gives the forces of our own run."""

from collections.abc import Iterator
from contextlib import contextmanager
from copy import copy
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from fmpy.validation import validate_fmu

from sim_core import STRATEGIES, Controller, FloatArray, Scenario, Seen, Setup, simulate
from tests.api.conftest import Service

SMALL: dict[str, Any] = {
    "road": {"length": 20, "bump": {"start": 10, "width": 3, "height": 0.09}},
    "mpc": {"force_limit": 1000},
}
SAME = 1e-9  # of the greatest force: sums of the same numbers in another order


class Importer:
    """An FMU as FMPy runs it."""

    def __init__(self, file: Path, folder: Path) -> None:
        self.description = read_model_description(str(file))
        self._places = {each.name: each.valueReference for each in self.description.modelVariables}
        self._fmu = FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=extract(str(file), unzipdir=str(folder)),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="fmu",
        )

    @contextmanager
    def run(self, **parameters: float) -> Iterator[None]:
        fmu = self._fmu
        fmu.instantiate()
        fmu.setReal([self._places[name] for name in parameters], list(parameters.values()))
        fmu.setupExperiment(startTime=0.0)
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        yield
        fmu.terminate()
        fmu.freeInstance()

    def step(self, time: float, step: float, inputs: dict[str, float], outputs: list[str]) -> list[float]:
        self._fmu.setReal([self._places[name] for name in inputs], list(inputs.values()))
        self._fmu.doStep(time, step)
        numbers: list[float] = self._fmu.getReal([self._places[name] for name in outputs])
        return numbers


def exported(service: Service, folder: Path, **body: Any) -> Path:
    answer = service.client.post("/api/v1/fmus", json={"scenario": SMALL, "platforms": ["linux64"], **body})
    assert answer.status_code == 200, answer.text
    file = folder / f"{body['strategy']}.fmu"
    file.write_bytes(answer.content)
    return file


class Watched(Controller):
    """Another controller, asked in each step although it has a law; keeps what it saw and gave."""

    def __init__(self, other: Controller, seen: list[tuple[Seen, FloatArray]]) -> None:
        super().__init__()
        self._other = other
        self._seen = seen

    def for_scenario(self, scenario: Scenario) -> "Watched":
        ready = Watched(self._other.for_scenario(scenario), self._seen)
        ready.preview, ready.prediction_horizon = ready._other.preview, ready._other.preview_steps
        return ready

    def start(self, setup: Setup) -> None:
        self._most = setup.force_limit
        self._other.start(setup)

    def force(self, seen: Seen) -> FloatArray:
        force: FloatArray = np.clip(np.asarray(self._other.force(seen)), -self._most, self._most)
        self._seen.append((copy(seen), force))
        return force


def driven(strategy: str, scenario: Scenario) -> list[tuple[Seen, FloatArray]]:
    """What a strategy's controller saw in each control step, and gave within the force limit."""
    seen: list[tuple[Seen, FloatArray]] = []
    simulate(scenario, Watched(STRATEGIES[strategy](), seen))
    return seen


@pytest.mark.parametrize("strategy", ["lqr"])
def test_a_linear_law_gives_the_forces_of_our_own_run(service: Service, tmp_path: Path, strategy: str) -> None:
    file = exported(service, tmp_path, strategy=strategy)
    assert validate_fmu(str(file)) == []
    importer, steps = Importer(file, tmp_path / "fmu"), driven(strategy, Scenario.model_validate(SMALL))
    differences = []
    with importer.run():
        for k, (seen, wanted) in enumerate(steps):
            inputs = {f"state[{i}]": value for i, value in enumerate(seen.state.tolist(), 1)}
            forces = importer.step(k * 0.01, 0.01, inputs, ["force_front", "force_rear"])
            differences.append(np.abs(np.array(forces) - wanted).max())
    assert max(differences) < SAME * 1000
    assert any(np.abs(wanted).max() == 1000 for _, wanted in steps), "the limit was met"


def test_a_controller_that_is_no_law_is_refused_with_the_reason(service: Service) -> None:
    answer = service.client.post("/api/v1/fmus", json={"scenario": SMALL, "strategy": "suspension_only"})
    assert answer.status_code == 422
    assert "a QP decides where one of its limits binds" in answer.json()["detail"]
