"""x[i + 1] = M x[i] + f[i] over many steps at once.

Steps are taken in groups: what a group's own inputs do is one matrix product for all groups, the states between groups
follow the same kind of recurrence with fewer steps, and what those do is one product again.
"""

from dataclasses import dataclass

import numpy as np

from sim_core.arrays import FloatArray

_GROUP = 8  # steps; fewer make more levels, more make larger products


@dataclass(frozen=True, slots=True, eq=False)
class Recurrence:
    """A linear recurrence, prepared; everything transposed, as states are rows.

    Attributes:
        own: Inputs of a group's steps to the states after each (group · n, group · n).
        onward: The state before a group to the states after each of its steps (n, group · n).
        groups: From group to group; None where one group is all.
    """

    own: FloatArray
    onward: FloatArray
    groups: "Recurrence | None"

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
        if self.groups is None or groups == 1:
            after += start @ self.onward
        else:
            after += self.groups.run(start, after[:-1, -n:]) @ self.onward
        return states[: steps + 1]


def recurrence(matrix: FloatArray, most_steps: int) -> Recurrence:
    """Prepare x[i + 1] = matrix · x[i] + f[i] for runs of at most so many steps."""
    n = len(matrix)
    powers = np.zeros((2 * _GROUP, n, n))  # of the transposed matrix from -_GROUP on, the negative ones being nothing
    powers[_GROUP] = np.eye(n)
    for i in range(_GROUP + 1, 2 * _GROUP):
        powers[i] = powers[i - 1] @ matrix.T
    step = np.arange(_GROUP)
    own = powers[_GROUP + step - step[:, None]].transpose(0, 2, 1, 3)
    onward = powers[_GROUP:] @ matrix.T
    groups = -(-most_steps // _GROUP)
    return Recurrence(
        own=own.reshape(_GROUP * n, -1),
        onward=onward.transpose(1, 0, 2).reshape(n, -1),
        groups=recurrence(onward[-1].T, groups - 1) if groups > 1 else None,
    )
