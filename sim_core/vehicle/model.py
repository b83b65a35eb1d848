"""A law of control, semi-active dampers and an estimator: what is between a car and its controller."""

from dataclasses import dataclass
from math import inf

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.errors import RidelabError
from sim_core.vehicle.half_car import DISTURBANCES, FORCES, STATES

LAW_INPUTS = STATES + FORCES  # what a law multiplies: the state, then the previous command


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class LinearLaw:
    """u = gain·[state; previous force] + preview_gain·disturbances [N], while no limit binds.

    Attributes:
        gain: On the state (8,), then on the previous force [N] (2, 10).
        preview_gain: On the expected disturbances, all steps of the front road velocity, then of the rear one, then of
            the deceleration (2, 3 · preview_steps); None for nothing.
        limits: Limits beside the greatest force, each a row divided by its limit: the law holds where every row times
            [state; previous force; disturbances] is between -1 and 1 (rows, 10 + 3 · preview_steps); None for none.

    Example:
        >>> import numpy as np
        >>> from sim_core import LinearLaw
        >>> gain = np.zeros((2, 10))
        >>> gain[:, 4] = -1000.0  # against the body's velocity
        >>> LinearLaw(gain=gain).force(np.array([0, 0, 0, 0, 0.2, 0, 0, 0]), np.zeros(2), np.zeros((3, 0))).tolist()
        [-200.0, -200.0]
    """

    gain: FloatArray
    preview_gain: FloatArray | None = None
    limits: FloatArray | None = None

    def __post_init__(self) -> None:
        """Check the arrays, which become contiguous copies that nobody can write.

        Raises:
            RidelabError: A shape does not fit, or a number is not finite.
        """
        for name, array, rows, fixed in (
            ("gain", self.gain, FORCES, LAW_INPUTS),
            ("preview_gain", self.preview_gain, FORCES, 0),
            ("limits", self.limits, None, LAW_INPUTS),
        ):
            if array is None:
                continue
            previewed = np.shape(array)[-1] - fixed if np.ndim(array) == 2 else -1
            own = np.array(array, dtype=np.float64, order="C")
            own.flags.writeable = False
            object.__setattr__(self, name, own)
            if previewed < 0 or previewed % DISTURBANCES or rows not in (None, len(array)):
                raise RidelabError(f"A linear law's {name} has the shape {np.shape(array)}")
            if not np.isfinite(own).all():
                raise RidelabError(f"A linear law's {name} has a number that is not finite")

    def force(self, state: FloatArray, previous_force: FloatArray, disturbances: FloatArray) -> FloatArray:
        """The law's forces (2,) [N].

        Args:
            state: (8,).
            previous_force: (2,) [N].
            disturbances: (3, preview_steps).
        """
        force = self.gain[:, :STATES] @ state + self.gain[:, STATES:] @ previous_force
        return force if self.preview_gain is None else force + self.preview_gain @ disturbances.ravel()


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
            raise RidelabError("A semi-active damper's least damping is 0 or more, and at most its greatest one")


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
