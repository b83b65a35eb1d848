"""What a car on its road is: driven over many control steps by a linear law, over one by a command, and recorded."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from math import inf

from sim_core.arrays import FloatArray
from sim_core.vehicle.half_car import FORCES, STATES

LAW_INPUTS = STATES + FORCES  # what a law multiplies: the state, then the previous command


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class LinearLaw:
    """u = gain·z + feed while no limit binds; z (10,) = [state (8); previous command (2) in N], gain (2, 10).

    A nonlinear car, which is stepped one control step after another, keeps the force within `force_limit` [N] itself.
    """

    gain: FloatArray
    force_limit: float = inf


@dataclass(frozen=True, slots=True, kw_only=True)
class SemiActiveDampers:
    """Dampers of both axles whose coefficients the actuators set, so that all they do is take energy out.

    Attributes:
        least: What a damper can be set to, the passive one included [N s/m].
        most: The same; infinite where there is no limit.
        most_force: What control changes of the passive damper's force at most [N]; `least` and `most` go before it.
    """

    least: float
    most: float
    most_force: float


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

    @abstractmethod
    def free_run(self, law: LinearLaw, first: int, start: FloatArray, feed: FloatArray) -> FloatArray:
        """The closed loop over control steps in which no limit binds: z (steps + 1, size + 2) from `start` on.

        Args:
            law: Of the controller.
            first: Index of the first control step.
            start: [p; previous command in N] before it (size + 2,).
            feed: What preview adds to the law's force in each step (steps, 2) [N].
        """

    @abstractmethod
    def advance(self, step: int, state: FloatArray, command: FloatArray) -> FloatArray:
        """The state p (size,) at the end of a control step that begins with `state` and holds `command` (2,) [N]."""

    @abstractmethod
    def record(self, states: FloatArray, commands: FloatArray) -> FloatArray:
        """plant.RECORDED (10, fine + 1, steps) of the control steps on record, as they were driven last.

        A step begins with the value after its command has changed and ends with the value before the next one does.

        Args:
            states: p at the beginning of each (steps, size).
            commands: Held in each (steps, 2) [N].
        """
