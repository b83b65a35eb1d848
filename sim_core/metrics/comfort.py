"""ISO 2631-1 frequency weighting Wk of vertical acceleration, weighted RMS and vibration dose value."""

from dataclasses import dataclass
from math import pi, sqrt

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.caching import cached
from sim_core.kernel import binding
from sim_core.matrices import exponential

Quadratic = tuple[float, float, float]  # coefficients, highest power first
Quotient = tuple[Quadratic, Quadratic]  # numerator and denominator

# ISO 2631-1:1997, table A.1, principal weighting Wk: frequencies [Hz] and quality factors.
F1, F2, F3, F4, Q4, F5, Q5, F6, Q6 = 0.4, 100.0, 12.5, 12.5, 0.63, 2.37, 0.91, 3.35, 0.91
_BUTTERWORTH = 1 / sqrt(2)


def _resonance(frequency: float, quality: float) -> Quadratic:
    """s² + ω/Q s + ω²."""
    omega = 2 * pi * frequency
    return 1.0, omega / quality, omega**2


def wk_quotients() -> tuple[Quotient, ...]:
    """Wk(s) as quotients: both band limits, acceleration-velocity transition, upward step (ISO 2631-1, annex A)."""
    w2, w3, w4 = 2 * pi * F2, 2 * pi * F3, 2 * pi * F4
    return (
        ((1.0, 0.0, 0.0), _resonance(F1, _BUTTERWORTH)),
        ((0.0, 0.0, w2**2), _resonance(F2, _BUTTERWORTH)),
        ((0.0, w4**2 / w3, w4**2), _resonance(F4, Q4)),
        (_resonance(F5, Q5), _resonance(F6, Q6)),
    )


def wk_gain(frequency: FloatArray) -> FloatArray:
    """|Wk| at frequencies [Hz]."""
    s = 2j * pi * np.asarray(frequency)
    return np.asarray(np.abs(np.prod([np.polyval(b, s) / np.polyval(a, s) for b, a in wk_quotients()], axis=0)))


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class _Weighting:
    """Wk over a row of samples, straight between them: [state (8); samples] to the weighted samples but the last.

    From row to row the state is multiplied by `onward` (8, 8), and the samples add what `inputs` (samples, 8) gives.
    """

    outputs: FloatArray
    inputs: FloatArray
    onward: FloatArray


@cached
def _weighting(step: float, samples: int) -> _Weighting:
    """For rows of so many samples, `step` [s] apart."""
    A, B, C = _wk_states()
    n = len(A)
    ramp = np.zeros((n + 2, n + 2))  # the state, the input, and its change over the step
    ramp[:n, :n], ramp[:n, n], ramp[n, n + 1] = A, B, 1 / step
    over_step = exponential(ramp * step)[:n]
    state, seen = np.eye(n, n + samples), []
    for j in range(samples - 1):
        seen.append(C @ state)
        state = over_step[:, :n] @ state
        state[:, n + j] += over_step[:, n] - over_step[:, n + 1]
        state[:, n + j + 1] += over_step[:, n + 1]
    return _Weighting(
        outputs=np.ascontiguousarray(np.stack(seen).T),
        inputs=np.ascontiguousarray(state[:, n:].T),
        onward=np.ascontiguousarray(state[:, :n]),
    )


def _wk_states() -> tuple[FloatArray, FloatArray, FloatArray]:
    """Wk as x' = A x + B a, y = C x, its quotients one after another."""
    n = 2 * len(wk_quotients())
    A, B, C, through = np.zeros((n, n)), np.zeros(n), np.zeros(n), 1.0
    for i, ((b2, b1, b0), (_, a1, a0)) in enumerate(wk_quotients()):
        own = slice(2 * i, 2 * i + 2)
        A[own, own] = [[0.0, 1.0], [-a0, -a1]]
        A[2 * i + 1] += C  # what the quotients before it give
        B[2 * i + 1] = through
        C, through = b2 * C, b2 * through
        C[own] = b0 - b2 * a0, b1 - b2 * a1
    return A, B, C


def weighted(columns: FloatArray, step: float, samples: int) -> FloatArray:
    """So many samples of acceleration [m/s^2] through Wk, from rest; one after another within each column in turn.

    Args:
        columns: Samples `step` apart, straight in between, from one jump to the next (samples, columns): a column's
            last sample and the next one's first are at the same time.
        step: In s.
        samples: How many, from the first on.
    """
    weighting = _weighting(step, len(columns))
    n = len(weighting.onward)
    states = np.zeros((columns.shape[1], n))
    np.matmul(columns[:, :-1].T, weighting.inputs, out=states[1:])
    binding.recurrence(weighting.onward, states)
    through = states @ weighting.outputs[:n]
    through += columns.T @ weighting.outputs[n:]
    return through.reshape(-1)[:samples]


def vibration_dose(weighted_acceleration: FloatArray, step: float) -> float:
    """VDV = (∫ a_w⁴ dt)^¼ [m/s^1.75] (ISO 2631-1, 6.3.2)."""
    square = weighted_acceleration**2
    return float((np.dot(square, square) * step) ** 0.25)
