"""One run: what the controller is told, the car it meets, the loop of both, and the recording."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import Any, get_args

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.catalogue import STAGES
from sim_core.control.controller import Controller
from sim_core.control.seen import RunInputs, Setup
from sim_core.errors import RefusedError
from sim_core.kernel.prepared import DrivenCar
from sim_core.kernel.record import Recorder
from sim_core.loop.closed_loop import ClosedLoop, DelayedLoop, Trajectory
from sim_core.loop.excitation import Excitation, StepSizes, above_chords
from sim_core.loop.preview import Forecast, preview
from sim_core.result import Span
from sim_core.scenario import Actuator, Preview, Scenario
from sim_core.speed.profile import SpeedPlan, SpeedProfile
from sim_core.speed.stages import Segment
from sim_core.vehicle.estimator import make_estimator, sensor_noise
from sim_core.vehicle.make import is_linear, make_vehicle
from sim_core.vehicle.model import Estimator, SemiActiveDampers


def run_dampers(scenario: Scenario, controller: Controller) -> SemiActiveDampers | None:
    """Return the car's dampers where the controller sets their coefficients, within the limits of forces; else None.

    Raises:
        RidelabError: The controller says that it has no actuators.
    """
    dampers = controller.dampers()
    if dampers is None:
        return None
    if not controller.actuated:
        raise RefusedError(f"{controller.label}: a controller with dampers() must have actuated = True")
    return replace(dampers, most_force=min(scenario.mpc.force_limit, scenario.actuator.saturation or inf))


def requested_preview(controller: Controller) -> tuple[Preview, int]:
    """Return what a controller for one run asks for: the kind of preview and its control steps, `none` for 0 of them.

    Raises:
        RidelabError: Its preview is none that there is, its horizon is no number of steps, or it sets one of both
            without the other.
    """
    preview: Preview = controller.preview
    steps: Any = controller.preview_steps  # a visitor's class may hold anything
    whole = isinstance(steps, int | np.integer) and not isinstance(steps, bool)
    if preview not in get_args(Preview):
        raise RefusedError(f"{controller.label}: preview is one of {', '.join(get_args(Preview))}")
    if not whole or steps < 0:
        raise RefusedError(f"{controller.label}: prediction_horizon is a whole number, 0 or more")
    if steps and not _sets(controller, "preview"):
        raise RefusedError(f"{controller.label} sets prediction_horizon and not preview, which says what it looks at")
    if preview != "none" and not steps and not _sets(controller, "prediction_horizon", "preview_steps"):
        message = "sets preview and not prediction_horizon: how many control steps ahead it looks"
        raise RefusedError(f"{controller.label} {message}")
    return (preview if steps else "none"), int(steps)


def _sets(controller: Controller, *names: str) -> bool:
    """Check whether the object, or a class of it below `Controller`, sets one of these attributes."""
    classes = type(controller).__mro__[: type(controller).__mro__.index(Controller)]
    return any(name in vars(each) for each in (controller, *classes) for name in names)


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """One run, before it is driven.

    Attributes:
        scenario: What is driven.
        controller: For that scenario.
        preview: What of the road ahead the controller is told.
        preview_steps: For how many control steps; 0 where it is told nothing.
        plan: Whether the car slows down for the bump.
        speed_profile: How fast its road is driven.
        steps: How finely it is stepped; the car in short steps.
        excitation: The road under the axles and the braking.
        stages: The driving stages.
        segments: The control steps of each.
        follows_law: Whether a controller's linear law is followed; otherwise its `force` is asked in every step.
    """

    scenario: Scenario
    controller: Controller
    preview: Preview
    preview_steps: int
    plan: SpeedPlan
    speed_profile: SpeedProfile
    steps: StepSizes
    excitation: Excitation
    stages: tuple[Span, ...]
    segments: Sequence[Segment]
    follows_law: bool = True

    @property
    def first_step(self) -> int:
        """The car's first step on record."""
        return self.excitation.grid.run_in_steps * self.steps.short

    @property
    def actuator(self) -> Actuator:
        """Between commands and forces: ideal where there is none."""
        return self.scenario.actuator if self.controller.actuated else Actuator()

    @property
    def filter_preview(self) -> Preview:
        """What of the road the controller's filter is told: what it previews itself, where the scenario says so."""
        return self.preview if self.preview != "none" and self.scenario.estimation.knows_preview else "none"

    def setup(self) -> Setup:
        """Return what the controller is told before it."""
        scenario, controller, speed_profile = self.scenario, self.controller, self.speed_profile
        return Setup(
            vehicle=scenario.vehicle,
            sample_time=self.steps.control,
            steps=speed_profile.control_steps(scenario.road.length, self.steps.control)[1],
            short_steps=self.steps.short,
            initial_speed=speed_profile.initial_speed,
            force_limit=scenario.mpc.force_limit if controller.actuated else 0.0,
            deflection_limit=scenario.mpc.deflection_limit,
            preview_steps=self.preview_steps,
            stages=tuple(STAGES),
            rear_axle_offset=scenario.rear_axle_offset,
        )

    def drive(self, recorder: Recorder | None = None) -> Trajectory:
        """Drive it.

        Args:
            recorder: What measures it meanwhile; None for nothing.

        Raises:
            RidelabError: The vehicle and weights admit no stabilising controller, or the controller does not give what
                it has to.
        """
        controller, setup = self.controller, self.setup()
        asked_for = controller.preview, controller.preview_steps
        forecast = self.forecast(self.preview, self.preview_steps)
        car, inputs, force_limits = self.car(recorder), self.inputs(forecast), self.force_limits()
        try:
            controller.start(setup)
            if (controller.preview, controller.preview_steps) != asked_for:
                raise RefusedError(f"{controller.label}: preview and prediction_horizon are set before start")
            if controller.delayed:
                return DelayedLoop(controller, car, inputs, setup, force_limits).run()
            return ClosedLoop(controller, car, inputs, forecast, force_limits, self.follows_law).run(self.segments)
        finally:
            controller.end()

    def forecast(self, mode: Preview, horizon: int) -> Forecast:
        """Return what is expected over so many control steps ahead."""
        return preview(mode, self.scenario, self.speed_profile, self.excitation, horizon)

    def estimator(self) -> Estimator | None:
        """Return what estimates the state for the controller; None where it has the state itself, or none needs it."""
        scenario, short = self.scenario, self.steps.short
        if not self.controller.actuated or scenario.estimation.kind == "exact":
            return None
        mode = self.filter_preview
        seen = None if mode == "none" else self.forecast(mode, 1).disturbances[:2, :, 0].T
        step, speed = self.excitation.grid.step / short, self.speed_profile.initial_speed
        braking = self.excitation.grid.braking.reshape(-1, self.steps.fine // short)
        return make_estimator(scenario, step, speed, braking, short, mode=mode, seen=seen)

    def car(self, recorder: Recorder | None = None) -> DrivenCar:
        """Return the car on its road, and what measures its drive."""
        scenario, excitation = self.scenario, self.excitation
        dampers = run_dampers(scenario, self.controller)
        return make_vehicle(
            scenario.real_vehicle,
            self.actuator,
            excitation.grid.fine_step,
            self.steps.fine // self.steps.short,
            excitation.height,
            excitation.grid.braking,
            above_chord=None if is_linear(scenario.real_vehicle, dampers) else above_chords(excitation),
            estimator=self.estimator(),
            dampers=dampers,
            recorder=recorder,
        )

    def inputs(self, forecast: Forecast) -> RunInputs:
        """Return what `Seen` reports, with the forecast of the controller's preview."""
        grid, short = self.excitation.grid, self.steps.short
        steps = short * len(grid.position)
        return RunInputs(
            time=grid.time[:-1],
            position=grid.position,
            speed=grid.speed,
            segments=self.segments,
            previews=self.preview != "none" or "preview" in self.controller.declared,
            disturbances=forecast.disturbances,
            road_height=forecast.height_now,
            noise=lambda: sensor_noise(self.scenario, steps, short)[::short],
            sample_time=grid.step,
        )

    def force_limits(self) -> FloatArray:
        """In the car's steps, as `limit_force` has them."""
        if not self.controller.actuated:
            return np.array([0.0, inf, inf])
        rate, saturation = self.scenario.actuator.rate_limit, self.scenario.actuator.saturation
        change = inf if rate is None else rate * (self.steps.control / self.steps.short)
        return np.array([self.scenario.mpc.force_limit, change, inf if saturation is None else saturation])
