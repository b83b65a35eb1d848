"""`POST /frequency`: what is asked and answered, and the work of it in a worker."""

from collections.abc import Sequence
from math import isfinite
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, Field, model_validator

from backend.custom_controllers.registry import run_in_sandbox_process
from backend.models import Answer, StrategiesRequest, Vector
from sim_core import RidelabError, Scenario
from sim_core.frequency import responses
from sim_core.frequency.responses import DEFAULT_FREQUENCIES, RESPONSES, FrequencyResult, frequency_response

COST = 0.02  # of one strategy [s of one core]
Frequency = Annotated[float, Field(ge=0.01, le=200)]


class FrequencyRequest(StrategiesRequest):
    """Whose responses; the strategies' controllers in one driving stage."""

    frequencies: list[Frequency] | None = Field(
        None, min_length=1, max_length=2000, description="[Hz]; null is 200 from 0.3 to 30 Hz"
    )
    outputs: list[Literal[tuple(RESPONSES)]] | None = Field(  # type: ignore[valid-type]  # from the core
        None, min_length=1, max_length=6, description="Null is all six"
    )
    stage: Literal["cruise", "brake", "bump"] = Field(
        "cruise", description="Whose weights hold; in bump a car that brakes for it has the target speed"
    )


class Mode(Answer):
    """A mode exp(s·t), one of a conjugate pair."""

    natural_frequency: float = Field(description="|s| / 2π [Hz]")
    damping_ratio: float = Field(description="-Re(s) / |s| [1]; below 0 it grows")


class Response(Answer):
    """From road height at the front axle to a signal, at each frequency."""

    magnitude: Vector = Field(description="[signal's unit / m]")
    phase: Vector = Field(description="[rad]")

    @model_validator(mode="before")
    @classmethod
    def _of_complex(cls, values: Any) -> Any:
        if not isinstance(values, np.ndarray):
            return values
        return {"magnitude": np.abs(values), "phase": np.unwrap(np.angle(values))}


class LoopMargin(Answer):
    """Margins of one axle's loop, broken where the command leaves the controller, the other one closed."""

    gain: float | None = Field(description="Unstable where its gain is multiplied by this, above 1; null: by none")
    gain_reduction: float | None = Field(description="The same below 1; null: by none")
    phase: float | None = Field(description="That it can lose or gain [rad]; null: its gain is nowhere 1")
    delay: float | None = Field(description="That it can take [s]; null: its gain is nowhere 1")


def _finite(value: float | None) -> float | None:
    return None if value is None or not isfinite(value) else value


class Margins(Answer):
    """Distances of the loop from instability."""

    front: LoopMargin
    rear: LoopMargin
    disk: float = Field(description="Disk margin α of both loops at the same time [1]")
    disk_gain: Annotated[float | None, AfterValidator(_finite)] = Field(
        description="Both gains may change by any factor between 1 / this and this"
    )
    disk_phase: float = Field(description="And, in place of that, both phases by this, either way [rad]")


class StrategyFrequency(Answer):
    """A strategy's loop in that stage; what is not there is null, and `reason` says why."""

    speed: float = Field(description="[m/s]")
    responses: dict[str, Response] | None
    modes: list[Mode] | None
    margins: Margins | None = Field(description="Null too where there are no actuators")
    psd: dict[str, Vector] | None = Field(
        description="One-sided, on the scenario's road [unit^2/Hz]; weighted_body_acceleration is by ISO 2631-1's Wk"
    )
    bands: dict[str, Vector] | None = Field(description="RMS on that road in each of the answer's bands")
    reason: str | None


class FrequencyAnswer(Answer):
    """Closed-loop responses while no limit binds: held forces, actuator lag, estimator and ECU delay are inside."""

    frequency: list[float] = Field(description="[Hz]")
    stage: str
    bands: list[list[float]] = Field(description="[lowest, highest] [Hz]")
    modes: list[Mode] = Field(description="Of the real car without control")
    strategies: dict[str, StrategyFrequency]


def frequency_answer(
    scenario: Scenario,
    strategies: Sequence[str],
    frequencies: Sequence[float] | None,
    outputs: Sequence[str] | None,
    stage: str,
) -> FrequencyAnswer:
    """The answer, computed; a strategy that the core refuses has its reason."""
    asked = DEFAULT_FREQUENCIES if frequencies is None else frequencies
    return FrequencyAnswer(
        frequency=list(asked),
        stage=stage,
        bands=[list(band) for band in responses.BANDS],
        modes=[Mode.model_validate(mode) for mode in responses.passive_modes(scenario)],
        strategies={name: _one(scenario, name, asked, outputs or RESPONSES, stage) for name in strategies},
    )


def _one(
    scenario: Scenario, strategy: str, frequencies: Sequence[float], outputs: Sequence[str], stage: str
) -> StrategyFrequency:
    try:
        result = run_in_sandbox_process(strategy, frequency_response, scenario, strategy, frequencies, outputs, stage)
    except RidelabError as error:
        result = FrequencyResult(stage=stage, speed=scenario.speed.initial, reason=str(error))
    return StrategyFrequency.model_validate(result)
