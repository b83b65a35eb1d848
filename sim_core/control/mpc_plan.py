"""A predictive controller's plan: its QP's answer as motion, forces, cost by term, and the price of each limit.

A multiplier is the QP's, of its own unknowns in kN and cm (docs/explanation/mpc.md). Without a limit the same QP is
solved whose bounds on that quantity are so wide that they never bind.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.control.cost import KILO, cost_by_output
from sim_core.control.mpc_design import SLACK_LINEAR, SLACK_QUADRATIC, MpcDesign, predict
from sim_core.control.plan import Limit, Plan
from sim_core.control.qp import AXLES, CENTI, Qps
from sim_core.control.regulator import regulator
from sim_core.kernel.qp import QpDesign
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, OUTPUTS, STATES

_NEVER = 1e6  # times a bound: never met


def make_plan(
    design: MpcDesign, solvers: Sequence[str], state: FloatArray, previous_force: FloatArray, disturbances: FloatArray
) -> Plan | None:
    """Return the plan of a control step; None where no solver proves an optimum.

    Args:
        design: Of its driving stage.
        solvers: Of `qp.SOLVERS`, the first one first.
        state: (8,).
        previous_force: (2,) [N].
        disturbances: Over the horizon (3, n).
    """
    qps = Qps(design.qp)
    inputs = np.concatenate([state, previous_force, disturbances.ravel()])
    if all(qps.solve(design.qp, solver, inputs) is None for solver in solvers):
        return None
    answer, multipliers = qps.y.copy(), qps.multipliers.copy()
    moves, slacks = answer[:-AXLES], answer[-AXLES:]
    horizon = disturbances.shape[1]
    prediction = predict(design.terms.vehicle, design.terms.sample_time, horizon, design.qp.moves // FORCES)
    before = (prediction.x_parameters @ inputs).reshape(STATES, horizon)
    z = (prediction.z_moves @ moves).reshape(-1, horizon)
    z[:STATES] += before
    z[-DISTURBANCES:] = disturbances
    end = prediction.end_parameters @ inputs + prediction.end_moves @ moves
    states = np.vstack([z[:STATES].T, end])
    changes = np.diff(moves.reshape(-1, FORCES), axis=0, prepend=previous_force[np.newaxis] / KILO) * KILO
    forces = np.ascontiguousarray(z[STATES : STATES + FORCES].T) * KILO
    by_output = cost_by_output(design.terms, z.T).sum(axis=0)
    cost = dict(zip(OUTPUTS, by_output.tolist(), strict=True))
    cost["force"] = design.terms.force_weight * float((forces**2).sum())
    cost["force_change"] = design.force_change_weight * float((changes**2).sum())
    cost["travel_beyond_limit"] = float((SLACK_LINEAR * slacks / CENTI + SLACK_QUADRATIC * (slacks / CENTI) ** 2).sum())
    cost["after_horizon"] = float(end @ regulator(design.terms).P @ end)
    values = np.concatenate([moves, states[1:, :AXLES].T.ravel() * CENTI])
    limits = _limits(design.qp, qps, inputs, values, multipliers)
    return Plan(states=states, forces=forces, cost=cost, limits=tuple(limits))


def _limits(qp: QpDesign, qps: Qps, inputs: FloatArray, values: FloatArray, multipliers: FloatArray) -> list[Limit]:
    """Return one entry for each axle's force over the moves, then for its deflection at the end of each interval."""
    free = qp.moves
    upper, lower = np.split(multipliers[free + AXLES :], 2)
    of_values = np.concatenate([multipliers[:free], upper - lower])
    indices = np.arange(len(values))
    groups = [(f"{where}_force", "N", KILO, indices[axle:free:FORCES]) for axle, where in enumerate(("front", "rear"))]
    for where, rows in zip(("front", "rear"), np.split(indices[free:], AXLES), strict=True):
        groups.append((f"{where}_deflection", "m", 1 / CENTI, rows))
    limits = []
    for name, unit, scale, rows in groups:
        force = qps.solve_in_c(_without(qp, tuple(rows.tolist())), inputs)
        limits.append(
            Limit(
                name=name,
                unit=unit,
                bound=float(qp.bounds[rows[0]] * scale),
                values=values[rows] * scale,
                multipliers=of_values[rows] / scale,
                force_without=None if force is None else force.copy(),
            )
        )
    return limits


@cached
def _without(qp: QpDesign, rows: tuple[int, ...]) -> QpDesign:
    """Return the same QP without the bounds of these of its values."""
    wider = np.ones(len(qp.bounds))
    wider[list(rows)] = _NEVER
    moves = np.append(wider[: qp.moves], np.ones(AXLES))
    return replace(
        qp,
        low=qp.low * moves,
        high=qp.high * moves,
        bounds=qp.bounds * wider,
        unconstrained_gain=qp.unconstrained_gain / wider[:, np.newaxis],
    )
