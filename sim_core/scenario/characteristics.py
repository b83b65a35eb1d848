"""What a vehicle's parameters come to in the words of a data sheet: static sag, natural frequencies, damping ratios."""

from dataclasses import dataclass
from math import pi, sqrt

from sim_core.scenario.vehicle import GRAVITY, Vehicle


@dataclass(frozen=True, slots=True, kw_only=True)
class Axles:
    """A number of the front and of the rear axle."""

    front: float
    rear: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Modes:
    """A number of the body above each axle, and of each axle's wheel."""

    front_body: float
    rear_body: float
    front_wheel: float
    rear_wheel: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Characteristics:
    """Characteristics of the car around rest, its dampers at the mean of compression and rebound there.

    Attributes:
        static_sag: By how much the body's weight compresses each suspension [m]; travel is counted from there.
        natural_frequencies: Undamped, of the body on suspension and tyre in series, and of the wheel between both [Hz].
        damping_ratios: Of these motions [1].
    """

    static_sag: Axles
    natural_frequencies: Modes
    damping_ratios: Modes


def characteristics(vehicle: Vehicle) -> Characteristics:
    """Return a vehicle's characteristics, each axle taken by itself as a quarter-car.

    The body's share m of an axle swings on spring and tyre in series, (2π f)² = k_s k_t/((k_s + k_t) m), where the
    damper moves by k_t/(k_s + k_t) of what the body does; the wheel swings between both, (2π f)² = (k_s + k_t)/m_w
    (docs/explanation/half-car.md; T. D. Gillespie 1992, Fundamentals of Vehicle Dynamics, chapter 5). `DataSheet` asks
    the reverse.

    Example:
        >>> from sim_core import Scenario, characteristics
        >>> of_paper = characteristics(Scenario().vehicle)
        >>> f"{of_paper.natural_frequencies.front_body:.2f} Hz, {of_paper.static_sag.front:.3f} m"
        '0.87 Hz, 0.300 m'
    """
    per_metre = vehicle.body_mass / vehicle.wheelbase
    sag, frequencies, ratios = dict[str, float](), dict[str, float](), dict[str, float]()
    axles = zip(("front", "rear"), (vehicle.cg_to_rear, vehicle.cg_to_front), vehicle.damping_at_rest, strict=True)
    for axle, arm, c in axles:
        names = ("spring", "tyre_stiffness", "wheel_mass")
        k_s, k_t, m_w = (getattr(vehicle, f"{axle}_{name}") for name in names)
        m, series, parallel = per_metre * arm, k_s * k_t / (k_s + k_t), k_s + k_t
        sag[axle] = m * GRAVITY / k_s
        frequencies[f"{axle}_body"] = sqrt(series / m) / (2 * pi)
        frequencies[f"{axle}_wheel"] = sqrt(parallel / m_w) / (2 * pi)
        ratios[f"{axle}_body"] = c * (k_t / (k_s + k_t)) ** 2 / (2 * sqrt(series * m))
        ratios[f"{axle}_wheel"] = c / (2 * sqrt(parallel * m_w))
    return Characteristics(
        static_sag=Axles(**sag), natural_frequencies=Modes(**frequencies), damping_ratios=Modes(**ratios)
    )
