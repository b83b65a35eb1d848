"""The normalised cost LQR and MPC share (Eq. 16's normalisation; docs/explanation/cost-and-lqr.md).

    q1 (z̈_b/σ_a)² + q2 (θ̈/σ_θ)² + q3 [(F_t1/σ_F1)² + (F_t2/σ_F2)²] + q4 [(d_1/d_max)² + (d_2/d_max)²] + R (u_1² + u_2²)

averaged over each sampling interval, not sampled at its ends: between the ends the wheels would ring unseen.
"""

from dataclasses import dataclass
from functools import lru_cache
from math import pi

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import small_cached
from sim_core.errors import UnstableVehicleError
from sim_core.matrices import exponential, gauss_legendre, lyapunov
from sim_core.road.profile import CUTOFF_FREQUENCY, REFERENCE_FREQUENCY
from sim_core.scenario import Vehicle
from sim_core.scenario.fields import Weights
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, OUTPUTS, STATES, half_car

KILO = 1000.0  # controllers compute with forces in kN: in N the problem is badly scaled
REFERENCE_ROUGHNESS = 64e-6  # class B, whatever the road: so weights mean the same everywhere [m^3]
LEAST_RMS = 0.01  # of that in turn: axles together never pitch a car that is alike in front and behind
_NODES, _NODE_WEIGHTS = gauss_legendre(16)


@lru_cache(maxsize=256)
def passive_rms(
    vehicle: Vehicle, speed: float, rear_axle_offset: float | None = None
) -> tuple[float, float, float, float]:
    """Return σ of body and pitch acceleration [m/s^2, rad/s^2] and both tyre loads [N] of the passive car on class B.

    Stationary and exact: the road filter joins the state, the rear input is the front's, τ later, and the
    covariance is P + M + M' with P from both inputs alone and M = e^{Aτ} X for what they share
    (A X + X A' + b_f b_r' = 0). tests/validation holds it against the frequency response and a long run.

    Args:
        vehicle: The car.
        speed: At which it is driven [m/s].
        rear_axle_offset: How far behind the front axle the rear one meets the road [m]: τ times the speed; None is the
            wheelbase.

    Raises:
        UnstableVehicleError: The passive car is not stable.
    """
    model = half_car(vehicle)
    if np.linalg.eigvals(model.A).real.max() >= 0:
        raise UnstableVehicleError("The passive vehicle is unstable", field="vehicle")
    corner = 2 * pi * CUTOFF_FREQUENCY * speed
    gain = 2 * pi * REFERENCE_FREQUENCY * np.sqrt(REFERENCE_ROUGHNESS * speed / 2)  # √ of the two-sided noise density
    road = model.E[:, :2]
    A = np.block([[model.A, -corner * road], [np.zeros((2, STATES)), -corner * np.eye(2)]])
    b = gain * np.vstack([road, np.eye(2)])
    behind = vehicle.wheelbase if rear_axle_offset is None else rear_axle_offset
    own = lyapunov(A, -b @ b.T)
    shared = exponential(A * (behind / speed)) @ lyapunov(A, -np.outer(b[:, 0], b[:, 1]))
    C = np.hstack([model.C[:4], np.zeros((4, 2))])
    variance = np.einsum("ij,jk,ik->i", C, own + shared + shared.T, C)
    a, pitch, front, rear = np.sqrt(np.maximum(variance, 0.0))  # rounding may leave less than nothing
    return float(a), float(pitch), float(front), float(rear)


@small_cached(128)
def _interval_means(vehicle: Vehicle, sample_time: float) -> FloatArray:
    """For each cost output y the matrix S with z'S z = mean of y² over the interval; shape (6, 13, 13).

    z = [state; force in kN; road velocities; deceleration], the last three held. Gauss-Legendre at 16 points
    of the exact solution (lifted outputs): positive semidefinite by construction; exact to rounding for every car
    within the sliders' ranges, approximate for wheel modes far faster than the interval.
    """
    model = half_car(vehicle)
    inputs = np.hstack([model.B * KILO, model.E])
    n = STATES + FORCES + DISTURBANCES
    generator = np.zeros((n, n))
    generator[:STATES] = np.hstack([model.A, inputs])
    output = np.hstack([model.C, model.D * KILO, model.F])
    times = (_NODES + 1) / 2 * sample_time
    lifted = output @ exponential(generator * times[:, None, None])  # (point, output, 13)
    means: FloatArray = np.einsum("p,poi,poj->oij", _NODE_WEIGHTS / 2, lifted, lifted)
    return means


@dataclass(frozen=True, slots=True, kw_only=True)
class CostTerms:
    """All that the cost of one stage depends on; `Setup.cost` gives those of a run.

    docs/explanation/cost-and-lqr.md has the formulas.

    Attributes:
        vehicle: The car.
        speed: Initial speed, at which the passive car's σ are taken [m/s].
        sample_time: Length of the interval [s].
        weights: Of body acceleration, pitch acceleration and tyre loads: q1, q2, q3 [1].
        deflection_weight: Of the suspension deflections: q4 [1].
        deflection_limit: By which those are divided: d_max [m].
        force_weight: R [1/N²].
        rear_axle_offset: How far behind the front axle the rear one meets the road, for the σ [m]; None is the
            wheelbase.

    Example:
        >>> from sim_core import CostTerms, Scenario, regulator
        >>> terms = CostTerms(
        ...     vehicle=Scenario().vehicle, speed=14.0, sample_time=0.01, weights=(8, 1, 1),
        ...     deflection_weight=3.0, deflection_limit=0.08, force_weight=1e-9,
        ... )
        >>> regulator(terms).gain.shape
        (2, 8)
    """

    vehicle: Vehicle
    speed: float
    sample_time: float
    weights: Weights
    deflection_weight: float
    deflection_limit: float
    force_weight: float
    rear_axle_offset: float | None = None


@small_cached(512)
def stage_cost(terms: CostTerms) -> FloatArray:
    """One interval's cost [1] as z'S z, S (13, 13); z as in `_interval_means`, with forces in kN."""
    S: FloatArray = np.tensordot(_scales(terms), _interval_means(terms.vehicle, terms.sample_time), axes=1)
    forces = np.arange(STATES, STATES + FORCES)
    S[forces, forces] += terms.force_weight * KILO**2
    return S


def cost_by_output(terms: CostTerms, z: FloatArray) -> FloatArray:
    """Return what each of `half_car.OUTPUTS` adds to the cost [1] of intervals z (n, 13): (n, 6).

    z as in `stage_cost`, whose force term is not among them.
    """
    means = _interval_means(terms.vehicle, terms.sample_time)
    return np.asarray(np.einsum("ni,oij,nj->no", z, means, z, optimize=True) * _scales(terms))


def _scales(terms: CostTerms) -> FloatArray:
    """Return what each cost output's mean square is multiplied by (6,)."""
    in_turn = np.array(passive_rms(terms.vehicle, terms.speed))
    sigma = np.maximum(passive_rms(terms.vehicle, terms.speed, terms.rear_axle_offset), LEAST_RMS * in_turn)
    q1, q2, q3 = terms.weights
    scale = np.empty(len(OUTPUTS))
    scale[:4] = np.array([q1, q2, q3, q3]) / sigma**2
    scale[4:] = terms.deflection_weight / terms.deflection_limit**2
    return scale
