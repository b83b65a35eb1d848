"""The closed loop of a car that is not linear, its motion by SciPy's adaptive solver between any two fine instants.

Newton's second law with the forces as they are and the road at `_SUBSAMPLES` places of each fine step. Taken from the
core are the road's heights, the drive, the controller, the filter's matrices and what a recording is made into.
"""

from bisect import bisect_right
from unittest.mock import patch

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import ode

from sim_core import Scenario, StrategyResult, simulate
from sim_core.kernel.prepared import FollowLaw, LawDesign
from sim_core.kernel.qp import Qp
from sim_core.kernel.record import Recorder
from sim_core.loop.excitation import longest_fine_step
from sim_core.loop.run import Run, run_dampers

Array = NDArray[np.float64]
FINER = 4  # times as many fine steps: samples of the record, in which positions and braking are linear and constant
_SUBSAMPLES = 8  # of the road in each of these


def solved(scenario: Scenario, strategy: str) -> StrategyResult:
    """A run of any strategy without an ECU."""
    with (
        patch.object(Run, "car", lambda run, recorder: SolvedCar(run, recorder)),
        patch(
            "sim_core.loop.excitation.longest_fine_step",
            lambda *plan, **actuated: longest_fine_step(*plan, **actuated) / FINER,
        ),
    ):
        return simulate(scenario, strategy)


class SolvedCar:
    """A run's car on the road as it is."""

    def __init__(self, run: Run, recorder: Recorder | None) -> None:
        assert recorder is not None
        scenario, grid, surface = run.scenario, run.excitation.grid, run.excitation.surface
        vehicle, actuator, estimator = scenario.real_vehicle, run.actuator, run.estimator()
        fine, fine_step, dampers = run.steps.fine, grid.fine_step, run_dampers(scenario, run.controller)
        self._vehicle, self._estimator, self._recorder, self._dampers = vehicle, estimator, recorder, dampers
        self.fine, self._h = fine, fine_step
        self._braking: list[float] = run.excitation.grid.braking.tolist()
        self._corner = 2 * np.pi * (actuator.bandwidth or 0.0)
        self._states = 10 if self._corner else 8
        self.size = self._states + (8 if estimator else 0)
        share = np.arange(_SUBSAMPLES) / _SUBSAMPLES
        position = grid.axles[:, :-1, np.newaxis] + np.diff(grid.axles)[..., np.newaxis] * share
        ends = surface.height(grid.axles[:, -1:])
        heights = surface.height(position.reshape(2, -1))
        self._roads: list[list[float]] = np.hstack([heights, ends]).tolist()
        self._spring = vehicle.front_spring, vehicle.rear_spring
        self._tyre = vehicle.front_tyre_stiffness, vehicle.rear_tyre_stiffness
        ratio, damping = vehicle.rebound_ratio, (vehicle.front_damping, vehicle.rear_damping)
        self._compression = [2 / (1 + ratio) * each for each in damping]
        self._rebound = [2 * ratio / (1 + ratio) * each for each in damping]
        curves = vehicle.front_damper_curve, vehicle.rear_damper_curve
        self._curves = [curve and tuple(zip(*sorted({*curve, (0.0, 0.0)}), strict=True)) for curve in curves]
        self._down, self._up = vehicle.stop_clearances
        self._stop, self._link = vehicle.bump_stop_stiffness, vehicle.link_forces
        lifts = vehicle.tyre_lift_off
        self._lowest: list[float] = [-each if lifts else -np.inf for each in vehicle.static_loads]
        rates = ode(lambda time, x: self._rates(time, x.tolist()))
        self._solver = rates.set_integrator("dopri5", nsteps=5000, first_step=self._h, rtol=1e-7, atol=1e-9)

    def follow_law(
        self, loop: Array, disturbances: Array, source: Array, norms: Array, force_limits: Array, *, clips: bool
    ) -> FollowLaw:
        """As DrivenCar says; where a law has limits beside its forces' the controller decides each step."""

        def follow_from(law: LawDesign, qp: Qp | None, first: int, last: int) -> tuple[int, int]:
            if len(law.limits):
                return first, 0
            limited = 0
            for k in range(first, last):
                state, previous = loop[k, :8], loop[k, self.size :]
                wanted = law.gain @ np.concatenate([state, previous, disturbances[:, k, : law.horizon].ravel()])
                force, change, actuator = force_limits
                command = previous + np.clip(np.clip(wanted, -force, force) - previous, -change, change)
                command = np.clip(command, -actuator, actuator)
                limited += bool(np.abs(command - wanted).max() > 1e-6)
                loop[k + 1, self.size :] = command
                self.advance(k, loop)
            return last, limited

        return follow_from

    def advance(self, step: int, loop: Array) -> None:
        """As DrivenCar says."""
        state, command = loop[step, : self.size], loop[step + 1, self.size :]
        x, samples = [*state[-self._states :].tolist(), *command.tolist()][:10], self._recorder.samples
        self._command: list[float] = command.tolist()
        for j in range(self.fine):
            self._begin(step * self.fine + j)
            samples[j] = self._signals(0.0, x)
            end = self._solver.set_initial_value(x, 0.0).integrate(self._h).tolist()
            assert self._solver.successful()
            x = [*end[:2], end[2] - self._risen[0][-1], end[3] - self._risen[1][-1], *end[4:]]
        samples[self.fine] = self._signals(self._h, end)
        if step >= self._recorder.first:
            self._recorder.record(step)
        reached = np.array(x[: self._states])
        loop[step + 1, self.size - self._states : self.size] = reached
        if self._estimator is None:
            return
        e, measured = self._estimator, np.array([x[0], x[1], self._rates(self._h, end)[4], x[5]])
        loop[step + 1, :8] = e.state @ state[:8] + e.command @ command + e.measurement @ measured + e.input[step]

    def _begin(self, fine_step: int) -> None:
        place = fine_step * _SUBSAMPLES
        self._risen = [[z - road[place] for z in road[place : place + _SUBSAMPLES + 1]] for road in self._roads]
        self._brakes = self._braking[fine_step]

    def _signals(self, time: float, x: list[float]) -> list[float]:
        """A sample, as kernel/record.h has it."""
        rates = self._rates(time, x)
        loads = [self._load(axle, time, x[2 + axle]) for axle in (0, 1)]
        control = [self._control(axle, rates[axle], x[8 + axle]) for axle in (0, 1)]
        return [*rates[:2], *rates[4:6], *loads, *x[:2], *control]

    def _load(self, axle: int, time: float, raised: float) -> float:
        place = time / self._h * _SUBSAMPLES
        i = min(int(place), _SUBSAMPLES - 1)
        road = self._risen[axle]
        deflection: float = raised - road[i] - (place - i) * (road[i + 1] - road[i])
        return max(-self._tyre[axle] * deflection, self._lowest[axle])

    def _damping(self, axle: int, speed: float) -> float:
        curve = self._curves[axle]
        if curve is None or speed == 0:
            return float((self._rebound if speed > 0 else self._compression)[axle])
        velocities, forces = curve
        i = min(max(bisect_right(velocities, speed), 1), len(velocities) - 1)
        slope = (forces[i] - forces[i - 1]) / (velocities[i] - velocities[i - 1])
        return float(forces[i] + slope * (speed - velocities[i])) / speed

    def _range(self, axle: int) -> tuple[float, float]:
        """Coefficients of a semi-active damper: without a limit one that stops its wheel within a millisecond."""
        assert self._dampers is not None
        wheel = (self._vehicle.front_wheel_mass, self._vehicle.rear_wheel_mass)[axle]
        return self._dampers.least, min(self._dampers.most, wheel / 1e-3)

    def _control(self, axle: int, speed: float, actuated: float) -> float:
        """Force that control adds; a lagging semi-active damper's state is what it adds to the coefficient."""
        if self._dampers is None:
            return actuated
        most, passive = self._dampers.most_force, self._damping(axle, speed) * speed
        asked = min(max(-actuated * speed, -most), most) if self._corner else actuated
        soft, hard = sorted(each * speed for each in self._range(axle))
        return passive - min(max(passive - asked, soft), hard)

    def _lag(self, axle: int, speed: float, actuated: float) -> float:
        """Rate of an actuator's state."""
        aim = self._command[axle]
        if self._dampers is not None:
            least, most = self._range(axle)
            passive = self._damping(axle, speed)
            aim = min(max(-aim / (speed or np.inf), least - passive), most - passive)
        return self._corner * (aim - actuated)

    def _stopping(self, axle: int, travel: float) -> float:
        """Force of both stops."""
        return self._stop * (min(travel + self._down[axle], 0.0) + max(travel - self._up[axle], 0.0))

    def _strut(self, axle: int, travel: float, speed: float, actuated: float) -> float:
        """Force between body and wheel."""
        force = self._spring[axle] * travel + self._damping(axle, speed) * speed
        force += self._stopping(axle, travel) - self._stopping(axle, 0.0)
        return force - self._control(axle, speed, actuated) - self._link[axle] * self._brakes

    def _rates(self, time: float, x: list[float]) -> list[float]:
        """Of both travels, wheels above the road at the fine step's beginning, body, pitch, wheels' speeds, forces."""
        car = self._vehicle
        front, rear = x[4] - car.cg_to_front * x[5] - x[6], x[4] + car.cg_to_rear * x[5] - x[7]
        a, b = self._strut(0, x[0], front, x[8]), self._strut(1, x[1], rear, x[9])
        brake = car.body_mass * car.cg_height * self._brakes
        return [
            *(front, rear, x[6], x[7]),
            -(a + b) / car.body_mass,
            (brake + car.cg_to_front * a - car.cg_to_rear * b) / car.pitch_inertia,
            (self._load(0, time, x[2]) + a) / car.front_wheel_mass,
            (self._load(1, time, x[3]) + b) / car.rear_wheel_mass,
            self._lag(0, front, x[8]),
            self._lag(1, rear, x[9]),
        ]
