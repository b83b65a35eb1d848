"""The C's functions that are called at every step: their arrays are checked once, when a run begins.

Each raises ValueError then where sizes disagree, and TypeError where an array is of another type, is not
C-contiguous, or cannot be written into. The arrays live as long as what is called.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.kernel.binding import LAYOUT
from sim_core.kernel.library import DOUBLE, INT, Array, Function, require

CAR, ESTIMATOR = 33, 112  # numbers of `struct car` and `struct estimator` of nonlinear_car.c
ECU_ANSWER, _STAGES = 5, 3  # numbers of an answer in ecu.c, stages of the ECU's tables
_LAW_NUMBERS, _SCREENED = 9, 14  # of `struct law_numbers` in loop.h; columns of a law's screen
_STATES, _LAGGING, _FORCES, _LAW_INPUTS, _DISTURBANCES, _MEASURED, _SIGNALS = 8, 10, 2, 10, 3, 4, 10
_LINE, _TABLE = Array(ndim=1), Array(ndim=2)
_LINE_OUT, _TABLE_OUT, _LINES_OUT = (Array(ndim=ndim, written=True) for ndim in (1, 2, 3))

_residual = Function("residual", INT, INT, _TABLE, _TABLE, *[_LINE] * 3, _LINE_OUT, _LINE, _LINE, result=DOUBLE)
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
_measure = Function("measure", Array(CAR), INT, _LINE, Array(_FORCES), DOUBLE, Array(_MEASURED, written=True))
_LAW = Array(_LAW_NUMBERS), Array(_FORCES, _LAW_INPUTS), _TABLE, _TABLE, _TABLE, Array(), _TABLE, _LINE_OUT
_LOOP = _TABLE_OUT, Array(1, dtype=np.intc, written=True), INT, INT
_NONLINEAR = (
    *(Array(CAR), INT, INT, Array(ESTIMATOR), _TABLE),
    *(INT, _LINE, Array(LAYOUT), _TABLE, _TABLE),
    *(_TABLE, INT, INT, INT, DOUBLE, _LINES_OUT, INT),
)
_drive = Function("drive", *_NONLINEAR, *_LAW, *_LOOP, result=INT)
_advance = Function("advance", *_NONLINEAR, _LINE, Array(_FORCES), _LINE_OUT, INT)
_drive_linear = Function("drive_linear", INT, _TABLE, _TABLE, _TABLE, *_LAW, *_LOOP, result=INT)


def residual(
    H: FloatArray,
    columns: FloatArray,
    lower: FloatArray,
    upper: FloatArray,
    f: FloatArray,
    y: FloatArray,
    multipliers: FloatArray,
) -> Callable[[], float]:
    """The largest violation of the KKT conditions, whenever it is called, by what is in these arrays then.

    H (n, n), columns (n, rows), lower, upper and multipliers (n + rows,), f and y (n,).
    """
    n, rows = columns.shape
    fits = H.shape == (n, n) and len(f) == len(y) == n
    require(fits and len(lower) == len(upper) == len(multipliers) == n + rows, "One number for each unknown and limit")
    return _residual.bind(n, rows, H, columns, lower, upper, f, np.empty(n + rows), y, multipliers)


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


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class LawArrays:
    """A law of control and its limits in one run, as loop.h has them.

    Attributes:
        gain: (2, 10).
        preview_gain: (2, 3 · horizon).
        limits: (rows, 10 + 3 · horizon).
        screen: Gains of each row on state, previous force and mean deceleration, then its norms (14, rows).
        preview: An array with all that is previewed, and how many numbers further the next kind and step are in it.
        apart: Those two.
        sums: Mean deceleration and three norms of what is previewed in each step (4, steps).
        force_limit: Of the law's forces [N].
        most_change: Of the actuators' in a step [N].
        most_force: Of the actuators' [N].
        clips: Whether a force beyond the limit is clipped, or not decided by the law.
    """

    gain: FloatArray
    preview_gain: FloatArray
    limits: FloatArray
    screen: FloatArray
    preview: FloatArray
    apart: tuple[int, int]
    sums: FloatArray
    force_limit: float
    most_change: float
    most_force: float
    clips: bool

    def arguments(self) -> tuple[FloatArray, ...]:
        """What C gets.

        Raises:
            ValueError: Sizes disagree.
        """
        horizon, rows, steps = self.preview_gain.shape[1] // _DISTURBANCES, len(self.limits), self.sums.shape[1]
        kind, step = self.apart
        beyond = (_DISTURBANCES - 1) * kind + (steps - 1) * step + horizon
        require(self.preview_gain.shape == (_FORCES, _DISTURBANCES * horizon), "A gain for everything previewed")
        require(
            self.limits.shape == (rows, _LAW_INPUTS + _DISTURBANCES * horizon), "Limits on everything the law knows"
        )
        require(self.screen.shape == (_SCREENED, rows) and len(self.sums) == 4, "A bound for each limit and step")
        require(
            min(kind, step) >= 0 and (beyond <= self.preview.size or not horizon), "What is previewed in every step"
        )
        limits = self.force_limit, self.most_change, self.most_force
        numbers = np.array([rows, horizon, kind, step, steps, self.clips, *limits], dtype=np.float64)
        arrays = self.gain, self.preview_gain, self.limits, self.screen, self.preview, self.sums
        return numbers, *arrays, np.empty(rows)

    @property
    def steps(self) -> int:
        """Control steps of the run."""
        return len(self.sums[0])


Follow = Callable[[int, int], tuple[int, int]]


def follow_linear(A: FloatArray, B: FloatArray, forcing: FloatArray, law: LawArrays, loop: FloatArray) -> Follow:
    """Drive a linear car by a law.

    Args:
        A: (n, n).
        B: (n, 2).
        forcing: (steps, n).
        law: Of control.
        loop: [p; previous command] before each step and after the last (steps + 1, n + 2).

    Returns:
        From which step on, and before which one, it is to be driven -> the first step that the law does not decide, and
        in how many before it a limit shaped the command.

    Raises:
        ValueError: Sizes disagree.
    """
    n = len(A)
    require(A.shape == (n, n) and B.shape == (n, _FORCES) and n >= _STATES, "A state, and two forces")
    require(forcing.shape == (law.steps, n), "What moves the car in every step")
    return _following(partial(_drive_linear.bind, n, A, B, forcing), law, loop, n)


def _following(bind: Callable[..., Callable[[int, int], int]], law: LawArrays, loop: FloatArray, size: int) -> Follow:
    require(loop.shape == (law.steps + 1, size + _FORCES), "A row before each step and after the last")
    limited = np.zeros(1, dtype=np.intc)
    follow = bind(*law.arguments(), loop, limited)

    def follow_from(first: int, last: int) -> tuple[int, int]:
        require(0 <= first <= last <= law.steps, "No steps beyond the drive")
        limited[0] = 0
        driven: int = follow(first, last)
        return driven, int(limited[0])

    return follow_from


class NonlinearDrive:
    """A nonlinear car over its whole drive, of which a call takes some control steps.

    Args:
        car: (33,), as `struct car` has them.
        states: 8, or 10 with a lagging actuator's.
        estimator: (112,), as `struct estimator` has them; None without one.
        known: What the estimator knows beforehand (steps, 8); of no steps without one.
        road: Its samples (m,) [m] and layout (9,), the positions (2, n + 1) [m] of both axles at the ends of all fine
            steps, means and moments above chords (n, 4) [m]; None where the road is straight within a fine step.
        disturbance: (steps, 3 · fine).
        substeps: Of Runge-Kutta in a fine step.
        fine_step: In s.
        table: Where the signals of the last steps are recorded (10, fine + 1, columns).
    """

    def __init__(
        self,
        *,
        car: FloatArray,
        states: int,
        estimator: FloatArray | None,
        known: FloatArray,
        road: tuple[FloatArray, FloatArray, FloatArray, FloatArray] | None,
        disturbance: FloatArray,
        substeps: int,
        fine_step: float,
        table: FloatArray,
    ) -> None:
        self._car, self._states = car, states
        self._steps, fine = len(disturbance), disturbance.shape[1] // _DISTURBANCES
        self._width = states + _FORCES + (0 if estimator is None else _STATES)
        columns, all_fine = table.shape[-1], self._steps * fine
        require(states in (_STATES, _LAGGING) and substeps > 0 < fine, "A state of 8 or 10 numbers, and a step or more")
        require(disturbance.shape[1] == _DISTURBANCES * fine, "Three disturbances in a fine step")
        require(table.shape == (_SIGNALS, fine + 1, columns) and columns <= self._steps, "A record within the drive")
        require(estimator is None or known.shape == (self._steps, _STATES), "What is known of every step")
        samples, layout, position, within = road or (np.empty(0), np.zeros(LAYOUT), np.empty((0, 0)), np.empty((0, 0)))
        if road is not None:
            require(len(samples) > 1, "A road has two samples at least")
            require(
                position.shape == (2, all_fine + 1) and within.shape == (all_fine, 4), "The road of every fine step"
            )
        self._fixed = (
            *(car, states, int(estimator is not None), np.zeros(ESTIMATOR) if estimator is None else estimator, known),
            *(len(samples), samples, layout, position, within),
            *(disturbance, self._steps, fine, substeps, fine_step, table, columns),
        )
        self._advance = _advance.bind(*self._fixed)

    def follow(self, law: LawArrays, loop: FloatArray) -> Follow:
        """Drive it by a law, as `follow_linear`.

        Raises:
            ValueError: Sizes disagree.
        """
        require(law.steps == self._steps, "What is previewed in every step")
        return _following(partial(_drive.bind, *self._fixed), law, loop, self._width - _FORCES)

    def advance(self, step: int, now: FloatArray, command: FloatArray) -> FloatArray:
        """The state at the end of a control step that begins with `now` and holds `command` (2,) [N].

        Raises:
            ValueError: The step is beyond the drive, or the state is another car's.
        """
        require(0 <= step < self._steps, "No steps beyond the drive")
        require(len(now) == self._width - _FORCES, "The state of this car")
        following = np.empty_like(now)
        self._advance(now, command, following, step)
        return following

    def measure(self, state: FloatArray, command: FloatArray, braking: float) -> FloatArray:
        """What the car's own sensors give (4,), from its state (8,) or (10,), command (2,) [N] and braking [m/s^2].

        Raises:
            ValueError: The state is another car's.
        """
        require(len(state) == self._states, "A state of 8 numbers, or of 10 with a lagging actuator's")
        measured = np.empty(_MEASURED)
        _measure(self._car, self._states, state, command, braking, measured)
        return measured
