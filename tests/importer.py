"""An FMU as FMPy runs it, of either version."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave


class Importer:
    """A co-simulation FMU."""

    def __init__(self, file: Path, folder: Path) -> None:
        self.description = read_model_description(str(file))
        self._variables = {each.name: each for each in self.description.modelVariables}
        self._newer = self.description.fmiVersion.startswith("3")
        self._fmu = (FMU3Slave if self._newer else FMU2Slave)(
            guid=self.description.guid,
            unzipDirectory=extract(str(file), unzipdir=str(folder)),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName="fmu",
        )

    @contextmanager
    def run(self, **first: float) -> Iterator[None]:
        """From instantiation to its end; `first` are parameters and inputs before the first step."""
        fmu = self._fmu
        fmu.instantiate()
        self._set(first)
        if not self._newer:
            fmu.setupExperiment(startTime=0.0)
        fmu.enterInitializationMode()
        fmu.exitInitializationMode()
        yield
        fmu.terminate()
        fmu.freeInstance()

    def step(self, time: float, step: float, inputs: Mapping[str, float]) -> None:
        self._set(inputs)
        self._fmu.doStep(time, step)

    def get(self, names: Sequence[str]) -> list[float]:
        get = self._fmu.getFloat64 if self._newer else self._fmu.getReal
        numbers: list[float] = get([self._variables[name].valueReference for name in names])
        return numbers

    def _set(self, numbers: Mapping[str, float]) -> None:
        real, whole = ({}, {})  # type: tuple[dict[int, float], dict[int, int]]
        for name, number in numbers.items():
            variable = self._variables[name]
            if variable.type in ("Integer", "Int32"):
                whole[variable.valueReference] = int(number)
            else:
                real[variable.valueReference] = number
        set_real = self._fmu.setFloat64 if self._newer else self._fmu.setReal
        set_whole = self._fmu.setInt32 if self._newer else self._fmu.setInteger
        set_real(list(real), list(real.values()))
        if whole:
            set_whole(list(whole), list(whole.values()))
