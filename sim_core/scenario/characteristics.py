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
    """Of the car around rest, its dampers at the mean of compression and rebound there.

    Attributes:
        static_sag: By how much the body's weight compresses each suspension [m]; travel is counted from there.
        natural_frequencies: Undamped, of the body on suspension and tyre in series, and of the wheel between both [Hz].
        damping_ratios: Of these motions [1].
    """

    static_sag: Axles
    natural_frequencies: Modes
    damping_ratios: Modes


def characteristics(vehicle: Vehicle) -> Characteristics:
    """A vehicle's characteristics, each axle taken by itself as a quarter-car.

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
    shares = per_metre * vehicle.cg_to_rear, per_metre * vehicle.cg_to_front
    springs = vehicle.front_spring, vehicle.rear_spring
    tyres = vehicle.front_tyre_stiffness, vehicle.rear_tyre_stiffness
    wheels = vehicle.front_wheel_mass, vehicle.rear_wheel_mass
    frequencies, ratios = [], []
    for m, k_s, k_t, c in zip(shares, springs, tyres, vehicle.damping_at_rest, strict=True):
        together = k_s * k_t / (k_s + k_t)
        frequencies.append(sqrt(together / m) / (2 * pi))
        ratios.append(c * (k_t / (k_s + k_t)) ** 2 / (2 * sqrt(together * m)))
    for m_w, k_s, k_t, c in zip(wheels, springs, tyres, vehicle.damping_at_rest, strict=True):
        frequencies.append(sqrt((k_s + k_t) / m_w) / (2 * pi))
        ratios.append(c / (2 * sqrt((k_s + k_t) * m_w)))
    sag = [m * GRAVITY / k_s for m, k_s in zip(shares, springs, strict=True)]
    return Characteristics(
        static_sag=Axles(front=sag[0], rear=sag[1]),
        natural_frequencies=_modes(frequencies),
        damping_ratios=_modes(ratios),
    )


def _modes(values: list[float]) -> Modes:
    front_body, rear_body, front_wheel, rear_wheel = values
    return Modes(front_body=front_body, rear_body=rear_body, front_wheel=front_wheel, rear_wheel=rear_wheel)
