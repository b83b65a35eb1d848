"""A law of control, semi-active dampers and an estimator: what is between a car and its controller."""

from dataclasses import dataclass
from math import inf

from sim_core.arrays import FloatArray
from sim_core.errors import RefusedError


@dataclass(frozen=True, slots=True, kw_only=True)
class SemiActiveDampers:
    """Dampers of both axles whose coefficients the actuators set, so that all they do is take energy out.

    Attributes:
        least: Smallest coefficient that a damper as a whole, the passive one included, can be set to [N s/m].
        most: Largest one [N s/m]; infinite where there is no limit.
        most_force: By how much control changes the passive damper's force at most [N]; where `least` or `most` asks for
            more, they are kept. A run sets it from the limits of forces.

    Example:
        >>> from sim_core import DampingController, Scenario, SemiActiveDampers, axle_velocities, simulate
        >>> class SoftSkyhook(DampingController):
        ...     def damping(self, setup):
        ...         return -4000.0 * axle_velocities(setup)[0]
        ...     def dampers(self):
        ...         return SemiActiveDampers(least=500.0, most=8000.0)
        >>> skyhook, speed_only = simulate(Scenario(), SoftSkyhook), simulate(Scenario(), "speed_only")
        >>> skyhook.comfort["weighted_rms"] < speed_only.comfort["weighted_rms"]
        True
    """

    least: float
    most: float
    most_force: float = inf

    def __post_init__(self) -> None:
        """Check the coefficients.

        Raises:
            RidelabError: They are not 0 or more, or the least is above the most.
        """
        if not 0 <= self.least <= self.most:
            raise RefusedError("A semi-active damper's least damping is 0 or more, and at most its greatest one")


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Estimator:
    """x̂[k+1] = state·x̂[k] + command·u[k] + measurement·y[k+1] + input[k]: the estimated state a controller acts on.

    Attributes:
        state: (8, 8).
        command: (8, 2).
        measurement: Of half_car.MEASURED_OUTPUTS at the end of a control step, before the command changes (8, 4).
        input: What is known beforehand, and the sensors' noise (steps, 8).
    """

    state: FloatArray
    command: FloatArray
    measurement: FloatArray
    input: FloatArray
