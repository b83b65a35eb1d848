"""Responses from road to signals, modes, margins and spectra of strategies in one driving stage.

docs/explanation/frequencies.md has the method. The road is height exp(jωt) under the front axle, and under the rear
one the wheelbase later, or at the same instant (`road.rear_axle`). In the steady state the samples of the loop have
that frequency alone; a force that is held for a step h has there its fundamental, (1 - exp(-jωh)) / (jωh) of the
samples' (Franklin, Powell and Workman, Digital Control of Dynamic Systems, 3rd ed., section 5.4), and so has every
signal of the linear car.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import inf, pi

import numpy as np

from sim_core.arrays import FloatArray
from sim_core.blas import single_threaded
from sim_core.control.controller import Controller
from sim_core.errors import RidelabError
from sim_core.frequency.margins import Margins, divided, margins
from sim_core.frequency.sampled_loop import (
    ComplexArray,
    NotLinearError,
    SampledLoop,
    preview_command,
    previewed,
    sampled_loop,
    stage_law,
)
from sim_core.matrices import gauss_legendre
from sim_core.metrics.comfort import wk_gain
from sim_core.road.profile import height_density
from sim_core.scenario import Scenario
from sim_core.simulate import on_dummy_road, prepare
from sim_core.vehicle.half_car import OUTPUTS, STATES, half_car
from sim_core.vehicle.plant import continuous_plant, discretised_plant

RESPONSES = OUTPUTS
BANDS = ((1.0, 2.0), (4.0, 8.0), (10.0, 12.0))  # body, the passengers' most sensitive range, wheels [Hz]
DEFAULT_FREQUENCIES = tuple(np.geomspace(0.3, 30, 200).tolist())
_NODES, _NODE_WEIGHTS = gauss_legendre(24)  # in each part of a band
NEGLIGIBLE = 1e-6  # a mode with a smaller eigenvalue has died out after one control step


@dataclass(frozen=True, slots=True, kw_only=True)
class Mode:
    """A mode exp(s·t), one of a conjugate pair.

    Attributes:
        natural_frequency: |s| / 2π [Hz].
        damping_ratio: -Re(s) / |s| [1]; below 0 it grows.
    """

    natural_frequency: float
    damping_ratio: float


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class FrequencyResult:
    """A strategy's loop in one stage.

    Attributes:
        stage: Driving stage, whose weights hold.
        speed: At which it is driven [m/s].
        modes: Of the closed loop, slowest first; none where there is no linear law.
        responses: Per metre of road height, by signal (frequencies,); none where there are none.
        margins: Of the loop, broken where the command leaves the controller; none without one.
        psd: One-sided spectra on the scenario's road by signal (frequencies,) [unit²/Hz], and of the acceleration as
            Wk weighs it, `weighted_body_acceleration`; none on a measured road.
        bands: RMS on that road in each of `BANDS`, by signal (3,).
        reason: Why something is not there.
    """

    stage: str
    speed: float
    modes: tuple[Mode, ...] | None = None
    responses: dict[str, ComplexArray] | None = None
    margins: Margins | None = None
    psd: dict[str, FloatArray] | None = None
    bands: dict[str, FloatArray] | None = None
    reason: str | None = None


@single_threaded
def frequency_response(
    scenario: Scenario,
    strategy: str | type[Controller] | Controller,
    frequencies: Sequence[float] = DEFAULT_FREQUENCIES,
    outputs: Sequence[str] = RESPONSES,
    stage: str = "cruise",
) -> FrequencyResult:
    """Return what a strategy does at each frequency while no limit binds.

    Inside are the held force, the actuator's lag, the estimator, an ECU's delay and the preview; not noise, converters,
    the limits of forces. In stage `bump` a car that brakes for it is driven at the target speed, else at its first one.

    Args:
        scenario: Its vehicle, road, mismatch and speeds.
        strategy: Its id, a controller's class, or an object of it.
        frequencies: [Hz], above 0.
        outputs: Of `RESPONSES`.
        stage: cruise, brake or bump.

    Raises:
        UnknownNameError: No such strategy.
        RidelabError: The vehicle and weights admit no stabilising controller, or there is no such output.

    Example:
        >>> from sim_core import Scenario
        >>> result = frequency_response(Scenario(), "passive", [0.01])
        >>> round(float(abs(result.responses["front_tyre_load"][0])), 1)  # [N/m]: the car follows a long wave
        3.5
    """
    if unknown := set(outputs) - set(RESPONSES):
        raise RidelabError(f"There is no response of {', '.join(sorted(unknown))}")
    run, vehicle = prepare(on_dummy_road(scenario), strategy), scenario.real_vehicle
    planned = run.plan == "planned" and stage == "bump"
    speed = min(scenario.speed.initial, scenario.speed.target) if planned else scenario.speed.initial
    try:
        if not vehicle.linear:
            raise NotLinearError(
                "The car is not linear: unequal dampers, damper curves, bump stops or a tyre that can lift off"
            )
        loop = sampled_loop(run, stage_law(run, stage), vehicle, speed)
    except NotLinearError as error:
        return FrequencyResult(stage=stage, speed=speed, reason=str(error))
    own = modes(loop.closed, loop.step)
    if np.abs(np.linalg.eigvals(loop.closed)).max() >= 1:
        return FrequencyResult(stage=stage, speed=speed, modes=own, reason="The loop is unstable: no motion is steady")
    nodes, weights = _band_nodes(loop)
    together = np.concatenate([np.asarray(frequencies, dtype=np.float64), nodes])
    every = dict(zip(RESPONSES, _responses(loop, 2 * pi * together).T, strict=True))
    count = len(frequencies)
    result = FrequencyResult(
        stage=stage,
        speed=speed,
        modes=own,
        responses={name: every[name][:count] for name in outputs},
        margins=margins(loop) if run.controller.actuated else None,
    )
    if scenario.road.profile is not None:
        return replace(result, reason="A measured road has no class, so no spectrum of its height is known")
    density = height_density(scenario.road.roughness, together / speed) / speed  # of the height over frequency [m²/Hz]
    psd = {name: np.abs(every[name]) ** 2 * density for name in outputs}
    if "body_acceleration" in psd:
        psd["weighted_body_acceleration"] = psd["body_acceleration"] * wk_gain(together) ** 2
    bands = {name: np.sqrt(weights @ values[count:]) for name, values in psd.items()}
    return replace(result, psd={name: values[:count] for name, values in psd.items()}, bands=bands)


def passive_modes(scenario: Scenario) -> tuple[Mode, ...]:
    """Return the modes of the real car by itself, with the mean of unequal dampers."""
    return _modes(np.linalg.eigvals(half_car(scenario.real_vehicle).A).astype(np.complex128))


def modes(closed: FloatArray, step: float) -> tuple[Mode, ...]:
    """Return the modes of z' = closed·z over a step [s]; what is gone after a step is left out."""
    eigenvalues = np.linalg.eigvals(closed).astype(np.complex128)
    return _modes(np.asarray(np.log(eigenvalues[np.abs(eigenvalues) > NEGLIGIBLE]) / step, dtype=np.complex128))


def _modes(poles: ComplexArray) -> tuple[Mode, ...]:
    size = np.abs(poles)
    oscillating = sorted(
        (float(a), float(-s.real / a)) for s, a in zip(poles, size, strict=True) if s.imag >= 0 and a > 0
    )
    return tuple(Mode(natural_frequency=a / (2 * pi), damping_ratio=ratio) for a, ratio in oscillating)


def _responses(loop: SampledLoop, omega: FloatArray) -> ComplexArray:
    """Return the response of all outputs per metre of road height (frequencies, 6)."""
    car, outputs = continuous_plant(loop.vehicle, loop.run.actuator), half_car(loop.vehicle)
    s, h, size = 1j * omega, loop.step, len(loop.within)
    behind = loop.run.scenario.rear_axle_offset
    velocity = s[:, None] * np.stack([np.ones_like(s), np.exp(-s * behind / loop.speed)], 1)
    resolvent = s[:, None, None] * np.eye(car.size) - car.A
    road = velocity @ car.E[:, :2].T
    causes = np.concatenate([road[..., None], np.broadcast_to(car.B, (len(s), *car.B.shape))], axis=2)
    solved: ComplexArray = np.asarray(np.linalg.solve(resolvent, causes), np.complex128)
    of_road, of_command = solved[..., 0], solved[..., 1:]
    feed = preview_command(loop, omega)
    forcing = np.zeros((len(omega), len(loop.A)), dtype=np.complex128)
    forcing[:, :size] = _road_in_step(loop, omega, of_road)
    forcing += feed @ (loop.B + loop.C).T
    z = np.linalg.solve(np.exp(s * h)[:, None, None] * np.eye(len(loop.A)) - loop.closed, forcing[..., None])[..., 0]
    command = z[:, size : size + 2] if loop.run.controller.delayed else z @ loop.K.T + feed
    held = command * ((1 - np.exp(-s * h)) / (s * h))[:, None]
    x = of_road + (of_command @ held[..., None])[..., 0]
    forces = x[:, STATES:] if car.size > STATES else held
    return np.asarray(x[:, :STATES] @ outputs.C.T + forces @ outputs.D.T)


def _road_in_step(loop: SampledLoop, omega: FloatArray, of_road: ComplexArray) -> ComplexArray:
    """Return what the road adds to filter and car in one control step (frequencies, 8 + n or n).

    From rest a car under a steady motion X exp(jωt) gets (exp(jωh) - Φ) X in a step h, exactly.
    """
    h = loop.step / loop.short
    turn = np.exp(1j * omega * h)[:, None]
    within = discretised_plant(loop.vehicle, loop.run.actuator, h)
    added = turn * of_road - of_road @ within.A.T
    if loop.filtered is None:
        return np.asarray(added)
    from_preview, from_sensors = loop.filtered
    seen = previewed(loop, loop.run.filter_preview, omega, 1)[:, :, 0] @ from_preview.T
    over = np.zeros((len(omega), len(loop.within)), dtype=np.complex128)
    for i in range(loop.short):
        now = added * turn**i
        over = over @ loop.within.T + np.hstack([now @ from_sensors.T + seen, now])
    return np.asarray(over)


def _band_nodes(loop: SampledLoop) -> tuple[FloatArray, FloatArray]:
    """Return frequencies [Hz] (n,) and weights [Hz] (bands, n) whose sums are integrals of spectra over each band.

    A band is divided until none of its parts is longer than 1.5 times the distance from its middle to the loop's
    nearest pole: Gauss's formula then resolves a peak, however weakly damped it is.
    """
    eigenvalues = np.linalg.eigvals(loop.closed).astype(np.complex128)
    poles = np.log(eigenvalues[np.abs(eigenvalues) > NEGLIGIBLE]) / (2j * pi * loop.step)  # [Hz]
    nodes, weights = [], []
    for band, edges in enumerate(BANDS):
        parts = divided(np.array(edges), lambda f: 1.5 * np.abs(f[:, None] - poles).min(axis=1, initial=inf))
        half = np.diff(parts)[:, None] / 2
        nodes.append((parts[:-1, None] + half * (1 + _NODES)).ravel())
        weights.append(np.outer(np.arange(len(BANDS)) == band, half * _NODE_WEIGHTS))
    return np.concatenate(nodes), np.hstack(weights)
