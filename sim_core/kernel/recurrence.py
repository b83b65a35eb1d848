"""x[i + 1] = M x[i] + f[i] over many steps, by the C of kernel/recurrence.c."""

from sim_core.arrays import FloatArray
from sim_core.kernel.library import ADDRESS, INT, address, function

_recurrence = function("recurrence", ADDRESS, INT, INT, ADDRESS)


def run_recurrence(matrix: FloatArray, states: FloatArray) -> None:
    """Fill `states` in place.

    Args:
        matrix: M (n, n).
        states: x[0], then the inputs f[0], f[1], …, which become x[1], x[2], … (steps + 1, n).

    Raises:
        ValueError: The shapes differ, or an array is not contiguous.
    """
    n = states.shape[1]
    if matrix.shape != (n, n):
        raise ValueError("A recurrence needs a square matrix as wide as its states")
    _recurrence(address(matrix), n, len(states) - 1, address(states))
