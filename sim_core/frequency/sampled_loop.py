"""The linear closed loop of one stage: what is held and sampled, as a run drives it while no limit binds."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.control.controller import Controller
from sim_core.control.law import LAW_INPUTS, LinearLaw
from sim_core.ecu.controller import EcuController
from sim_core.errors import RidelabError
from sim_core.loop.run import Run
from sim_core.road.sensed import expected_errors, wiener_filter
from sim_core.scenario import Preview, Vehicle
from sim_core.speed.profile import POSITION_TOLERANCE
from sim_core.strategies import STRATEGIES
from sim_core.vehicle.estimator import make_estimator
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES, discrete, measurement
from sim_core.vehicle.model import Estimator
from sim_core.vehicle.plant import discretised_plant

ComplexArray = NDArray[np.complex128]


class NotLinearError(RidelabError):
    """The law or the car is not linear, or its loop is unstable: it has no responses; the message says why."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class SampledLoop:
    """One control step of z = [what the controller and its filter remember; the car]; u the controller's command.

    z' = A z + C u + B v + road and u = K z + preview. `v` is the command that reaches the actuators, which is u where
    the loop is closed.

    Attributes:
        A: Without commands (n, n).
        C: Of the command on what the controller remembers (n, 2).
        B: Of the command on the car and its sensors (n, 2).
        K: The law (2, n).
        within: As A, of the filter and the car between two measurements.
        short: Measurements of the filter in a control step.
        speed: Of the car [m/s].
        run: What is driven.
        vehicle: The car that is, linear.
        law: Its gains on state and previous command, then on the previewed disturbances.
        estimator: The filter; None without one.
        filtered: What that makes of previewed road velocities (8, 2) and of the car's state (8, n); None without one.
    """

    A: FloatArray
    B: FloatArray
    C: FloatArray
    K: FloatArray
    within: FloatArray
    short: int
    speed: float
    run: Run
    vehicle: Vehicle
    law: LinearLaw
    estimator: Estimator | None
    filtered: tuple[FloatArray, FloatArray] | None

    @property
    def step(self) -> float:
        """Control step [s]."""
        return self.run.steps.control

    @property
    def closed(self) -> FloatArray:
        """The loop's matrix over a control step (n, n)."""
        return self.A + (self.B + self.C) @ self.K


def predicts(controller: Controller) -> bool:
    """Check whether the state is predicted for the moment at which a command takes effect."""
    return isinstance(controller, EcuController) and controller.hil.compensation == "predict"


def stage_law(run: Run, stage: str) -> LinearLaw:
    """Return the law of a stage while no limit binds, an ECU's too.

    Raises:
        NotLinearError: It has none.
    """
    controller, setup = run.controller, run.setup()
    if STRATEGIES.get(controller.id) is type(controller):
        setup = replace(setup, stages=(stage,))  # ours design a stage by itself, and the others are not asked for
    if controller.dampers() is not None:
        raise NotLinearError("A semi-active damper is not linear: its force is a product of coefficient and velocity")
    if isinstance(controller, EcuController):
        if controller.hil.jitter or controller.hil.packet_loss:
            raise NotLinearError("With jitter or lost packets the delay changes from command to command")
        return controller.designs(setup)[stage].law
    if controller.delayed:
        raise NotLinearError("The controller decides itself when its commands take effect: it has no linear law")
    controller.start(setup)
    try:
        law = controller.linear_law(stage)
    finally:
        controller.end()
    if law is None:
        raise NotLinearError(
            f"The controller gives no linear law in stage {stage}: its method linear_law has to return one"
        )
    return law


def sampled_loop(run: Run, law: LinearLaw, vehicle: Vehicle, speed: float) -> SampledLoop:
    """Return the loop of a prepared run with one stage's law and a linear car that is driven at one speed [m/s].

    Raises:
        RidelabError: There is no stable filter.
    """
    scenario, controller = run.scenario, run.controller
    filters = controller.actuated and scenario.estimation.kind == "kalman"
    short = run.steps.short if filters else 1
    step = run.steps.control
    car = discretised_plant(vehicle, run.actuator, step / short)
    A, B, C = car.A, car.B, np.zeros_like(car.B)
    estimator = filtered = None
    if filters:
        still, initial_speed = np.zeros((1, 1)), run.speed_profile.initial_speed
        estimator = make_estimator(scenario, step / short, initial_speed, still, short, mode=run.filter_preview)
        sensors, L = measurement(vehicle), estimator.measurement
        on_state = np.hstack([sensors.C, sensors.D]) if len(A) > STATES else sensors.C
        on_force = np.zeros_like(sensors.D) if len(A) > STATES else sensors.D
        nothing = np.zeros((len(A), STATES))
        C = np.vstack([estimator.command, np.zeros_like(B)])
        B = np.vstack([L @ (on_state @ B + on_force), B])
        A = np.block([[estimator.state, L @ on_state @ A], [nothing, A]])
        rest = np.eye(STATES) - L @ measurement(scenario.vehicle).C
        filtered = rest @ discrete(scenario.vehicle, step / short).E[:, :2], L @ on_state
    A_step, B_step, C_step = np.eye(len(A)), np.zeros_like(B), np.zeros_like(C)
    for _ in range(short):
        A_step, B_step, C_step = A @ A_step, A @ B_step + B, A @ C_step + C
    n = len(A_step)
    waiting = FORCES if controller.delayed else 0  # a delayed command takes effect a step later
    size = n + waiting + FORCES  # the controller's previous command is the last
    gain = np.zeros((FORCES, size))
    gain[:, :STATES], gain[:, -FORCES:] = law.gain[:, :STATES], law.gain[:, STATES:LAW_INPUTS]
    if predicts(controller):
        believed = discrete(scenario.vehicle, step)
        gain[:, :STATES] = law.gain[:, :STATES] @ believed.A
        gain[:, -FORCES:] += law.gain[:, :STATES] @ believed.B
    whole, inputs, memory = np.zeros((size, size)), np.zeros((size, FORCES)), np.zeros((size, FORCES))
    whole[:n, :n], memory[-FORCES:] = A_step, np.eye(FORCES)
    if controller.delayed:
        whole[:n, n : n + FORCES], whole[:n, -FORCES:] = B_step, C_step
        inputs[n : n + FORCES] = np.eye(FORCES)
    else:
        inputs[:n], memory[:n] = B_step, C_step
    return SampledLoop(
        A=whole,
        within=A,
        B=inputs,
        C=memory,
        K=gain,
        short=short,
        speed=speed,
        run=run,
        vehicle=vehicle,
        law=law,
        estimator=estimator,
        filtered=filtered,
    )


def previewed(loop: SampledLoop, mode: Preview, omega: FloatArray, steps: int) -> ComplexArray:
    """Mean road velocities of the coming control intervals, per metre of road height (frequencies, 2, steps) [1/s].

    Interval i begins i steps ahead: a factor exp(jω·i·step). `obstacle` reports the bump alone, so of the road nothing.
    """
    scenario, h, v = loop.run.scenario, loop.step, loop.speed
    s, interval_index = 1j * omega[:, None], np.arange(steps)
    ends = (interval_index + 1) * h * v  # how far ahead of each axle an interval ends [m]
    behind = np.exp(-s * scenario.rear_axle_offset / v)
    interval = np.exp(s * h * interval_index) * (np.exp(s * h) - 1) / h
    seen = np.zeros((len(omega), 2, steps), dtype=np.complex128)
    if mode == "wheelbase":
        seen[:, 1] = behind * interval * (ends <= scenario.rear_axle_offset)
    if mode == "lookahead":
        mismatch, n = scenario.mismatch, omega / (2 * np.pi * v)
        factor = mismatch.preview_gain * np.sinc(n * mismatch.preview_resolution)
        factor = factor * wiener_filter(n, scenario.road.roughness, expected_errors(scenario.mpc))
        sensed = factor[:, None] * np.exp(-s * (mismatch.preview_delay + mismatch.preview_offset / v))
        until = scenario.speed.detection_distance + POSITION_TOLERANCE
        seen[:, 0] = sensed * interval * (ends <= until)
        seen[:, 1] = sensed * behind * interval * (ends <= until + scenario.rear_axle_offset)
    return seen


def preview_command(loop: SampledLoop, omega: FloatArray) -> ComplexArray:
    """What the law adds to the command for the previewed road, per metre of road height (frequencies, 2) [N/m]."""
    if loop.law.preview_gain is None:
        return np.zeros((len(omega), FORCES), dtype=np.complex128)
    controller = loop.run.controller
    ahead = int(predicts(controller))
    gain = loop.law.preview_gain.reshape(FORCES, DISTURBANCES, -1)[:, :2]
    seen = previewed(loop, loop.run.preview, omega, gain.shape[2] + ahead)
    command = np.einsum("uwi,fwi->fu", gain, seen[:, :, ahead:])
    if ahead:
        first = loop.law.gain[:, :STATES] @ discrete(loop.run.scenario.vehicle, loop.step).E[:, :2]
        command += seen[:, :, 0] @ first.T
    return np.asarray(command)
