"""Random closed loops of LV and nonlinear cars, and how far their metrics are from an adaptive solver's."""

from collections.abc import Iterator
from itertools import count
from typing import get_args

from numpy.random import Generator, default_rng

from sim_core.errors import RidelabError
from sim_core.frequency.stability import least_damping
from sim_core.scenario import Actuator, Bump, Estimation, Mismatch, Mpc, Road, Scenario, Speed, Vehicle
from sim_core.scenario.parts import Preview
from sim_core.simulate import simulate
from tests.results import metrics
from tests.validation.reference.adaptive_loop import solved

RMS, PEAK = 0.01, 0.02  # what the metrics of such a loop may be off by
_SHAPES = ("cosine", "half_sine", "trapezoid", "flat_top", "kerb")
_CAR = {
    "body_mass": (300, 2500),
    "pitch_inertia": (400, 4000),
    "cg_to_front": (0.8, 2),
    "cg_to_rear": (0.8, 2.5),
    "cg_height": (0.3, 1),
    "rebound_ratio": (0.3, 4),
    "bump_stop_stiffness": (5e4, 5e5),
    "anti_dive": (-0.5, 1.5),
    "anti_lift": (-0.5, 1.5),
    "front_brake_share": (0.5, 0.9),
}
for _axle in ("front", "rear"):
    _CAR |= {f"{_axle}_wheel_mass": (20, 150), f"{_axle}_spring": (1e4, 6e4), f"{_axle}_damping": (500, 1e4)}
    _CAR |= {f"{_axle}_tyre_stiffness": (1e5, 5e5)}


def loop(seed: int) -> Scenario:
    """Any car, road, limits, preview, actuators and sensors of the sliders' ranges."""
    draw = default_rng([11, seed])

    def some(share: float, low: float, high: float) -> float | None:
        return _between(draw, low, high) if draw.random() < share else None

    drawn: dict[str, float | None] = {name: _between(draw, *ends) for name, ends in _CAR.items()}
    drawn["bump_stop_clearance"] = some(0.8, 0.02, 0.12)
    vehicle = Vehicle.model_validate({**drawn, "tyre_lift_off": bool(draw.random() < 0.8)})
    bump = Bump(
        start=50,
        height=_between(draw, -0.15, 0.2),
        width=_between(draw, 0.5, 8),
        shape=_SHAPES[draw.integers(len(_SHAPES))],  # type: ignore[arg-type]
    )
    return Scenario(
        vehicle=vehicle,
        road=Road(roughness=float(draw.choice([16e-6, 64e-6, 256e-6, 1024e-6])), length=90, seed=seed, bump=bump),
        speed=Speed(
            initial_speed_kmh=_between(draw, 15, 90),
            target_speed_kmh=_between(draw, 8, 50),
            detection_distance=_between(draw, 10, 50),
        ),
        actuator=Actuator(bandwidth=some(0.3, 2, 50), rate_limit=some(0.2, 1e4, 5e5), saturation=some(0.2, 500, 1e4)),
        mpc=Mpc(
            sample_time=float(draw.choice([0.005, 0.01, 0.02])),
            prediction_horizon=int(draw.integers(20, 41)),
            control_horizon=int(draw.integers(5, 21)),
            preview=get_args(Preview)[draw.integers(3)],
            deflection_limit=_between(draw, 0.03, 0.15),
            force_limit=_between(draw, 500, 1e4),
            deflection_weight=_between(draw, 0, 10),
        ),
        mismatch=Mismatch(damping=some(0.3, 0.6, 1.4) or 1.0, body_mass=some(0.3, 0.8, 1.2) or 1.0),
        estimation=Estimation(kind="kalman" if draw.random() < 0.2 else "exact"),
    )


def stable_loops() -> Iterator[tuple[int, Scenario]]:
    """Seed and scenario of those that come to rest: in the others every difference grows, however small."""
    for seed in count():
        scenario = loop(seed)
        try:
            damping = least_damping(scenario, "lv")
        except RidelabError:  # no controller, or no filter
            continue
        if damping is not None and damping > 0:
            yield seed, scenario


def errors(scenario: Scenario, strategy: str = "lv") -> dict[str, float]:
    """How far each metric is from that of the solver's loop, relative."""
    ours, theirs = metrics(simulate(scenario, strategy)), metrics(solved(scenario, strategy))
    return {
        key: ours[key] / value - 1
        for key, value in theirs.items()
        if abs(value) > 1e-9 and not key.startswith("comfort")
    }


def worst(errors: dict[str, float]) -> tuple[float, float]:
    """Of RMS values and of peaks, in size."""
    peaks = [abs(error) for key, error in errors.items() if key.endswith("peak")]
    others = [abs(error) for key, error in errors.items() if not key.endswith("peak")]
    return max(others), max(peaks)


def _between(draw: Generator, low: float, high: float) -> float:
    return float(draw.uniform(low, high))
