"""x[i + 1] = M x[i] + f[i] over many steps at once.

Steps are taken in groups: what a group's own inputs do is one matrix product for all groups, the states between groups
are prefix sums with doubling strides (Hillis and Steele 1986), and what those do is one product again.
"""

from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray

_GROUP = 8  # steps; fewer make longer prefix sums, more make larger products


@dataclass(frozen=True, slots=True, eq=False)
class Recurrence:
    """A linear recurrence, prepared; everything transposed, as states are rows.

    Attributes:
        own: Inputs of a group's steps to the states after each (group · n, group · n).
        onward: The state before a group to the states after each of its steps (n, group · n).
        strides: Powers group, 2 group, 4 group, … of M (n, n).
    """

    own: FloatArray
    onward: FloatArray
    strides: tuple[FloatArray, ...]

    def run(self, start: FloatArray, inputs: FloatArray) -> FloatArray:
        """All states (steps + 1, n), the first being `start` (n,), for inputs (steps, n)."""
        steps, n = inputs.shape
        groups = -(-steps // _GROUP)
        if steps < groups * _GROUP:
            inputs = np.concatenate([inputs, np.zeros((groups * _GROUP - steps, n))])
        states = np.empty((groups * _GROUP + 1, n))
        states[0] = start
        after = states[1:].reshape(groups, -1)
        np.matmul(inputs.reshape(groups, -1), self.own, out=after)
        before = np.empty((groups, n))
        before[0], before[1:] = start, after[:-1, -n:]
        stride = 1
        for power in self.strides:
            if stride >= groups:
                break
            before[stride:] += before[:-stride] @ power
            stride *= 2
        after += before @ self.onward
        return states[: steps + 1]


def recurrence(matrix: FloatArray, most_steps: int) -> Recurrence:
    """Prepare x[i + 1] = matrix · x[i] + f[i] for runs of at most so many steps."""
    n = len(matrix)
    powers = [np.eye(n)]
    for _ in range(_GROUP):
        powers.append(powers[-1] @ matrix.T)
    own = np.zeros((_GROUP, n, _GROUP, n))
    for first in range(_GROUP):
        own[first, :, first:] = np.stack(powers[: _GROUP - first], axis=1)
    strides = [powers[_GROUP]]
    while _GROUP << len(strides) < most_steps:
        strides.append(strides[-1] @ strides[-1])
    return Recurrence(own.reshape(_GROUP * n, -1), np.hstack(powers[1:]), tuple(strides))
