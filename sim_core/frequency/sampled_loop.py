"""The linear closed loop of one stage: what is held and sampled, as a run drives it while no limit binds."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.control.controller import Controller
from sim_core.control.law import LAW_INPUTS, LinearLaw
from sim_core.ecu.controller import EcuController
from sim_core.errors import RidelabError
from sim_core.loop.run import Run, filter_preview
from sim_core.road.sensed import expected_errors, trust
from sim_core.scenario import Actuator, Preview, Scenario
from sim_core.vehicle.estimator import make_estimator
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES, discrete, half_car, measurement
from sim_core.vehicle.plant import plant

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
        step: Control step [s].
        short: Measurements of the filter in a control step.
        speed: Of the car [m/s].
        scenario: What is driven.
        law: Its gains on state and previous command, then on the previewed disturbances.
        preview: What is previewed.
        filter_preview: What of it the filter gets.
        delayed: Whether a command takes effect one control step later.
        predicts: Whether the state is predicted for that moment.
        actuator: Between command and force.
        filtered: What the filter makes of previewed road velocities (8, 2) and of the car's state (8, n); None without
            one.
    """

    A: FloatArray
    B: FloatArray
    C: FloatArray
    K: FloatArray
    within: FloatArray
    step: float
    short: int
    speed: float
    scenario: Scenario
    law: LinearLaw
    preview: Preview
    filter_preview: Preview
    delayed: bool
    predicts: bool
    actuator: Actuator
    filtered: tuple[FloatArray, FloatArray] | None

    @property
    def closed(self) -> FloatArray:
        """The loop's matrix over a control step (n, n)."""
        return self.A + (self.B + self.C) @ self.K


def stage_law(controller: Controller, run: Run, stage: str) -> LinearLaw:
    """The law of a stage while no limit binds, an ECU's too.

    Raises:
        NotLinearError: It has none.
    """
    if not run.scenario.real_vehicle.linear:
        raise NotLinearError(
            "The car is not linear: unequal dampers, damper curves, bump stops or a tyre that can lift off"
        )
    if controller.dampers() is not None:
        raise NotLinearError("A semi-active damper is not linear: its force is a product of coefficient and velocity")
    if isinstance(controller, EcuController):
        if controller.hil.jitter or controller.hil.packet_loss:
            raise NotLinearError("With jitter or lost packets the delay changes from command to command")
        return controller.designs(run.setup())[stage].law
    if controller.delayed:
        raise NotLinearError("When its commands take effect is its own: it says no law")
    controller.start(run.setup())
    try:
        law = controller.linear_law(stage)
    finally:
        controller.end()
    if law is None:
        raise NotLinearError("The controller says no linear law")
    return law


def sampled_loop(run: Run, stage: str, speed: float) -> SampledLoop:
    """The loop of a prepared run in one stage at one speed [m/s].

    Raises:
        NotLinearError: The law or the car is not linear.
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    scenario, controller = run.scenario, run.controller
    law = stage_law(controller, run, stage)
    actuator = scenario.actuator if controller.actuated else Actuator()
    short = run.steps.short if controller.delayed and scenario.estimation.kind == "kalman" else 1
    step = run.steps.control
    preview = filter_preview(scenario, controller)
    car = plant(scenario.real_vehicle, actuator, step / short)
    A, B, C = car.A, car.B, np.zeros_like(car.B)
    filtered = None
    if controller.actuated and scenario.estimation.kind == "kalman":
        still = np.zeros((1, 1))
        own = make_estimator(scenario, step / short, run.speed_profile.initial_speed, still, short, mode=preview)
        assert own is not None  # noqa: S101 - it is a kalman filter
        sensors, L = measurement(scenario.real_vehicle), own.measurement
        on_state = np.hstack([sensors.C, sensors.D]) if len(A) > STATES else sensors.C
        on_force = np.zeros_like(sensors.D) if len(A) > STATES else sensors.D
        nothing = np.zeros((len(A), STATES))
        C = np.vstack([own.command, np.zeros_like(B)])
        B = np.vstack([L @ (on_state @ B + on_force), B])
        A = np.block([[own.state, L @ on_state @ A], [nothing, A]])
        rest = np.eye(STATES) - L @ measurement(scenario.vehicle).C
        filtered = rest @ discrete(scenario.vehicle, step / short).E[:, :2], L @ on_state
    A_step, B_step, C_step = np.eye(len(A)), np.zeros_like(B), np.zeros_like(C)
    for _ in range(short):
        A_step, B_step, C_step = A @ A_step, A @ B_step + B, A @ C_step + C
    delayed = controller.delayed
    predicts = isinstance(controller, EcuController) and controller.hil.compensation == "predict"
    n = len(A_step)
    waiting = FORCES if delayed else 0  # a delayed command takes effect a step later
    size = n + waiting + FORCES  # the controller's previous command is the last
    gain = np.zeros((FORCES, size))
    gain[:, :STATES], gain[:, -FORCES:] = law.gain[:, :STATES], law.gain[:, STATES:LAW_INPUTS]
    if predicts:
        believed = discrete(scenario.vehicle, step)
        gain[:, :STATES] = law.gain[:, :STATES] @ believed.A
        gain[:, -FORCES:] += law.gain[:, :STATES] @ believed.B
    whole, inputs, memory = np.zeros((size, size)), np.zeros((size, FORCES)), np.zeros((size, FORCES))
    whole[:n, :n], memory[-FORCES:] = A_step, np.eye(FORCES)
    if delayed:
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
        step=step,
        short=short,
        speed=speed,
        scenario=scenario,
        law=law,
        preview=controller.preview if law.preview_gain is not None else "none",
        filter_preview=preview if filtered is not None else "none",
        delayed=delayed,
        predicts=predicts,
        actuator=actuator,
        filtered=filtered,
    )


def continuous(loop: SampledLoop) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray, FloatArray]:
    """The real car with its actuators in continuous time: A, B (command), E (both road velocities), C, D of outputs."""
    model, bandwidth = half_car(loop.scenario.real_vehicle), loop.actuator.bandwidth
    road = model.E[:, :2]
    if bandwidth is None:
        return model.A, model.B, road, model.C, model.D
    corner = 2 * np.pi * bandwidth
    A = np.block([[model.A, model.B], [np.zeros((FORCES, STATES)), -corner * np.eye(FORCES)]])
    B = np.vstack([np.zeros((STATES, FORCES)), corner * np.eye(FORCES)])
    E = np.vstack([road, np.zeros((FORCES, 2))])
    return A, B, E, np.hstack([model.C, model.D]), np.zeros_like(model.D)


def previewed(loop: SampledLoop, mode: Preview, omega: FloatArray, steps: int) -> ComplexArray:
    """Mean road velocities of the coming control intervals, per metre of road height (frequencies, 2, steps) [1/s].

    Interval i begins i steps ahead: a factor exp(jω·i·step). `obstacle` reports the bump alone, so of the road nothing.
    """
    scenario, h, v = loop.scenario, loop.step, loop.speed
    s, interval_index = 1j * omega[:, None], np.arange(steps)
    behind = np.exp(-s * scenario.vehicle.wheelbase / v)
    interval = np.exp(s * h * interval_index) * (np.exp(s * h) - 1) / h
    seen = np.zeros((len(omega), 2, steps), dtype=np.complex128)
    if mode == "wheelbase":
        seen[:, 1] = behind * interval * ((interval_index + 1) * h * v <= scenario.vehicle.wheelbase)
    if mode == "lookahead":
        mismatch, n = scenario.mismatch, omega / (2 * np.pi * v)
        factor = mismatch.preview_gain * np.sinc(n * mismatch.preview_resolution)
        factor = factor * trust(n, scenario.road.roughness, expected_errors(scenario.mpc))
        sensed = factor[:, None] * np.exp(-s * (mismatch.preview_delay + mismatch.preview_offset / v))
        seen[:, 0] = sensed * interval
        seen[:, 1] = sensed * behind * interval
    return seen


def preview_command(loop: SampledLoop, omega: FloatArray) -> ComplexArray:
    """What the law adds to the command for the previewed road, per metre of road height (frequencies, 2) [N/m]."""
    if loop.law.preview_gain is None:
        return np.zeros((len(omega), FORCES), dtype=np.complex128)
    gain = loop.law.preview_gain.reshape(FORCES, DISTURBANCES, -1)[:, :2]
    seen = previewed(loop, loop.preview, omega, gain.shape[2] + loop.predicts)
    if not loop.predicts:
        return np.asarray(np.einsum("uwi,fwi->fu", gain, seen))
    first = loop.law.gain[:, :STATES] @ discrete(loop.scenario.vehicle, loop.step).E[:, :2]
    return np.asarray(np.einsum("uwi,fwi->fu", gain, seen[:, :, 1:]) + seen[:, :, 0] @ first.T)
