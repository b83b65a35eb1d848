"""The C's functions of a predictive controller's QPs (kernel/qp.c)."""

import numpy as np
from numpy.typing import NDArray

from sim_core.arrays import FloatArray
from sim_core.kernel.library import DOUBLE, INT, Array, Function, Prepared, require

_FORCES, _AXLES = 2, 2
_MOST_MOVES = 200  # that C has memory for
_LINE, _TABLE, _LINE_OUT = Array(ndim=1), Array(ndim=2), Array(ndim=1, written=True)
_DUAL_BYTES: int = Function("dual_bytes", result=INT)()
_prepare_qp = Function(
    "prepare_qp",
    *(INT, INT, INT, _TABLE, _TABLE, _LINE, _LINE, _TABLE, _TABLE, _LINE, Array(ndim=1, dtype=np.int8), _TABLE),
    *(DOUBLE, DOUBLE, INT, DOUBLE, DOUBLE),
)
_prepare_qp_run = Function(
    "prepare_qp_run", Array(4, written=True), *[_LINE_OUT] * 5, Array(_DUAL_BYTES, dtype=np.uint8, written=True)
)
_pose_qp = Function("pose_qp", Prepared, Prepared, _LINE)
_solve_qp = Function("solve_qp", Prepared, Prepared, _LINE, Array(_FORCES, written=True), result=INT)
_residual = Function("residual", Prepared, Prepared, result=DOUBLE)


class QpMatrices:
    """What all QPs of a driving stage share, as `struct qp` of kernel/qp.c has it.

    H (n, n), columns (n, rows), low and high (n,), by_inputs and optimum (values, inputs), bounds and axles (values,),
    gram (values, values); `rows` are two and `values` one for each deflection, and n - 2 values are moves.

    Raises:
        ValueError: Sizes disagree, or there are more moves than C has memory for.
    """

    def __init__(
        self,
        *,
        H: FloatArray,
        columns: FloatArray,
        low: FloatArray,
        high: FloatArray,
        by_inputs: FloatArray,
        optimum: FloatArray,
        bounds: FloatArray,
        axles: NDArray[np.int8],
        gram: FloatArray,
        slack_price: float,
        slack_yield: float,
        iterations: int,
        effort: float,
        effort_each: float,
    ) -> None:
        (n, rows), (values, inputs) = columns.shape, by_inputs.shape
        moves, travels = n - _AXLES, rows // 2
        require(0 < moves <= _MOST_MOVES and rows == 2 * travels, "Moves, and two limits of each deflection")
        require(H.shape == (n, n) and len(low) == len(high) == n, "A number for each unknown")
        fits = optimum.shape == by_inputs.shape and gram.shape == (values, values) and values == moves + travels
        require(fits and len(bounds) == len(axles) == values, "A bound and an axle for each move and deflection")
        require(bool((axles < _AXLES).all()), "There are two axles")
        arrays = H, columns, low, high, by_inputs, optimum, bounds, axles, gram
        numbers = slack_price, slack_yield, iterations, effort, effort_each
        self.prepared = _prepare_qp.prepare(moves, travels, inputs, *arrays, *numbers)
        self.size, self.inputs = (n, rows), inputs


class QpMemory:
    """What the QPs of a run are reckoned in, one after another, as `struct qp_run` of kernel/qp.c has it.

    counts (4,), f and y (n,), b (rows,), multipliers (n + rows,).

    Raises:
        ValueError: Sizes disagree.
    """

    def __init__(
        self, counts: FloatArray, f: FloatArray, b: FloatArray, y: FloatArray, multipliers: FloatArray
    ) -> None:
        n, rows = self._size = len(f), len(b)
        require(len(y) == n and len(multipliers) == n + rows, "A number for each unknown and limit")
        work = np.empty(n + rows), np.empty(_DUAL_BYTES, dtype=np.uint8)
        self.prepared = _prepare_qp_run.prepare(counts, f, b, y, multipliers, *work)
        self._force = np.empty(_FORCES)

    def both(self, matrices: QpMatrices, inputs: int) -> tuple[Prepared, Prepared]:
        """Those of a driving stage and this, for C.

        Raises:
            ValueError: Sizes disagree, also with the number of the law's inputs.
        """
        require(matrices.size == self._size and matrices.inputs == inputs, "A law, its QP and its memory of one size")
        return matrices.prepared, self.prepared

    def pose(self, matrices: QpMatrices, inputs: FloatArray) -> None:
        """Fill f and b for the control step in which the law has these inputs."""
        _pose_qp(*self.both(matrices, len(inputs)), inputs)

    def solve(self, matrices: QpMatrices, inputs: FloatArray) -> FloatArray | None:
        """The optimal forces (2,) [N] then, with f, b, y and multipliers; None without a proven answer."""
        return self._force if _solve_qp(*self.both(matrices, len(inputs)), inputs, self._force) else None

    def residual(self, matrices: QpMatrices) -> float:
        """The largest violation of the KKT conditions by what is in f, b, y and multipliers."""
        violation: float = _residual(*self.both(matrices, matrices.inputs))
        return violation
