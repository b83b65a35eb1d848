"""Margins: against python-control and SLICOT, and against what they promise."""

from math import inf, pi
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from scipy.linalg import matrix_balance
from scipy.signal import cont2discrete, zpk2ss

from sim_core import FloatArray
from sim_core.frequency.margins import margins
from sim_core.frequency.sampled_loop import SampledLoop
from sim_core.strategies import STRATEGIES
from tests.there import there
from tests.validation.strategies import some
from tests.validation.test_frequency import loop_of

LINEAR = [name for name, strategy in STRATEGIES.items() if strategy.actuated]
SOFT = {"vehicle": {"front_damping": 500, "rear_damping": 500}, "hook": {"groundhook_damping": 4000}}


NARROW = "groundhook", SOFT, {"disk": 0.10015}  # a peak some hundredths of a hertz wide, at 1.48 Hz
PAIR = "lv", {"actuator": {"bandwidth": 8}, "speed": {}}, {"phase": 1.0734, "delay": 1.0504}  # the gain is just above 1


@pytest.mark.parametrize(("strategy", "parts", "expected"), [NARROW, PAIR])
def test_narrow_peaks_and_near_pairs_of_crossings_are_found(
    strategy: str, parts: dict[str, Any], expected: dict[str, float]
) -> None:
    """To four digits of a grid of 40,000 frequencies."""
    judged = margins(loop_of(strategy, **parts))
    ours = {"disk": judged.disk, "phase": judged.front.phase, "delay": judged.front.delay}
    assert {name: ours[name] for name in expected} == pytest.approx(expected, rel=1e-4)


def car(number: int) -> dict[str, Any]:
    """Return the number-th random car, some with a lag, a filter or an ECU's mistaken car, as parts of a scenario."""
    generator = np.random.default_rng(number)

    def drawn(low: float, high: float) -> float:
        return float(np.exp(generator.uniform(np.log(low), np.log(high))))

    axles = {"wheel_mass": (20, 150), "spring": (1e4, 6e4), "damping": (200, 1e4), "tyre_stiffness": (1e5, 5e5)}
    vehicle = {f"{axle}_{name}": drawn(*limits) for name, limits in axles.items() for axle in ("front", "rear")}
    vehicle |= {"body_mass": drawn(300, 2500), "pitch_inertia": drawn(400, 4000)}
    vehicle |= {"cg_to_front": drawn(0.8, 2), "cg_to_rear": drawn(0.8, 2.5)}
    parts: dict[str, Any] = {"vehicle": vehicle, "hil": {"bits": 24}}
    parts["hook"] = {"skyhook_damping": drawn(500, 1e4), "groundhook_damping": drawn(200, 1e4)}
    optional = {
        "actuator": {"bandwidth": drawn(3, 60)},
        "estimation": {"kind": "kalman"},
        "mismatch": {"body_mass": drawn(0.7, 1.4), "damping": drawn(0.5, 1.5)},
    }
    return parts | {name: part for name, part in optional.items() if generator.random() < 0.4}


@pytest.mark.parametrize("number", some(1, range(200)))
def test_python_control_has_the_same_margins(number: int) -> None:
    """Its disk margin of both loops (by SLICOT's structured singular value) to 1e-4 and its margins of each to 1e-3.

    Its grids are refined around what they find; its splines between their points still miss some crossings by 3e-4.
    """
    stable = [loop for name in LINEAR if largest(loop := loop_of(name, **car(number)), np.ones(2)) < 1]
    assert stable
    for loop in stable:
        judged = margins(loop)
        assert judged.disk == pytest.approx(their_disk(loop), rel=1e-4)
        for axle, one in enumerate((judged.front, judged.rear)):
            ours = [one.gain or inf, one.gain_reduction or 0, one.phase or inf, one.delay or inf]
            assert ours == pytest.approx(their_margin(loop, axle), rel=1e-3), (number, axle)


def frequencies(loop: SampledLoop) -> FloatArray:
    """Return angular frequencies over the whole range, closest around the loop's modes [rad/s]."""
    modes = np.linalg.eigvals(loop.closed)
    around = np.abs(np.angle(modes))[:, None] + (1 - np.abs(modes))[:, None] * np.linspace(-4, 4, 81)
    everywhere = np.concatenate([np.linspace(1e-7, pi - 1e-7, 600), np.geomspace(1e-7, 3, 400), around.ravel()])
    return distinct(everywhere[(everywhere >= 1e-7) & (everywhere <= pi - 1e-7)] / loop.step)


def distinct(frequencies: FloatArray) -> FloatArray:
    """Return them in order, without those that python-control's splines would take for one."""
    ordered = np.unique(frequencies)
    return ordered[np.diff(ordered, prepend=0) > 1e-9 * ordered]


def balanced(A: FloatArray, B: FloatArray, C: FloatArray, step: float) -> Any:
    """Return python-control's system with states scaled for SLICOT, which loses half of its digits without."""
    import control

    scaled, scale = matrix_balance(A, permute=False)
    return control.ss(scaled, np.linalg.solve(scale, B), C @ scale, np.zeros((len(C), B.shape[1])), step)


def their_disk(loop: SampledLoop) -> float:
    import control

    both = balanced(loop.A + loop.C @ loop.K, loop.B, -loop.K, loop.step)
    grid, spread = frequencies(loop), np.linspace(-1, 1, 21)
    for _ in range(4):
        disks = control.disk_margins(both, grid, returnall=True)[0]
        beside = np.pad(disks, 1, constant_values=inf)
        lowest = (disks <= beside[:-2]) & (disks <= beside[2:]) & (disks < 1.3 * disks.min())
        around = grid[lowest, None] + np.gradient(grid)[lowest, None] * spread
        least, grid = float(disks.min()), np.unique(np.clip(around, grid[0], grid[-1]))
    return least


def their_margin(loop: SampledLoop, axle: int) -> list[float]:
    """Return gain and gain reduction [1], phase [rad] and delay [s] of an axle's loop; inf or 0 where there is none."""
    import control

    other = np.diag([axle, 1 - axle])
    one = balanced(loop.A + (loop.C + loop.B @ other) @ loop.K, loop.B[:, [axle]], -loop.K[[axle]], loop.step)
    grid, spread = frequencies(loop), np.linspace(-1, 1, 21)
    for width in (0.01, 1e-3, 1e-4, 1e-5):
        measured = control.frd(one, grid, smooth=True)
        _, phases, _, real, crossover, _ = control.stability_margins(measured, returnall=True)
        around = np.concatenate([real, crossover])[:, None] * (1 + width * spread)
        grid = distinct(np.append(grid, around[around < pi / loop.step]))
    at_real = np.array([one(1), one(-1), *one(np.exp(1j * real * loop.step))])  # at both ends, too, the gain is real
    gains = -1 / at_real.real[(at_real.real < 0) & (np.abs(at_real.imag) < 1e-3 * np.abs(at_real.real))]
    lags = np.radians(np.mod(phases, 360))
    return [
        min(gains[gains > 1], default=inf),
        max(gains[gains < 1], default=0),
        min(np.radians(np.abs(phases)), default=inf),
        min(lags / crossover, default=inf),
    ]


def test_of_two_smaller_gains_that_meet_instability_the_nearer_one_is_the_margin() -> None:
    """A front loop that is stable with a ten thousandth of its gain too, and not in between."""
    continuous = zpk2ss([-10, -10], [-0.01, -1, -1, -300, -300], 1e7)
    A, B, C, _, _ = cont2discrete(continuous, 1e-3)
    nothing = np.zeros((5, 1))
    loop = plain(A, np.hstack([B, nothing]), -np.vstack([C, nothing.T]))
    bound = there(margins(loop).front.gain_reduction)
    assert [largest(loop, on_axle(0, factor)) < 1 for factor in (1, bound * 1.001, bound / 1.001, 1e-4)] == [
        *(True, True, False, True),
    ]


def test_the_disk_margin_of_two_delayed_gains() -> None:
    """k / z is nearest to -1 at z = -1, where its gain meets instability: the disk's factor is the smaller 1 / k."""
    judged = margins(plain(np.zeros((2, 2)), np.eye(2), -np.diag([0.5, 0.8])))
    assert (judged.front.gain, judged.rear.gain, judged.disk_gain) == pytest.approx((2, 1.25, 1.25))
    assert (judged.disk, judged.disk_phase) == pytest.approx((2 / 9, 2 * np.arctan(1 / 9)))


@pytest.mark.parametrize("pole", [1.0, -1.0])
def test_a_loop_with_an_integrator_has_margins(pole: float) -> None:
    """k / (z ∓ 1) is unstable beyond k = 2 at the other end of the circle, where its gain is real."""
    judged = margins(plain(pole * np.eye(2), np.eye(2), -pole * np.diag([0.5, 0.8])))
    assert (judged.front.gain, judged.rear.gain) == pytest.approx((4, 2.5))
    assert (judged.front.gain_reduction, judged.rear.gain_reduction) == (None, None)
    assert judged.disk_gain == pytest.approx(2.5)


def plain(A: FloatArray, B: FloatArray, K: FloatArray) -> Any:
    """Return a loop whose controller remembers nothing, z' = A z + B v and u = K z, sampled at 1 kHz."""
    return SimpleNamespace(A=A, B=B, C=np.zeros_like(B), K=K, closed=A + B @ K, step=1e-3)


def on_axle(axle: int, factor: complex) -> Any:
    change = np.ones(2, dtype=np.complex128)
    change[axle] = factor
    return change


def largest(loop: SampledLoop, change: Any) -> float:
    return float(np.abs(np.linalg.eigvals(loop.A + (loop.C + loop.B * change) @ loop.K)).max())
