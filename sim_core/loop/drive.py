"""One run: what the controller is told, the car it meets, the loop of both, and the recording."""

from dataclasses import dataclass, replace
from itertools import chain
from math import ceil, inf

from sim_core.arrays import FloatArray
from sim_core.catalogue import STAGES
from sim_core.control.controller import Controller
from sim_core.control.seen import RunInputs, Setup
from sim_core.loop.closed_loop import ClosedLoop, ForceLimits
from sim_core.loop.delayed_loop import DelayedLoop
from sim_core.loop.excitation import Excitation, excite, fine_step, under_axles
from sim_core.loop.preview import Forecast, preview
from sim_core.loop.recording import Recording
from sim_core.result import Span
from sim_core.road.sensed import expected_errors
from sim_core.scenario import Actuator, Preview, Scenario
from sim_core.speed.profile import CONTROL_STEP, SpeedPlan, SpeedProfile, run_in_steps
from sim_core.speed.stages import Segment, segments
from sim_core.vehicle.estimator import make_estimator, sensor_noise
from sim_core.vehicle.half_car import DISTURBANCES
from sim_core.vehicle.make import is_linear, make_vehicle
from sim_core.vehicle.model import Estimator, SemiActiveDampers, VehicleModel

SHORT_STEP = 1e-3  # longest step in which a delayed controller's commands may arrive [s]


def control_step(scenario: Scenario, controller: Controller) -> float:
    """Length of a run's control step [s]."""
    return scenario.mpc.sample_time if controller.actuated else CONTROL_STEP


def short_steps(scenario: Scenario, controller: Controller) -> int:
    """Short steps in a control step: 1 where commands take effect at once."""
    return ceil(scenario.mpc.sample_time / SHORT_STEP - 1e-9) if controller.delayed else 1


def make_setup(scenario: Scenario, controller: Controller, profile: SpeedProfile) -> Setup:
    """What a controller is told before a run at that speed."""
    step = control_step(scenario, controller)
    duration = profile.time_at(scenario.road.length)
    return Setup(
        vehicle=scenario.vehicle,
        sample_time=step,
        steps=run_in_steps(profile.initial_speed, step) + int(duration / step + 1e-6) + 1,
        short_steps=short_steps(scenario, controller),
        initial_speed=profile.initial_speed,
        force_limit=scenario.mpc.force_limit if controller.actuated else 0.0,
        deflection_limit=scenario.mpc.deflection_limit,
        preview_steps=controller.preview_steps,
        stages=tuple(STAGES),
    )


def make_excitation(scenario: Scenario, controller: Controller, plan: SpeedPlan, profile: SpeedProfile) -> Excitation:
    """The road under the axles and the braking, in the steps that this controller needs."""
    longest = fine_step(scenario, plan, actuated=controller.actuated)
    step, multiple = control_step(scenario, controller), short_steps(scenario, controller)
    return excite(scenario.road, scenario.vehicle.wheelbase, profile, step, longest, multiple=multiple)


def told_preview(scenario: Scenario, controller: Controller) -> Preview:
    """What of the road a controller's filter is told: what the controller previews, where the scenario says so."""
    return controller.preview if scenario.estimation.knows_preview else "none"


def run_dampers(scenario: Scenario, controller: Controller) -> SemiActiveDampers | None:
    """The car's dampers where the controller sets their coefficients, within the limits of forces; else None."""
    dampers = controller.dampers()
    if dampers is None:
        return None
    return replace(dampers, most_force=min(scenario.mpc.force_limit, scenario.actuator.saturation or inf))


@dataclass(frozen=True, slots=True, kw_only=True)
class Run:
    """One run, before it is driven.

    Attributes:
        scenario: What is driven.
        controller: For that scenario.
        plan: Whether the car slows down for the bump.
        profile: The speed profile.
        excitation: The road under the axles and the braking.
        stages: The driving stages.
    """

    scenario: Scenario
    controller: Controller
    plan: SpeedPlan
    profile: SpeedProfile
    excitation: Excitation
    stages: tuple[Span, ...]

    def segments(self) -> list[Segment]:
        """The control steps of each driving stage."""
        return segments(self.stages, self.excitation.position)

    def setup(self) -> Setup:
        """What the controller is told before it."""
        return make_setup(self.scenario, self.controller, self.profile)

    def drive(self) -> Recording:
        """Drive it.

        Raises:
            RidelabError: The vehicle and weights admit no stabilising controller, or the controller's forces are none.
        """
        controller, setup = self.controller, self.setup()
        n, before = setup.short_steps, self.excitation.drive.before
        car = self.car(n)
        forecast = self.forecast(controller.preview, controller.preview_steps)
        inputs = self.inputs(forecast, n)
        try:
            controller.start(setup)
            if controller.delayed:
                trajectory = DelayedLoop(controller, car, inputs, setup, self._limits(setup.short_step)).run()
            else:
                loop = ClosedLoop(controller, car, inputs, forecast, self._limits(setup.sample_time))
                trajectory = loop.run(self.segments())
        finally:
            controller.end()
        return Recording(
            table=car.record(trajectory.states[before * n :], trajectory.commands[before * n :]),
            excitation=self.excitation,
            report=controller.report,
            limited=trajectory.limited,
            held_commands=trajectory.held_commands,
        )

    def forecast(self, mode: Preview, horizon: int) -> Forecast:
        """What is expected over so many control steps ahead."""
        scenario = self.scenario
        drive = scenario.road, self.profile, self.excitation, horizon, scenario.vehicle.wheelbase
        if mode in ("lookahead", "obstacle"):
            return preview(mode, *drive, scenario.mismatch, expected_errors(scenario.mpc))
        return preview(mode, *drive)

    def estimator(self, per_control: int = 1) -> Estimator | None:
        """What estimates the state for the controller; None where it has the state itself, or none needs it.

        Args:
            per_control: Steps of the filter in a control step.
        """
        scenario = self.scenario
        if not self.controller.actuated or scenario.estimation.kind == "exact":
            return None
        mode = told_preview(scenario, self.controller)
        seen = None if mode == "none" else self.forecast(mode, 1).windows[:2, :, 0].T
        step = self.excitation.step / per_control
        disturbance = self._disturbance(per_control)
        speed = self.profile.initial_speed
        return make_estimator(scenario, step, speed, disturbance, per_control, mode=mode, seen=seen)

    def _disturbance(self, per_control: int) -> FloatArray:
        """`Excitation.disturbance` by steps of the car (steps · per_control, 3 · fine / per_control)."""
        return self.excitation.disturbance.reshape(-1, DISTURBANCES * self.excitation.fine // per_control)

    def car(self, per_control: int = 1) -> VehicleModel:
        """The car on its road.

        Args:
            per_control: Its steps in a control step.
        """
        scenario, dampers = self.scenario, run_dampers(self.scenario, self.controller)
        vehicle = scenario.real_vehicle
        return make_vehicle(
            vehicle,
            scenario.actuator if self.controller.actuated else Actuator(),
            self.excitation.step / per_control,
            self._disturbance(per_control),
            self.excitation.drive.before * per_control,
            estimator=self.estimator(per_control),
            dampers=dampers,
            road=None if is_linear(vehicle, dampers) else under_axles(self.excitation),
        )

    def _limits(self, step: float) -> ForceLimits:
        """In steps of that length [s]."""
        actuator, actuated = self.scenario.actuator, self.controller.actuated
        rate, saturation = (actuator.rate_limit, actuator.saturation) if actuated else (None, None)
        return ForceLimits(
            control=self.scenario.mpc.force_limit if actuated else 0.0,
            change=inf if rate is None else rate * step,
            actuator=inf if saturation is None else saturation,
        )

    def inputs(self, forecast: Forecast, per_control: int = 1) -> RunInputs:
        """What `Seen` reports.

        Args:
            forecast: Of the controller's preview.
            per_control: Steps of the car in a control step.
        """
        excitation = self.excitation
        steps = len(excitation.position)
        return RunInputs(
            time=excitation.time[:-1],
            position=excitation.position,
            speed=excitation.drive.speed,
            stage=list(chain.from_iterable([stage] * (last - first) for stage, first, last in self.segments())),
            windows=forecast.windows,
            road_height=forecast.height_now,
            noise=lambda: sensor_noise(self.scenario, steps * per_control, per_control)[::per_control],
            sample_time=excitation.step,
        )
