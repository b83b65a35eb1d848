"""What a controller is told: of the run at its start, and of each control step."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.control.cost import CostTerms
from sim_core.errors import RefusedError
from sim_core.kernel.prepared import DrivenCar
from sim_core.scenario import Vehicle, Weights
from sim_core.speed.stages import Segment
from sim_core.vehicle.half_car import STATES


@dataclass(frozen=True, slots=True, kw_only=True)
class Setup:
    """What a controller is told before a run.

    Attributes:
        vehicle: The car as controllers believe it to be; the real one may differ (`mismatch`).
        sample_time: Length of a control step [s].
        steps: Control steps of the run.
        short_steps: Of a delayed controller: into how many short steps of the car a control step is divided, so that
            a command may arrive within it; 1 of any other.
        initial_speed: Speed before the car brakes [m/s].
        force_limit: Greatest magnitude of each force [N].
        deflection_limit: Magnitude that each suspension deflection should not exceed [m].
        preview_steps: Control steps for which the road ahead is reported.
        stages: Names of the driving stages.
        rear_axle_offset: How far behind the front axle the rear one meets the road [m], 0 where both meet it together;
            None is the wheelbase.

    Example:
        >>> from sim_core import Controller, Scenario, simulate
        >>> class Shy(Controller):
        ...     def start(self, setup):
        ...         self.most = setup.force_limit / 2
        ...     def force(self, seen):
        ...         return (-3000 * seen.state[:2]).clip(-self.most, self.most)
        >>> simulate(Scenario(), Shy).metrics["whole"]["front_force"]["peak"] <= Scenario().mpc.force_limit / 2
        True
    """

    vehicle: Vehicle
    sample_time: float
    steps: int
    short_steps: int
    initial_speed: float
    force_limit: float
    deflection_limit: float
    preview_steps: int
    stages: tuple[str, ...]
    rear_axle_offset: float | None = None

    @property
    def short_step(self) -> float:
        """Length of a short step [s]."""
        return self.sample_time / self.short_steps

    def cost(self, weights: Weights, deflection_weight: float, force_weight: float) -> CostTerms:
        """Return the normalised cost that LQR and MPC minimise, of this run's car and limits.

        docs/explanation/cost-and-lqr.md has the formulas.

        Args:
            weights: Of body acceleration, pitch acceleration and tyre load: q1, q2, q3 [1].
            deflection_weight: q4 [1].
            force_weight: R [1/N²].
        """
        return CostTerms(
            vehicle=self.vehicle,
            speed=self.initial_speed,
            sample_time=self.sample_time,
            weights=weights,
            deflection_weight=deflection_weight,
            deflection_limit=self.deflection_limit,
            force_weight=force_weight,
            rear_axle_offset=self.rear_axle_offset,
        )


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class RunInputs:
    """What `Seen` reports of a run, all of it known before the run begins.

    Attributes:
        time: Control instants (steps,) [s].
        position: Of the front axle (steps,) [m].
        speed: Of the car (steps,) [m/s].
        segments: The control steps of each driving stage.
        previews: Whether the controller asks for the road ahead, by its `preview`.
        disturbances: `Seen.disturbances` of each control step (3, steps, preview_steps).
        road_height: Of the road under both axles as the preview has it (2, steps) [m].
        noise: Function that gives the noise of the car's own sensors (steps, 4), in the units of what they measure.
        sample_time: Length of a control step [s].
    """

    time: FloatArray
    position: FloatArray
    speed: FloatArray
    segments: Sequence[Segment]
    previews: bool
    disturbances: FloatArray
    road_height: FloatArray
    noise: Callable[[], FloatArray]
    sample_time: float


@dataclass(slots=True, eq=False, repr=False)
class Seen:
    """What a controller is told in one control step, measured just before the command changes.

    Attributes:
        step: Number of the control step, from 0; the first ones are before x = 0.
        previous_force: Previous command to the actuators, front and rear, within their limits (2,) [N]; where they lag,
            the force is not there yet.

    Example:
        >>> from sim_core import Controller, Scenario, simulate
        >>> class Watcher(Controller):
        ...     preview, prediction_horizon = "lookahead", 20
        ...     def force(self, seen):
        ...         if seen.step == 0:
        ...             print(seen.stage, seen.state.shape, seen.preview.shape)
        ...         return 0.0, 0.0
        >>> result = simulate(Scenario(), Watcher)
        cruise (8,) (20, 2)
    """

    _inputs: RunInputs
    _car: DrivenCar
    step: int
    _car_step: int  # number of the car's step that begins then
    _car_state: FloatArray
    previous_force: FloatArray

    @property
    def state(self) -> FloatArray:
        """The half-car's state (8,), exact or estimated as `estimation.kind` says.

        Suspension deflections front and rear [m], tyre deflections front and rear [m], body velocity [m/s], pitch rate
        [rad/s], wheel velocities front and rear [m/s]. Up and nose-down are positive; a suspension deflection is body
        minus wheel: longer is positive.
        """
        return self._car_state[:STATES]

    @property
    def time(self) -> float:
        """Time [s], 0 when the front axle is at x = 0 and below 0 in the run-in before."""
        return float(self._inputs.time[self.step])

    @property
    def position(self) -> float:
        """Position of the front axle [m]."""
        return float(self._inputs.position[self.step])

    @property
    def speed(self) -> float:
        """Speed of the car [m/s]."""
        return float(self._inputs.speed[self.step])

    @property
    def stage(self) -> str:
        """The driving stage: cruise, brake or bump."""
        return self._stage(self.step)

    @property
    def next_stage(self) -> str:
        """The driving stage of the next control step, of the last one again at the end."""
        return self._stage(min(self.step + 1, len(self._inputs.time) - 1))

    @property
    def measurement(self) -> FloatArray:
        """What the car's own sensors measure, with the noise of `estimation`, whether its filter is used or not (4,).

        Suspension deflections front and rear [m], body acceleration [m/s^2], pitch rate [rad/s].
        """
        noise: FloatArray = self._inputs.noise()[self.step]
        return self._car.measure(self._car_step, self._car_state, self.previous_force) + noise

    @property
    def disturbances(self) -> FloatArray:
        """What is expected in each of the coming control steps, the present one first (3, preview_steps).

        Mean vertical velocity of the road under the front and the rear axle [m/s], braking deceleration [m/s^2]. It is
        what `LinearLaw.preview_gain` multiplies; `preview` has the same as heights.

        Raises:
            RidelabError: The controller does not ask for it, by `preview` and `prediction_horizon`.
        """
        expected: FloatArray = self._inputs.disturbances[:, self.step]
        if not expected.shape[1]:
            raise _not_asked_for("disturbances")
        return expected

    @property
    def preview(self) -> FloatArray:
        """Road heights under the front and the rear axle at the end of each coming control step (preview_steps, 2) [m].

        As the sensors give them; where they give nothing the road goes on level.

        Raises:
            RidelabError: The controller does not ask for it, by `preview` and `prediction_horizon`.
        """
        inputs = self._inputs
        if not (inputs.previews and inputs.disturbances.shape[2]):
            raise _not_asked_for("preview")
        rise = np.cumsum(inputs.disturbances[:2, self.step], axis=1) * inputs.sample_time
        return (inputs.road_height[:, self.step, np.newaxis] + rise).T

    def _stage(self, step: int) -> str:
        return next(stage for stage, _, last in self._inputs.segments if step < last)


def _not_asked_for(name: str) -> RefusedError:
    return RefusedError(
        f"seen.{name} is there for a controller that asks for it: set preview (to wheelbase, lookahead or obstacle, or "
        'to scenario_field("mpc.preview")) and prediction_horizon (control steps ahead) in the class'
    )
