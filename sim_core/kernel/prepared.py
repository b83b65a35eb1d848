"""The C's functions that are called at every step: their arrays are checked once, when a run begins.

Each raises ValueError then where sizes disagree, and TypeError where an array is of another type, is not
C-contiguous, or cannot be written into. The arrays live as long as what is called.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.kernel.binding import LAYOUT
from sim_core.kernel.library import DOUBLE, INT, Array, Function, require

CAR, ESTIMATOR = 33, 112  # numbers of `struct car` and `struct estimator` of nonlinear_car.c
ECU_ANSWER, _STAGES = 5, 3  # numbers of an answer in ecu.c, stages of the ECU's tables
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
_drive = Function(
    "drive",
    *(Array(CAR), INT, INT, Array(ESTIMATOR), _TABLE),
    *(INT, _LINE, Array(LAYOUT), _TABLE, _TABLE),
    *(_TABLE, INT, INT, INT, DOUBLE, _LINES_OUT, INT),
    *(Array(_FORCES, _LAW_INPUTS), DOUBLE, _TABLE, _TABLE_OUT, INT, INT),
)


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
        self._run = _drive.bind(*self._fixed)

    def run(self, first: int, gain: FloatArray, limit: float, feed: FloatArray, loop: FloatArray) -> None:
        """Drive from control step `first` on by a law, as long as its feed is.

        Args:
            first: Number of the step.
            gain: (2, 10).
            limit: Of the forces [N].
            feed: (count, 2) [N].
            loop: [p; previous command] before each step and after the last (count + 1, size + 2), of which the first
                row is given.

        Raises:
            ValueError: The steps are beyond the drive, or sizes disagree.
        """
        self._check(first, feed, loop)
        self._run(gain, limit, feed, loop, len(feed), first)

    def prepare(self, gain: FloatArray, limit: float, feed: FloatArray, loop: FloatArray) -> Callable[[int], None]:
        """The same of the first step alone."""
        self._check(0, feed, loop)
        run = _drive.bind(*self._fixed, gain, limit, feed, loop, len(feed))

        def run_from(first: int) -> None:
            self._check(first, feed, loop)
            run(first)

        return run_from

    def measure(self, state: FloatArray, command: FloatArray, braking: float) -> FloatArray:
        """What the car's own sensors give (4,), from its state (8,) or (10,), command (2,) [N] and braking [m/s^2].

        Raises:
            ValueError: The state is another car's.
        """
        require(len(state) == self._states, "A state of 8 numbers, or of 10 with a lagging actuator's")
        measured = np.empty(_MEASURED)
        _measure(self._car, self._states, state, command, braking, measured)
        return measured

    def _check(self, first: int, feed: FloatArray, loop: FloatArray) -> None:
        count = len(feed)
        require(0 <= first <= self._steps - count, "No steps beyond the drive")
        require(
            feed.shape == (count, _FORCES) and loop.shape == (count + 1, self._width), "A row before and after each"
        )
