"""The C's functions that are called at every step: their arrays are checked once, when a run begins.

Each raises ValueError then where sizes disagree, and TypeError where an array is of another type, is not
C-contiguous, or cannot be written into. The arrays live as long as what is called.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.kernel.binding import LAYOUT
from sim_core.kernel.library import DOUBLE, INT, Array, Function, Optional, Prepared, require
from sim_core.kernel.qp import QpDesign, QpMemory

CAR, ESTIMATOR = 33, 112  # numbers of `struct vehicle` and `struct estimator` of nonlinear_car.c
ECU_ANSWER, _STAGES = 5, 3  # numbers of an answer in ecu.c, stages of the ECU's tables
_LAW_NUMBERS, _SIZES = 9, 5  # of `struct law_numbers` in loop.h; columns of a law's norms
_STATES, _LAGGING, _FORCES, _LAW_INPUTS, _DISTURBANCES, _MEASURED, _SIGNALS = 8, 10, 2, 10, 3, 4, 10
_LINE, _TABLE = Array(ndim=1), Array(ndim=2)
_LINE_OUT, _TABLE_OUT, _LINES_OUT = (Array(ndim=ndim, written=True) for ndim in (1, 2, 3))

_ecu_step = Function(
    "ecu_step",
    *(
        Array(6, dtype=np.int32),
        Array(4, dtype=np.float32),
        Array(115, dtype=np.float32),
        Array(ndim=1, dtype=np.float32),
    ),
    *(Array(ndim=1, dtype=np.int8), Array(ndim=3, dtype=np.float32), Array(ndim=3, dtype=np.float32)),
    *(Array(_FORCES, dtype=np.float32, written=True), Array(ndim=1, dtype=np.int32)),
    *(Array(ECU_ANSWER, dtype=np.int32, written=True), Array(1, dtype=np.float32, written=True), INT),
    result=INT,
)
_prepare_law = Function(
    "prepare_law",
    *(Array(_LAW_NUMBERS), Array(_FORCES, _LAW_INPUTS), _TABLE, _TABLE),
    *(Array(_LAW_INPUTS), _TABLE, Array(), _TABLE, _LINE_OUT, Optional, Optional),
)
_prepare_linear_car = Function("prepare_linear_car", INT, _TABLE, _TABLE, _TABLE)
_prepare_nonlinear_car = Function(
    "prepare_nonlinear_car",
    *(Array(CAR), INT, INT, Array(ESTIMATOR), _TABLE),
    *(INT, _LINE, Array(LAYOUT), _TABLE, _TABLE),
    *(_TABLE, INT, INT, INT, DOUBLE, _LINES_OUT, INT),
)
_follow_law = Function(
    "follow_law", Prepared, Prepared, _TABLE_OUT, Array(1, dtype=np.intc, written=True), INT, INT, result=INT
)
_limit_force = Function(
    "limit_force", Array(3), Array(_FORCES), Array(_FORCES), Array(_FORCES, written=True), result=INT
)
_advance = Function("advance", Prepared, _TABLE_OUT, INT)
_measure = Function("measure", Prepared, _LINE, Array(_FORCES), DOUBLE, Array(_MEASURED, written=True))


def ecu_step(
    *,
    sizes: NDArray[np.int32],
    real: NDArray[np.float32],
    vehicle: NDArray[np.float32],
    bounds: NDArray[np.float32],
    axles: NDArray[np.int8],
    effects: NDArray[np.float32],
    gram: NDArray[np.float32],
    previous: NDArray[np.float32],
    codes: NDArray[np.int32],
    answer: NDArray[np.int32],
    slack: NDArray[np.float32],
) -> Callable[[int], None]:
    """A step of the ECU's program in a stage, whenever it is called; kernel/ecu.c says what the arrays hold.

    Raises:
        ValueError: Sizes disagree; when it is called: the program has not the memory for them, or the stage is none.
    """
    intervals, previewed, rows = sizes[:3].tolist()
    columns = _STATES + _FORCES + _DISTURBANCES * intervals
    fits = effects.shape == (_STAGES, rows, columns) and gram.shape == (_STAGES, rows, rows)
    require(fits and len(bounds) == len(axles) == rows, "Tables of every stage, with a bound for each row")
    require(len(codes) == _STATES + _DISTURBANCES * previewed, "A code for everything measured and previewed")
    step = _ecu_step.bind(sizes, real, vehicle, bounds, axles, effects, gram, previous, codes, answer, slack)

    def step_in(stage: int) -> None:
        require(step(stage) == 0, "The ECU's program knows no such tables or stage")

    return step_in


def limit_force(limits: FloatArray, wanted: FloatArray, previous: FloatArray, command: FloatArray) -> bool:
    """Fill in what the actuators are told (2,) [N]; whether a limit shapes it.

    Args:
        limits: Greatest force that may be wanted, its greatest change, and the actuators' greatest force (3,) [N].
        wanted: By the controller (2,) [N].
        previous: What they were told before (2,) [N].
        command: To be filled.
    """
    return bool(_limit_force(limits, wanted, previous, command))


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class LawArrays:
    """A law of control and its limits in one run, as loop.h has them.

    Attributes:
        gain: (2, 10).
        preview_gain: (2, 3 · horizon).
        limits: (rows, 10 + 3 · horizon).
        scale: Of the state and the previous force, where `norms` have them together (10,).
        norms: Of each row's parts on the scaled state and force, on the mean deceleration, on both road velocities, and
            on the deceleration's difference from its mean (5, rows).
        preview: An array with all that is previewed.
        strides: How many numbers further the next kind of disturbance and the next control step are in it.
        sizes: Magnitudes of what is previewed in each step, for the last four of the norms (4, steps).
        force_limits: As `limit_force` has them (3,).
        clips: Whether a force beyond the limit is clipped, or not decided by the law.
        qp: What decides the steps in which a limit binds, and its memory in this run; None where C does not.
    """

    gain: FloatArray
    preview_gain: FloatArray
    limits: FloatArray
    scale: FloatArray
    norms: FloatArray
    preview: FloatArray
    strides: tuple[int, int]
    sizes: FloatArray
    force_limits: FloatArray
    clips: bool
    qp: tuple[QpDesign, QpMemory] | None = None

    def prepared(self) -> Prepared:
        """What C gets.

        Raises:
            ValueError: Sizes disagree.
        """
        horizon, rows, steps = self.preview_gain.shape[1] // _DISTURBANCES, len(self.limits), self.sizes.shape[1]
        kind, step = self.strides
        beyond = (_DISTURBANCES - 1) * kind + (steps - 1) * step + horizon
        require(self.preview_gain.shape == (_FORCES, _DISTURBANCES * horizon), "A gain for everything previewed")
        require(
            self.limits.shape == (rows, _LAW_INPUTS + _DISTURBANCES * horizon), "Limits on everything the law knows"
        )
        require(self.norms.shape == (_SIZES, rows) and len(self.sizes) == _SIZES - 1, "Norms of each limit and step")
        require(
            min(kind, step) >= 0 and (beyond <= self.preview.size or not horizon), "What is previewed in every step"
        )
        numbers = np.array([rows, horizon, kind, step, steps, self.clips, *self.force_limits], dtype=np.float64)
        inputs = _LAW_INPUTS + _DISTURBANCES * horizon
        by_row, work = (self.limits, self.scale, self.norms), np.empty(inputs + rows)
        design, memory = self.qp or (None, None)
        qp = memory.both(design, inputs) if memory and design else (None, None)
        previewed = self.preview, self.sizes
        return _prepare_law.prepare(numbers, self.gain, self.preview_gain, *by_row, *previewed, work, *qp)

    @property
    def steps(self) -> int:
        """Control steps of the run."""
        return len(self.sizes[0])


FollowLaw = Callable[[int, int], tuple[int, int]]


class DrivenCar:
    """A car over its whole drive, of which a call takes some control steps.

    Args:
        prepared: It, as C has it.
        size: Numbers of its state.
        steps: Control steps of the drive.
    """

    def __init__(self, prepared: Prepared, size: int, steps: int) -> None:
        self._prepared, self._size, self._steps = prepared, size, steps

    def follow_law(self, law: LawArrays, loop: FloatArray) -> FollowLaw:
        """Drive it by a law.

        Args:
            law: Of control.
            loop: [p; previous command] before each step and after the last (steps + 1, size + 2).

        Returns:
            From which step on, and before which one, it is to be driven -> the first step that the law does not decide,
            and in how many before it a limit shaped the command.

        Raises:
            ValueError: Sizes disagree.
        """
        require(law.steps == self._steps, "What is previewed in every step")
        self._check(loop)
        limited = np.zeros(1, dtype=np.intc)
        follow = _follow_law.bind(self._prepared, law.prepared(), loop, limited)

        def follow_from(first: int, last: int) -> tuple[int, int]:
            require(0 <= first <= last <= self._steps, "No steps beyond the drive")
            limited[0] = 0
            driven: int = follow(first, last)
            return driven, int(limited[0])

        return follow_from

    def advance(self, step: int, loop: FloatArray) -> None:
        """Fill in its state after a control step, whose command stands beside it already.

        Args:
            step: Index of the control step.
            loop: As `follow_law` has it.

        Raises:
            ValueError: The step is beyond the drive, or sizes disagree.
        """
        require(0 <= step < self._steps, "No steps beyond the drive")
        self._check(loop)
        _advance(self._prepared, loop, step)

    def measure(self, state: FloatArray, command: FloatArray, braking: float) -> FloatArray:
        """What a nonlinear car's own sensors give (4,), from its state, command (2,) [N] and braking [m/s^2].

        Raises:
            ValueError: The state is another car's.
        """
        require(len(state) == self._size, "The state of this car")
        measured = np.empty(_MEASURED)
        _measure(self._prepared, state, command, braking, measured)
        return measured

    def _check(self, loop: FloatArray) -> None:
        require(loop.shape == (self._steps + 1, self._size + _FORCES), "A row before each step and after the last")


def linear_car(A: FloatArray, B: FloatArray, forcing: FloatArray) -> DrivenCar:
    """A linear car: A (n, n), B (n, 2), forcing (steps, n).

    Raises:
        ValueError: Sizes disagree.
    """
    n = len(A)
    require(A.shape == (n, n) and B.shape == (n, _FORCES) and n >= _STATES, "A state, and two forces")
    require(forcing.shape[1] == n, "What moves the car in every step")
    return DrivenCar(_prepare_linear_car.prepare(n, A, B, forcing), n, len(forcing))


def nonlinear_car(
    *,
    car: FloatArray,
    states: int,
    estimator: FloatArray | None,
    estimator_input: FloatArray,
    road: tuple[FloatArray, FloatArray, FloatArray, FloatArray] | None,
    disturbance: FloatArray,
    substeps: int,
    fine_step: float,
    table: FloatArray,
) -> DrivenCar:
    """A nonlinear car.

    Args:
        car: (33,), as `struct vehicle` has them.
        states: 8, or 10 with a lagging actuator's.
        estimator: (112,), as `struct estimator` has them; None without one.
        estimator_input: Known beforehand (steps, 8); of no steps without one.
        road: Its samples (m,) [m] and layout (9,), the positions (2, n + 1) [m] of both axles at the ends of all fine
            steps, means and moments above chords (n, 4) [m]; None where the road is straight within a fine step.
        disturbance: (steps, 3 · fine).
        substeps: Of Runge-Kutta in a fine step.
        fine_step: In s.
        table: Where the signals of the last steps are recorded (10, fine + 1, columns).

    Raises:
        ValueError: Sizes disagree.
    """
    steps, fine = len(disturbance), disturbance.shape[1] // _DISTURBANCES
    columns, all_fine, estimates = table.shape[-1], steps * fine, estimator is not None
    require(states in (_STATES, _LAGGING) and substeps > 0 < fine, "A state of 8 or 10 numbers, and a step or more")
    require(disturbance.shape[1] == _DISTURBANCES * fine, "Three disturbances in a fine step")
    require(table.shape == (_SIGNALS, fine + 1, columns) and columns <= steps, "A record within the drive")
    require(not estimates or estimator_input.shape == (steps, _STATES), "The estimator's input in every step")
    samples, layout, position, within = road or (np.empty(0), np.zeros(LAYOUT), np.empty((0, 0)), np.empty((0, 0)))
    if road is not None:
        require(len(samples) > 1, "A road has two samples at least")
        require(position.shape == (2, all_fine + 1) and within.shape == (all_fine, 4), "The road of every fine step")
    prepared = _prepare_nonlinear_car.prepare(
        *(car, states, int(estimates), np.zeros(ESTIMATOR) if estimator is None else estimator, estimator_input),
        *(len(samples), samples, layout, position, within),
        *(disturbance, steps, fine, substeps, fine_step, table, columns),
    )
    return DrivenCar(prepared, states + (_STATES if estimates else 0), steps)
