"""The C's functions of a predictive controller's QPs (kernel/qp.c)."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.kernel.library import DOUBLE, INT, Array, CStruct, Function, require, size_of

_FORCES, _AXLES = size_of("forces"), 2
_MOST_MOVES = size_of("moves")  # that C has memory for
_LINE, _TABLE, _LINE_OUT = Array(ndim=1), Array(ndim=2), Array(ndim=1, written=True)
_COUNTS = Array(size_of("qp_counts"), written=True)
_DUAL_BYTES = size_of("dual")
_prepare_qp = Function(
    "prepare_qp",
    *(INT, INT, INT, _TABLE, _TABLE, _LINE, _LINE, _TABLE, _TABLE, _LINE, Array(ndim=1, dtype=np.int8), _TABLE),
    *(DOUBLE, DOUBLE, INT),
)
_prepare_qp_run = Function(
    "prepare_qp_run", _COUNTS, *[_LINE_OUT] * 5, Array(_DUAL_BYTES, dtype=np.uint8, written=True)
)
_pose_qp = Function("pose_qp", CStruct, CStruct, _LINE)
_solve_qp = Function("solve_qp", CStruct, CStruct, _LINE, Array(_FORCES, written=True), result=INT)
_residual = Function("residual", CStruct, CStruct, result=DOUBLE)


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class QpDesign:
    """What a driving stage's QPs share: min ½ y'Hy + f'y, low <= y <= high, A y <= b; y = [moves in kN; slacks in cm].

    A y <= b keeps the deflections at the end of all intervals, front ones first, below their limit and slack, then
    above it. f and b follow in each step from the law's inputs: state, previous force in N, preview. `values` are
    moves and deflections.

    Attributes:
        H: (n, n), positive definite; the last two unknowns are the slacks, front and rear.
        columns: Those of A (n, rows); two rows for each deflection.
        low: (n,).
        high: (n,).
        linear_term_gain: The linear term but for the slacks, then the deflections without a force (values, inputs).
        unconstrained_gain: The values where no limit binds, each over its bound (values, inputs).
        bounds: Those bounds (values,).
        axles: Whose slack softens a bound: 0 front, 1 rear, -1 none (values,).
        gram: A H⁻¹ Aᵀ of the values: how a multiplier of one moves the others (values, values).
        slack_price: Linear penalty of a slack [1/cm].
        inverse_slack_weight: Inverse of its quadratic one, 1/H [cm²].
        iterations: Most of the dual method in one QP.
        prepared: All of it, as C has it.

    Raises:
        ValueError: Sizes disagree, or there are more moves than C has memory for.
    """

    H: FloatArray
    columns: FloatArray
    low: FloatArray
    high: FloatArray
    linear_term_gain: FloatArray
    unconstrained_gain: FloatArray
    bounds: FloatArray
    axles: NDArray[np.int8]
    gram: FloatArray
    slack_price: float
    inverse_slack_weight: float
    iterations: int
    prepared: CStruct = field(init=False, repr=False)

    def __post_init__(self) -> None:
        """Check the arrays and hand them to C."""
        (n, rows), (values, inputs) = self.columns.shape, self.linear_term_gain.shape
        moves, travels = n - _AXLES, rows // 2
        require(0 < moves <= _MOST_MOVES and rows == 2 * travels, "Moves, and two limits of each deflection")
        require(self.H.shape == (n, n) and len(self.low) == len(self.high) == n, "A number for each unknown")
        fits = self.unconstrained_gain.shape == (values, inputs) and self.gram.shape == (values, values)
        require(fits and values == moves + travels, "Every move and deflection by every input")
        require(len(self.bounds) == len(self.axles) == values, "A bound and an axle for each move and deflection")
        require(bool((self.axles < _AXLES).all()), "There are two axles")
        arrays = self.H, self.columns, self.low, self.high, self.linear_term_gain, self.unconstrained_gain
        by_value = self.bounds, self.axles, self.gram
        numbers = self.slack_price, self.inverse_slack_weight, self.iterations
        object.__setattr__(self, "prepared", _prepare_qp.prepare(moves, travels, inputs, *arrays, *by_value, *numbers))

    @property
    def moves(self) -> int:
        """Forces to be found."""
        return len(self.H) - _AXLES


class QpMemory:
    """The memory in which the QPs of a run are solved, one after another, as `struct qp_run` of kernel/qp.c has it.

    Args:
        design: Of a driving stage: those of all stages are of one size.
        allowed: About the time that all of them may take [s].

    Attributes:
        counts: How many were solved, the time they took [s], that allowed [s], the largest slack [m] (4,).
        f: Linear term (n,).
        b: Right side (rows of A,).
        y: The answer (n,).
        multipliers: Of the box, then of A y <= b: positive at an upper limit, negative at a lower one (n + rows,).
    """

    def __init__(self, design: QpDesign, allowed: float) -> None:
        n, rows = self._size = design.columns.shape
        self.counts = np.array([0.0, 0.0, allowed, 0.0])
        self.f, self.b, self.y, self.multipliers = (np.zeros(length) for length in (n, rows, n, n + rows))
        work = np.empty(n + rows), np.empty(_DUAL_BYTES, dtype=np.uint8)
        self.prepared = _prepare_qp_run.prepare(self.counts, self.f, self.b, self.y, self.multipliers, *work)
        self._force = np.empty(_FORCES)

    def both(self, design: QpDesign, inputs: int) -> tuple[CStruct, CStruct]:
        """Return those of a driving stage and this, for C.

        Raises:
            ValueError: Sizes disagree, also with the number of the law's inputs.
        """
        fits = design.columns.shape == self._size and design.linear_term_gain.shape[1] == inputs
        require(fits, "A law, its QP and its memory of one size")
        return design.prepared, self.prepared

    def pose(self, design: QpDesign, inputs: FloatArray) -> None:
        """Fill f and b for the control step in which the law has these inputs."""
        _pose_qp(*self.both(design, len(inputs)), inputs)

    def solve_in_c(self, design: QpDesign, inputs: FloatArray) -> FloatArray | None:
        """Return the optimal forces (2,) [N] then, with f, b, y and multipliers; None without a proven answer."""
        return self._force if _solve_qp(*self.both(design, len(inputs)), inputs, self._force) else None

    def residual(self, design: QpDesign) -> float:
        """Return the largest violation of the KKT conditions by f, b, y and multipliers.

        Of limits it is in kN and cm, of the others relative; NaN or infinity for an answer that is not finite. For a
        strictly convex QP zero means optimal (Boyd and Vandenberghe 2004, 5.5.3). Each row of the gradient is judged by
        its own linear term: a slack's price, a thousand times a force's, would excuse any force.
        """
        violation: float = _residual(*self.both(design, design.linear_term_gain.shape[1]))
        return violation


Qp = tuple[QpDesign, QpMemory]  # a driving stage's, and the memory of its run
