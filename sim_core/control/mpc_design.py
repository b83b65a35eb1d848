"""Design of the model predictive suspension control (Eq. 8-15 with the errata of docs/reference/errata.md).

Everything that does not depend on the state is computed once and cached: the QP's matrices, and the law that solves it
wherever no limit binds (the unconstrained unconstrained_gain that meets every limit *is* the solution).
"""

from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.control.cost import KILO, CostTerms, stage_cost
from sim_core.control.law import LAW_INPUTS, LinearLaw
from sim_core.control.qp import AXLES, CENTI, MOST_ITERATIONS
from sim_core.control.regulator import regulator
from sim_core.errors import RefusedError
from sim_core.kernel.qp import QpDesign
from sim_core.matrices import solve
from sim_core.scenario import Vehicle
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES, discrete

SLACK_LINEAR, SLACK_QUADRATIC = 1e5, 1e6  # exact penalty per m and per m² on the normalised cost


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class MpcDesign:
    """One stage's MPC.

    Attributes:
        law: The unconstrained unconstrained_gain's first force; its limits are the QP's `unconstrained_gain`.
        qp: What decides where one of them binds.
        terms: Of the interval costs.
        force_change_weight: On the moves of the force [1/N²].
    """

    law: LinearLaw
    qp: QpDesign
    terms: CostTerms
    force_change_weight: float


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Prediction:
    """The horizon as a linear map of parameters [state (8); previous command; preview (3 Np)] and moves (2 Nc) in kN.

    Attributes:
        x_parameters: State at the start of every interval (8 · Np, …), one of its numbers after another.
        z_moves: [State; force; disturbance] of every interval (13 · Np, …), likewise.
        end_parameters: The last state (8, …).
        end_moves: The same.
        travel_parameters: Deflections at the end of every interval, front ones first (2 Np, …) [m].
        travel_moves: The same.
        rows: Of the QP, one slack per axle on |deflection| <= limit + slack: on moves and slacks (4 Np, 2 Nc + 2) [cm].
    """

    x_parameters: FloatArray
    z_moves: FloatArray
    end_parameters: FloatArray
    end_moves: FloatArray
    travel_parameters: FloatArray
    travel_moves: FloatArray
    rows: FloatArray


@cached
def predict(vehicle: Vehicle, sample_time: float, horizon: int, moves: int) -> Prediction:
    """Roll the discrete model over the horizon; after the last move the force is held."""
    model = discrete(vehicle, sample_time)
    A, B, E = model.A, model.B * KILO, model.E
    parameters, free = LAW_INPUTS + DISTURBANCES * horizon, FORCES * moves
    n = STATES + FORCES + DISTURBANCES
    before, z_moves = np.empty((STATES, horizon, parameters)), np.zeros((n, horizon, free))
    x_parameters, x_moves = np.eye(STATES, parameters), np.zeros((STATES, free))
    for i in range(horizon):
        move = FORCES * min(i, moves - 1)
        columns = LAW_INPUTS + horizon * np.arange(DISTURBANCES) + i
        before[:, i], z_moves[:STATES, i] = x_parameters, x_moves
        z_moves[STATES : STATES + FORCES, i, move : move + FORCES] = np.eye(FORCES)
        x_parameters, x_moves = A @ x_parameters, A @ x_moves
        x_parameters[:, columns] += E
        x_moves[:, move : move + FORCES] += B
    travel_parameters = np.concatenate([before[:2, 1:], x_parameters[:2, None]], axis=1).reshape(-1, parameters)
    travel_moves = np.concatenate([z_moves[:2, 1:], x_moves[:2, None]], axis=1).reshape(-1, free)
    on_moves = CENTI * travel_moves
    slack = -np.kron(np.eye(2), np.ones((horizon, 1)))
    return Prediction(
        x_parameters=before.reshape(-1, parameters),
        z_moves=z_moves.reshape(-1, free),
        end_parameters=x_parameters,
        end_moves=x_moves,
        travel_parameters=travel_parameters,
        travel_moves=travel_moves,
        rows=np.block([[on_moves, slack], [-on_moves, slack]]),
    )


def _move_penalty(moves: int, weight: float) -> tuple[FloatArray, FloatArray]:
    """Penalty on force changes in kN: y'D'D y·weight (2 Nc, 2 Nc), its coupling to the previous force (2 Nc, 2)."""
    D = np.eye(FORCES * moves) - np.eye(FORCES * moves, k=-FORCES)
    first = np.eye(FORCES * moves, FORCES)
    scaled = weight * KILO**2
    return scaled * D.T @ D, -scaled * D.T @ first


@cached
def condensed_mpc(
    terms: CostTerms, horizon: int, moves: int, force_limit: float, force_change_weight: float
) -> MpcDesign:
    """Condense one stage's problem: interval costs, terminal cost (the stage's Riccati solution), limits.

    Args:
        terms: Of the interval costs.
        horizon: Np, in steps.
        moves: Nc; after the last one the force is held.
        force_limit: Of each force [N].
        force_change_weight: On the moves of the force [1/N²].

    Raises:
        RidelabError: A horizon has no step, or no stabilising terminal controller exists for these weights.
    """
    if min(horizon, moves) < 1:
        raise RefusedError("A predictive controller has a prediction_horizon and a control_horizon of 1 or more")
    S, P = stage_cost(terms), regulator(terms).P
    p = predict(terms.vehicle, terms.sample_time, horizon, moves)
    free = p.z_moves.shape[1]

    weighted = (S @ p.z_moves.reshape(len(S), -1)).reshape(-1, free)
    end = P @ p.end_moves
    change, change_previous = _move_penalty(moves, force_change_weight)
    H = p.z_moves.T @ weighted + p.end_moves.T @ end + change
    H = (H + H.T) / 2
    linear = weighted[: len(p.x_parameters)].T @ p.x_parameters + end.T @ p.end_parameters
    linear[:, STATES:LAW_INPUTS] += change_previous / KILO
    linear[:, LAW_INPUTS:] += weighted[-DISTURBANCES * horizon :].T  # the preview is the last of z as it stands
    unconstrained_gain = -solve(H, linear)

    constraint_rows = np.vstack(
        [unconstrained_gain, CENTI * (p.travel_parameters + p.travel_moves @ unconstrained_gain)]
    )
    bounds = np.repeat([force_limit / KILO, terms.deflection_limit * CENTI], [free, AXLES * horizon])
    law = LinearLaw(
        gain=unconstrained_gain[:FORCES, :LAW_INPUTS] * KILO,
        preview_gain=np.ascontiguousarray(unconstrained_gain[:FORCES, LAW_INPUTS:] * KILO),
        limits=constraint_rows / bounds[:, None],
    )
    assert law.limits is not None  # noqa: S101 - they are given
    with_slacks, no_slack = np.diag(np.repeat(2 * SLACK_QUADRATIC / CENTI**2, free + AXLES)), np.zeros(AXLES)
    with_slacks[:free, :free] = 2 * H
    effects = np.vstack([np.eye(free), p.rows[: AXLES * horizon, :free]])
    gram = effects @ solve(2 * H, effects.T)
    return MpcDesign(
        terms=terms,
        force_change_weight=force_change_weight,
        law=law,
        qp=QpDesign(
            H=with_slacks,
            columns=np.ascontiguousarray(p.rows.T),
            low=np.concatenate([-bounds[:free], no_slack]),
            high=np.concatenate([bounds[:free], no_slack + 1e4]),  # 100 m: no limit, but a finite one
            linear_term_gain=np.vstack([2 * linear, p.travel_parameters * CENTI]),
            unconstrained_gain=law.limits,
            bounds=bounds,
            axles=np.repeat(np.array([-1, 0, 1], dtype=np.int8), [free, horizon, horizon]),
            gram=(gram + gram.T) / 2,
            slack_price=SLACK_LINEAR / CENTI,
            inverse_slack_weight=CENTI**2 / (2 * SLACK_QUADRATIC),
            iterations=MOST_ITERATIONS,
        ),
    )
