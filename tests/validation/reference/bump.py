"""Bump shapes and a high-accuracy solution of the passive car crossing one on a smooth road."""

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from sim_core.scenario import Bump, Vehicle
from tests.validation.reference.vehicle import StateSpace, state_space

Array = NDArray[np.floating[Any]]


def bump_height(bump: Bump, x: Array) -> Array:
    """Height of the bumps at x [m], each by its definition, added up."""
    return sum((_one(bump, x - number * bump.spacing) for number in range(bump.count)), np.zeros(np.shape(x)))


def _one(bump: Bump, x: Array) -> Array:
    if bump.shape == "kerb":
        return bump.height * np.sin(np.interp(x, [bump.start, bump.start + bump.width], [0, np.pi / 2])) ** 2
    s = (np.asarray(x, dtype=float) - bump.start) / bump.width
    inside = (s > 0) & (s < 1)
    s = np.clip(s, 0, 1)
    match bump.shape:
        case "cosine":
            shape = (1 - np.cos(2 * np.pi * s)) / 2
        case "half_sine":
            shape = np.sin(np.pi * s)
        case "circular":
            rise, half = abs(bump.height), bump.width / 2
            radius = (rise**2 + half**2) / (2 * rise) if rise else np.inf
            offset = (s - 0.5) * bump.width
            arc = np.sqrt(np.maximum(radius**2 - offset**2, 0)) - (radius - rise) if rise else 0 * s
            shape = arc / rise if rise else arc
        case "flat_top":
            ramp = np.minimum(np.minimum(s, 1 - s) / 0.25, 1)
            shape = (1 - np.cos(np.pi * ramp)) / 2
        case "trapezoid":
            shape = np.minimum(np.minimum(s, 1 - s) / 0.25, 1)
    return bump.height * shape * inside


def kinks(bump: Bump) -> list[float]:
    """Positions where the bump's slope or curvature jumps."""
    quarters = (0, 0.25, 0.75, 1) if bump.shape in ("flat_top", "trapezoid") else (0, 1)
    starts = [bump.start + number * bump.spacing for number in range(bump.count)]
    return [start + quarter * bump.width for start in starts for quarter in quarters]


def crossing(car: Vehicle, bump: Bump, speed: float, settle: float = 1.5, step: float = 2e-4) -> tuple[Array, Array]:
    """Time [s] from the front axle's touch and OUTPUTS (n, 6) while the passive car crosses the bump at constant speed.

    Adaptive Runge-Kutta of order 8 at rtol 1e-10, restarted at each kink of either axle's road, read out every `step`.
    """
    model = state_space(car)
    wheelbase = car.cg_to_front + car.cg_to_rear
    ends = sorted(
        {(x - bump.start) / speed for x in kinks(bump)} | {(x - bump.start + wheelbase) / speed for x in kinks(bump)}
    )
    ends.append(ends[-1] + settle)

    def road(t: Array) -> Array:
        x = bump.start + speed * t
        return np.array([bump_height(bump, x), bump_height(bump, x - wheelbase)])

    def slope(t: float, x: Array) -> Array:
        return np.asarray(model.A @ x + model.E @ road(np.asarray(t)))

    times, outputs = list[Array](), list[Array]()
    state = np.zeros(8)
    for begin, end in pairwise(ends):
        if end - begin < 1e-12:
            continue
        read = np.linspace(begin, end, max(2, int(np.ceil((end - begin) / step))))
        solution = solve_ivp(slope, (begin, end), state, "DOP853", read, rtol=1e-10, atol=1e-12)
        state = solution.y[:, -1]
        times.append(read)
        outputs.append(_read_out(model, solution.y, road(read)))
    return np.concatenate(times), np.concatenate(outputs)


def _read_out(model: StateSpace, state: Array, road: Array) -> Array:
    return (model.C @ state + model.G @ road).T


def peaks(car: Vehicle, bump: Bump, speed: float) -> Array:
    """Largest magnitude of OUTPUTS from the front axle's touch until the rear axle has left the bump."""
    time, output = crossing(car, bump, speed, settle=0.0005)
    end = ((bump.count - 1) * bump.spacing + bump.width + car.cg_to_front + car.cg_to_rear) / speed
    largest: Array = np.abs(output[time <= end + 1e-9]).max(axis=0)
    return largest
