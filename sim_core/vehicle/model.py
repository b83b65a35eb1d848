"""What a car on its road is: driven over many control steps by a linear law, over one by a command, and recorded."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from math import inf

from sim_core.arrays import FloatArray
from sim_core.errors import RidelabError
from sim_core.kernel.prepared import DrivenCar, FollowLaw, LawArrays


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


class VehicleModel(ABC):
    """`size` numbers are the state p: the half-car's (8,), then a lagging actuator's forces [N] (2,).

    With an estimator its estimate (8,) comes before them, so that p begins with what a controller acts on.
    """

    size: int
    _driven: DrivenCar

    def follow_law(self, law: LawArrays, loop: FloatArray) -> FollowLaw:
        """Drive it by a law of control, as `prepared.DrivenCar.follow_law` says.

        Args:
            law: In all control steps.
            loop: [p; previous command] before each step and after the last (steps + 1, size + 2).
        """
        return self._driven.follow_law(law, loop)

    def advance(self, step: int, loop: FloatArray) -> None:
        """Fill in the state after a control step, whose command [N] stands beside it in `follow_law`'s `loop`."""
        self._driven.advance(step, loop)

    @abstractmethod
    def measure(self, step: int, state: FloatArray, command: FloatArray) -> FloatArray:
        """half_car.MEASURED_OUTPUTS (4,) at the beginning of a control step, without noise.

        Args:
            step: Index of the control step.
            state: p (size,) then.
            command: Held until then (2,) [N].
        """

    @abstractmethod
    def record(self, states: FloatArray, commands: FloatArray) -> FloatArray:
        """plant.RECORDED (10, fine + 1, steps) of the control steps on record, as they were driven last.

        A step begins with the value after its command has changed and ends with the value before the next one does.

        Args:
            states: p at the beginning of each (steps, size).
            commands: Held in each (steps, 2) [N].
        """
