"""The least peaks that any force history reaches on a bare bump: a linear program that knows the road to come.

The car is the linear half-car. Both forces are held over each step and change at once; what happens between the ends of
a step does not count, so that forces that may change at any time reach hardly less.
"""

from collections.abc import Sequence
from math import ceil

import numpy as np
from scipy.optimize import linprog

from sim_core import FloatArray
from sim_core.scenario import Scenario
from sim_core.simulate import prepare
from sim_core.vehicle.half_car import FORCES, STATES, LinearModel, discrete

STEPS_OVER_BUMP = 64
LEAD = 5.0  # how far before the bump forces begin [m]
FORCE_UNIT = 1e4  # of the program's variables [N]


def least_share(scenario: Scenario, peaks: Sequence[float], travel: float) -> float:
    """Return the least share of four peaks within which some force history keeps all four at once.

    Above 1 no controller reaches these peaks.

    Args:
        scenario: Its car drives its bump at its initial speed.
        peaks: Of body acceleration [m/s^2], pitch acceleration [rad/s^2], and both tyre loads [N], while an axle is
            on the bump.
        travel: That the suspension has either way, always [m]; forces have no limit.

    Raises:
        ValueError: No force history keeps within that travel.
    """
    place, outputs = _outputs(scenario)
    signals = outputs[place >= scenario.bump_start - 1e-9, : len(peaks)] / np.array(peaks)[:, None]
    travels = outputs[:, len(peaks) :] / travel
    rows = np.concatenate([each.reshape(-1, each.shape[-1]) for each in (signals, travels)])
    forces, alone = rows[:, :-1] * FORCE_UNIT, rows[:, -1]
    shared = np.arange(len(rows)) < signals.size // rows.shape[1]  # these stay below the share, travels below 1
    least = np.where(shared, -1.0, 0.0)[:, None]
    result = linprog(
        np.eye(1, rows.shape[1], k=rows.shape[1] - 1)[0],
        A_ub=np.block([[forces, least], [-forces, least]]),
        b_ub=np.concatenate([-alone, alone]) + np.tile(~shared, 2),
        bounds=(None, None),
    )
    if result.fun is None:
        raise ValueError(result.message)
    return float(result.fun)


def _outputs(scenario: Scenario) -> tuple[FloatArray, FloatArray]:
    """Return what outputs are at both ends of each step, by every force, and last by the road alone.

    Returns:
        Where the front axle is as the step begins (2n,) [m]; OUTPUTS (2n, 6, 2n + 1) by each newton and at rest.
    """
    speed, bump = scenario.speed.initial, scenario.road.bump
    length = (bump.end - bump.start) / STEPS_OVER_BUMP
    before, after = ceil(LEAD / length), ceil((scenario.bump_left - bump.start) / length - 1e-9)
    place = bump.start + length * np.arange(-before, after + 1)
    axles = np.stack([place, place - scenario.rear_axle_offset])
    height = prepare(scenario, "passive").excitation.surface.height(axles)
    model = discrete(scenario.vehicle, length / speed)
    states = _states(model, np.diff(height, axis=1) * speed / length)
    steps = before + after
    ends = np.empty((steps, 2, len(model.C), states.shape[-1]))
    for step in range(steps):
        for end in range(2):
            ends[step, end] = model.C @ states[step + end]
            ends[step, end, :, FORCES * step : FORCES * (step + 1)] += model.D
    return np.repeat(place[:-1], 2), ends.reshape(2 * steps, *ends.shape[2:])


def _states(model: LinearModel, road: FloatArray) -> FloatArray:
    """Return the state at every step by each force before it, and last by the road's velocities (2, n) [m/s]."""
    steps = road.shape[1]
    states = np.zeros((steps + 1, STATES, FORCES * steps + 1))
    for step in range(steps):
        states[step + 1] = model.A @ states[step]
        states[step + 1, :, FORCES * step : FORCES * (step + 1)] += model.B
        states[step + 1, :, -1] += model.E[:, :2] @ road[:, step]
    return states
