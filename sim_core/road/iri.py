"""International Roughness Index of a wheel track: a quarter car drives over it (ASTM E1926).

docs/explanation/road.md has the formulas.
"""

import numpy as np

from sim_core.arrays import FloatArray

SPEED = 80 / 3.6  # [m/s]
BASE = 0.25  # slopes are taken over so much of the track, as a tyre bridges it [m]
START = 11.0  # the car starts with the mean slope of so much of the track [m]
_K1, _K2, _C, _MU = 653.0, 63.3, 6.0, 0.15  # tyre, spring, damper, unsprung mass, each by the sprung mass


def golden_car() -> tuple[FloatArray, FloatArray]:
    """Return the quarter car's dx/dt = A x + b s: A (4, 4) and b (4,), with s the slope of the road.

    x holds the slopes of the paths of body and wheel and their rates: z_s', z_s'', z_u', z_u'' (Sayers 1995).
    """
    system = np.array(
        [[0, 1, 0, 0], [-_K2, -_C, _K2, _C], [0, 0, 0, 1], [_K2 / _MU, _C / _MU, -(_K1 + _K2) / _MU, -_C / _MU]]
    )
    return system, np.array([0, 0, 0, _K1 / _MU])


def exact_step(spacing: float) -> tuple[FloatArray, FloatArray]:
    """Return the car's x after `spacing` [m] of constant slope s is S x + p s: S (4, 4) and p (4,)."""
    system, entry = golden_car()
    from scipy.linalg import expm  # takes a third of a second: most processes never need it

    step = np.asarray(expm(system * spacing / SPEED))
    return step, np.asarray(np.linalg.solve(system, (step - np.eye(4)) @ entry))


def iri(height: FloatArray, spacing: float) -> float:
    """The index [m/km] of heights (n,) [m] so far apart [m]: the mean speed of the suspension by the car's speed.

    Slopes are those of the moving mean over `BASE`, which heights 1/6 m and further apart go without.

    Example:
        >>> x = np.arange(0, 1000, 0.05)
        >>> round(iri(0.001 * np.sin(2 * np.pi * x / 2), 0.05), 3)  # 1 mm high, 2 m long
        3.084

    Raises:
        ValueError: The track is shorter than `BASE`.
    """
    base = max(1, int(BASE / spacing + 0.5))
    if len(height) <= base:
        raise ValueError("the track is shorter than the base of a slope")
    slope = (height[base:] - height[:-base]) / (base * spacing)
    first = min(round(START / spacing), len(height) - 1)
    start = (height[first] - height[0]) / (first * spacing)
    from scipy.signal import lfilter  # takes a third of a second: most processes never need it

    step, entry = exact_step(spacing)
    eigenvalues, modes = np.linalg.eig(step)
    inputs = np.linalg.solve(modes, entry)
    begins = np.linalg.solve(modes, start * np.array([1, 0, 1, 0]))
    stroke = np.zeros(len(slope), dtype=complex)
    for value, enters, begin, mode in zip(eigenvalues, inputs, begins, modes.T, strict=True):
        motion, _ = lfilter([1], [1, -value], enters * slope, zi=[value * begin])
        stroke += (mode[0] - mode[2]) * motion
    return 1000 * float(np.abs(stroke.real).mean())
