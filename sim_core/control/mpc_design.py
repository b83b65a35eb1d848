"""Design of the model predictive suspension control (Eq. 8-15 with the errata of docs/errata.md).

Everything that does not depend on the state is reckoned once and cached: the QP's matrices, and the law that solves it
wherever no limit binds (the unconstrained optimum that meets every limit *is* the solution).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.control.cost import KILO, CostTerms, stage_cost
from sim_core.control.lqr import regulator
from sim_core.control.qp import QpShape
from sim_core.riccati import solve
from sim_core.scenario import Vehicle
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES, discrete
from sim_core.vehicle.model import LAW_INPUTS, LinearLaw

CENTI = 100.0  # the QP reckons deflections and slacks in cm
SLACK_LINEAR, SLACK_QUADRATIC = 1e5, 1e6  # exact penalty per m and per m² on the normalised cost


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class MpcDesign:
    """One stage's QP over y = [forces (2 Nc) in kN; slack front, rear in cm].

    `affine` are, on [state; previous command in N; preview (3 Np)], one after another: `checks`, each force and
    deflection of the horizon over its bound; `linear`, the QP's linear term but for the slacks; and `travel` (2 Np),
    the deflections without a force [cm], which with either sign are taken from `travel_limit` to give the row limits.
    `law` and `feed` (2, 3 Np) give the first force in N. In single precision, `bound` (2 rows, 14) are the checks of
    either sign on [state; previous command; mean deceleration of the preview], then their norms on the rest: with
    `Forecast.spread` they bound each check (Cauchy-Schwarz).
    """

    shape: QpShape
    affine: FloatArray
    checks: FloatArray
    linear: FloatArray
    travel: FloatArray
    travel_limit: float
    law: LinearLaw
    feed: FloatArray
    bounds: FloatArray
    bound: NDArray[np.float32]


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
    travel_parameters, travel_moves = np.empty((2, horizon, parameters)), np.empty((2, horizon, free))
    for i in range(horizon):
        move = FORCES * min(i, moves - 1)
        columns = LAW_INPUTS + horizon * np.arange(DISTURBANCES) + i
        before[:, i], z_moves[:STATES, i] = x_parameters, x_moves
        z_moves[STATES : STATES + FORCES, i, move : move + FORCES] = np.eye(FORCES)
        x_parameters, x_moves = A @ x_parameters, A @ x_moves
        x_parameters[:, columns] += E
        x_moves[:, move : move + FORCES] += B
        travel_parameters[:, i], travel_moves[:, i] = x_parameters[:2], x_moves[:2]
    on_moves = CENTI * travel_moves.reshape(-1, free)
    slack = -np.kron(np.eye(2), np.ones((horizon, 1)))
    return Prediction(
        x_parameters=before.reshape(-1, parameters),
        z_moves=z_moves.reshape(-1, free),
        end_parameters=x_parameters,
        end_moves=x_moves,
        travel_parameters=travel_parameters.reshape(-1, parameters),
        travel_moves=travel_moves.reshape(-1, free),
        rows=np.block([[on_moves, slack], [-on_moves, slack]]),
    )


def _move_penalty(moves: int, weight: float) -> tuple[FloatArray, FloatArray]:
    """Penalty on force changes in kN: y'D'D y·weight (2 Nc, 2 Nc), its coupling to the previous force (2 Nc, 2)."""
    D = np.eye(FORCES * moves) - np.eye(FORCES * moves, k=-FORCES)
    first = np.eye(FORCES * moves, FORCES)
    scaled = weight * KILO**2
    return scaled * D.T @ D, -scaled * D.T @ first


@dataclass(frozen=True, slots=True, kw_only=True)
class Horizon:
    """What an MPC design depends on beside its cost."""

    prediction: int
    control: int
    force_limit: float
    force_change_weight: float


@cached
def design(terms: CostTerms, horizon: Horizon) -> MpcDesign:
    """Condense one stage's problem: interval costs, terminal cost (the stage's Riccati solution), limits.

    Raises:
        RidelabError: No stabilising terminal controller exists for these weights.
    """
    S, P = stage_cost(terms), regulator(terms).P
    p = predict(terms.vehicle, terms.sample_time, horizon.prediction, horizon.control)
    free = p.z_moves.shape[1]

    weighted = (S @ p.z_moves.reshape(len(S), -1)).reshape(-1, free)
    end = P @ p.end_moves
    change, change_previous = _move_penalty(horizon.control, horizon.force_change_weight)
    H = p.z_moves.T @ weighted + p.end_moves.T @ end + change
    H = (H + H.T) / 2
    linear = weighted[: len(p.x_parameters)].T @ p.x_parameters + end.T @ p.end_parameters
    linear[:, STATES:LAW_INPUTS] += change_previous / KILO
    linear[:, LAW_INPUTS:] += weighted[
        -DISTURBANCES * horizon.prediction :
    ].T  # the preview is the last of z as it stands
    optimum = -solve(H, linear)

    checks = np.vstack([optimum * KILO, p.travel_parameters + p.travel_moves @ optimum])
    bounds = np.repeat([horizon.force_limit, terms.deflection_limit], [free, 2 * horizon.prediction])
    checks /= bounds[:, None]
    affine = np.asfortranarray(np.vstack([checks, 2 * linear, p.travel_parameters * CENTI]))
    checks, linear, travel = np.split(affine, np.cumsum([len(checks), len(linear)]))
    return MpcDesign(
        shape=_shape(H, p.rows, horizon.force_limit),
        affine=affine,
        checks=checks,
        linear=linear,
        travel=travel,
        travel_limit=terms.deflection_limit * CENTI,
        law=LinearLaw(gain=optimum[:FORCES, :LAW_INPUTS] * KILO),
        feed=optimum[:FORCES, LAW_INPUTS:] * KILO,
        bounds=bounds,
        bound=_bound(checks),
    )


def _bound(checks: FloatArray) -> NDArray[np.float32]:
    """`MpcDesign.bound` of a design with these checks."""
    by_disturbance = checks[:, LAW_INPUTS:].reshape(len(checks), DISTURBANCES, -1)
    gain = np.hstack([checks[:, :LAW_INPUTS], by_disturbance[:, 2].sum(axis=1)[:, None]])
    norms = np.linalg.norm(by_disturbance, axis=2)
    return np.vstack([np.hstack([gain, norms]), np.hstack([-gain, norms])]).astype(np.float32)


def _shape(H: FloatArray, rows: FloatArray, force_limit: float) -> QpShape:
    """The QP's constant matrices: H on the moves, and the slacks' price beside it."""
    free, axles = len(H), 2
    full = np.zeros((free + axles, free + axles))
    full[:free, :free] = 2 * H
    full[free:, free:] = 2 * SLACK_QUADRATIC / CENTI**2 * np.eye(axles)
    force = np.full(free, force_limit / KILO)
    return QpShape(
        H=full,
        A=rows,
        low=np.concatenate([-force, np.zeros(axles)]),
        high=np.concatenate([force, np.full(axles, 1e4)]),  # 100 m: no limit, but a finite one
    )
