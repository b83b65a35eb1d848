"""Random cars, bumps and scenarios for property tests: the ranges people drag sliders over."""

import os
from collections.abc import Sequence
from typing import TypeVar

from hypothesis import strategies as st

from sim_core.scenario import Bump, Mpc, Road, Scenario, Speed, Vehicle

T = TypeVar("T")


def between(low: float, high: float) -> st.SearchStrategy[float]:
    """A finite number in a range."""
    return st.floats(low, high, allow_nan=False, allow_infinity=False)


# Heights to a tenth of a millimetre: 1e-192 m is no bump (test_robustness has such numbers).
heights = st.integers(-1500, 2000).map(lambda tenths: tenths / 10_000)

vehicles = st.builds(
    Vehicle,
    body_mass=between(300, 2500),
    pitch_inertia=between(400, 4000),
    front_wheel_mass=between(20, 150),
    rear_wheel_mass=between(20, 150),
    cg_to_front=between(0.8, 2),
    cg_to_rear=between(0.8, 2.5),
    cg_height=between(0.3, 1),
    front_spring=between(10_000, 60_000),
    rear_spring=between(10_000, 60_000),
    front_damping=between(500, 10_000),
    rear_damping=between(500, 10_000),
    front_tyre_stiffness=between(100_000, 500_000),
    rear_tyre_stiffness=between(100_000, 500_000),
    anti_dive=between(-0.5, 1.5),
    anti_lift=between(-0.5, 1.5),
    front_brake_share=between(0, 1),
)

bumps = st.builds(
    Bump,
    shape=st.sampled_from(["cosine", "half_sine", "circular", "flat_top", "trapezoid", "kerb"]),
    height=heights,
    width=between(0.5, 10),
    start=between(30, 100),
)
# Several, from side by side (a washboard) to some metres apart; the last ends before 114 m.
rows_of_bumps = st.builds(
    lambda bump, count, gap: bump.model_copy(
        update={"start": 40.0, "width": bump.width / 2, "count": count, "spacing": bump.width / 2 + gap}
    ),
    bumps,
    st.integers(2, 9),
    st.just(0.0) | between(0, 3),
)

scenarios = st.builds(
    Scenario,
    vehicle=vehicles,
    road=st.builds(
        Road,
        roughness=st.sampled_from([0.0, 16e-6, 64e-6, 256e-6, 1024e-6]),
        seed=st.integers(0, 1000),
        length=st.just(115.0),
        rear_axle=st.sampled_from(["in_turn", "together"]),
        bump=bumps,
    ),
    speed=st.builds(
        Speed, initial_speed_kmh=between(15, 100), target_speed_kmh=between(8, 60), detection_distance=between(5, 120)
    ),
    mpc=st.builds(
        Mpc,
        sample_time=st.sampled_from([0.005, 0.01, 0.02]),
        prediction_horizon=st.integers(20, 40),
        control_horizon=st.integers(1, 20),
        preview=st.sampled_from(["none", "wheelbase", "lookahead"]),
        deflection_limit=between(0.03, 0.15),
        force_limit=between(500, 10_000),
        deflection_weight=between(0, 10),
        solver=st.sampled_from(["daqp", "osqp"]),
    ),
)


AT_LENGTH = os.environ.get("HYPOTHESIS_PROFILE") == "search"  # as `make drill` asks


def examples(count: int) -> int:
    """How many a test of whole runs takes: a sixth of these always, all of them and new ones in `make drill`."""
    return count if AT_LENGTH else max(2, count // 6)


def some(count: int, cases: Sequence[T]) -> Sequence[T]:
    """The cases that are always tried, those that say most first; all of them in `make drill`."""
    return cases if AT_LENGTH else cases[:count]
