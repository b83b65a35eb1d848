"""Whether the loop is stable with the car and the actuators as they really are.

docs/explanation/robustness.md, "Stability", has the results.

Near rest no limit binds, no stop is met and no tyre lifts off. With dampers alike both ways the loop of car, actuators
and controller is then linear, and its modes say whether a small disturbance dies out. With unequal dampers it is linear
piece by piece: it has no modes, and how it grows is measured. An unstable loop here never grows beyond all bounds: the
actuators' limits end it in a steady oscillation, so no single figure of a run shows it reliably.
"""

from dataclasses import replace
from math import acos, ceil, exp, hypot, inf

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.control.controller import Controller
from sim_core.control.law import LinearLaw
from sim_core.frequency.responses import NEGLIGIBLE, modes
from sim_core.frequency.sampled_loop import SampledLoop, sampled_loop
from sim_core.scenario import Scenario, Vehicle
from sim_core.scenario.damper import slopes_at_rest, straight
from sim_core.simulate import on_dummy_road, prepare
from sim_core.vehicle.half_car import DISTURBANCES, STATES
from sim_core.vehicle.make import make_vehicle

_SETTLED = 8.0  # by then only the motion of a loop with unequal dampers that dies out last is left [s]
_BLOCK = 100  # control steps after which its motion is brought back to size 1
_STILL = np.zeros((2, _BLOCK + 1)), np.zeros(_BLOCK)  # road and braking
_NO_PREVIEW = np.zeros((DISTURBANCES, _BLOCK, 0)), np.zeros(0), np.zeros((1 + DISTURBANCES, _BLOCK))


def least_damping(scenario: Scenario, strategy: str | type[Controller] | Controller) -> float | None:
    """Smallest damping ratio of the closed loop's modes [1], over the stages; None for a controller that is not a law.

    Of a mode exp(s·t) it is -Re(s)/|s|: 1 does not oscillate, 0 oscillates for ever, below 0 the loop is unstable.
    Each stage is taken by itself; preview is left out, because it is not fed back and cannot make a loop unstable.

    With unequal dampers it is the smaller of two ratios, that of the mean dampers' modes and that of the motion that
    dies out last; where the mean dampers' loop is unstable it is the latter alone. So it is below 0 exactly where that
    motion grows. Of the passive car, in which nothing can grow, it is always the mean dampers'.

    A semi-active damper is not judged: whatever the law, it puts no energy in, and nothing grows near rest.

    Args:
        scenario: With its mismatch: the controller is designed without it and meets the real car.
        strategy: Its id, a controller's class, or an object of it.

    Raises:
        UnknownNameError: No such strategy.
        RidelabError: The vehicle and weights admit no stabilising controller.
    """
    run = prepare(on_dummy_road(scenario), strategy)
    controller, setup = run.controller, run.setup()
    if controller.delayed or controller.dampers() is not None:
        return None
    controller.start(setup)
    of_stages = [controller.linear_law(stage) for stage in setup.stages]
    controller.end()
    if None in of_stages:
        return None
    laws = dict.fromkeys(law for law in of_stages if law is not None)
    vehicle = _near_rest(scenario.real_vehicle)
    loops = [sampled_loop(run, law, vehicle, setup.initial_speed) for law in laws]
    of_modes = [damping(loop.closed, loop.step) for loop in loops]
    if vehicle.linear or not controller.actuated:  # dampers alone only take energy out
        return min(of_modes)
    last = map(_last_motion, loops)
    return min(slowest if mean < 0 else min(mean, slowest) for mean, slowest in zip(of_modes, last, strict=True))


def damping(closed: FloatArray, step: float) -> float:
    """Smallest damping ratio [1] of z' = closed·z over a step [s]; of modes that are gone after a step, 1."""
    return min((mode.damping_ratio for mode in modes(closed, step)), default=1.0)


def _near_rest(vehicle: Vehicle) -> Vehicle:
    """Return the car around rest: no further stop is met, no tyre lifts off, dampers are straight either way."""
    front, rear = vehicle.damping_at_rest
    changes: dict[str, object] = {"bump_stop_clearance": None, "tyre_lift_off": False}
    for axle, clearances in zip(("front", "rear"), zip(*vehicle.stop_clearances, strict=True), strict=True):
        if min(clearances) < 0:  # it rests on a stop
            changes[f"{axle}_spring"] = getattr(vehicle, f"{axle}_spring") + vehicle.bump_stop_stiffness
    if vehicle.damper_curves is not None:
        curves = [straight(*slopes_at_rest(points)) for points in vehicle.damper_curves]
        changes |= {"front_damper_curve": curves[0], "rear_damper_curve": curves[1]}
        changes |= {"front_damping": front, "rear_damping": rear}
    return vehicle.model_copy(update=changes)


def _last_motion(loop: SampledLoop) -> float:
    """Damping ratio [1] of the motion that dies out last, or grows most, of a loop with unequal dampers near rest.

    Such a loop is homogeneous: twice the disturbance, twice the motion. From a start in which all states take part it
    is driven for `_SETTLED` s, and for as long again its motion gives a mean rate of growth r and a mean frequency w:
    the ratio is -r / |r + jw|. Both are those of the motion x in the modes of the `loop` with the mean dampers; with
    g = e^(r step) a mode changes by |x' - x|² = (1 + g² - 2 g cos(w step)) |x|² in a step.
    """
    step, estimator = loop.step, loop.estimator
    if estimator is not None:
        estimator = replace(estimator, input=np.zeros((_BLOCK, STATES)))
    car = make_vehicle(loop.vehicle, loop.run.actuator, step, 1, *_STILL, estimator=estimator)
    motion = np.ones((_BLOCK + 1, len(loop.closed)))
    law = LinearLaw(gain=loop.law.gain).design
    follow = car.follow_law(motion, *_NO_PREVIEW, np.full(3, inf), clips=True)
    eigenvalues, vectors = np.linalg.eig(loop.closed)
    to_modes = np.linalg.pinv(vectors)[np.abs(eigenvalues) > NEGLIGIBLE].T
    blocks = ceil(_SETTLED / (step * _BLOCK))
    grown = 0.0
    logarithms, changes = [], []
    for block in range(2 * blocks):
        follow(law, None, 0, _BLOCK)
        x = motion @ to_modes
        size = np.linalg.norm(x, axis=1)
        if block >= blocks:
            logarithms.append(grown + np.log(size[:-1]))
            changes.append((np.linalg.norm(x[1:] - x[:-1], axis=1) / size[:-1]) ** 2)
        grown += float(np.log(size[-1]))
        motion[0] = motion[-1] / size[-1]
    history = np.concatenate(logarithms)
    rate = float(np.polyfit(step * np.arange(len(history)), history, 1)[0])
    growth = exp(rate * step)
    cosine = (1 + growth**2 - float(np.mean(changes))) / (2 * growth)
    return -rate / hypot(rate, acos(min(max(cosine, -1.0), 1.0)) / step)
