"""Whether the loop with the real car is stable: against known modes, and against a simulation."""

import numpy as np
import pytest
from scipy.linalg import expm

from sim_core import Actuator, Bump, Estimation, Hook, Mismatch, Road, Scenario, Speed, simulate
from sim_core.frequency.stability import damping, least_damping
from sim_core.vehicle.half_car import half_car
from tests.there import there

TOLD, UNTOLD = Estimation(kind="kalman"), Estimation(kind="kalman", knows_preview=False)


@pytest.mark.parametrize("ratio", [-0.3, 0.0, 0.2, 0.95])
def test_an_oscillator_has_the_damping_it_was_given(ratio: float) -> None:
    omega = 40.0
    loop = expm(np.array([[0, 1], [-(omega**2), -2 * ratio * omega]]) * 0.01)
    assert damping(loop, 0.01) == pytest.approx(ratio, abs=1e-9)  # two logarithms of rounded numbers


def test_the_passive_car_has_its_own_modes() -> None:
    scenario = Scenario(mismatch=Mismatch(damping=0.5, body_mass=1.2))
    poles = np.linalg.eigvals(half_car(scenario.real_vehicle).A)
    assert least_damping(scenario, "passive") == pytest.approx((-poles.real / np.abs(poles)).min(), rel=1e-6)


def test_preview_cannot_make_a_loop_unstable() -> None:
    blind = Scenario(mismatch=Mismatch(preview_delay=0.5, preview_offset=5, preview_noise=0.1))
    assert least_damping(blind, "lv") == least_damping(Scenario(), "lv")


@pytest.mark.parametrize("name", ["lv", "lqr", "suspension_only"])
@pytest.mark.parametrize(
    ("mismatch", "actuator"),
    [
        (Mismatch(), Actuator()),
        (Mismatch(damping=0.4), Actuator()),
        (Mismatch(damping=0.4), Actuator(bandwidth=20)),
        (Mismatch(damping=0.1), Actuator(bandwidth=2)),
        (Mismatch(damping=0.75, tyres=1.1), Actuator(bandwidth=8)),
    ],
)
def test_a_small_disturbance_grows_where_the_loop_is_unstable(
    name: str, mismatch: Mismatch, actuator: Actuator
) -> None:
    """A bump of a micrometre on a smooth road: the wheels come to rest, or swing up, if need be to the limits."""
    scenario = near_rest(mismatch, actuator, length=150)
    signals = simulate(scenario, name).series
    load = np.hypot(signals["front_tyre_load"], signals["rear_tyre_load"])
    early, late = (load[(signals["position"] > a) & (signals["position"] < a + 10)].max() for a in (60, 139))
    # Six seconds apart: no case is so near to neutral that it would not show. A kilonewton is ten million times what
    # the bump itself makes: the limits stopped the growth before the early window.
    ratio = there(least_damping(scenario, name))
    assert (late > early or late > 1000) == (ratio < 0)


def test_margins_are_judged_with_the_filter_that_drives() -> None:
    """On a rougher road the filter trusts its sensors more, and the loop's margin is another."""
    noisy = Estimation(kind="kalman", deflection_noise=0.01)
    judged = [
        least_damping(Scenario(estimation=noisy, mismatch=Mismatch(body_mass=0.5), road=Road(roughness=each)), "lqr")
        for each in (64e-6, 1024e-6)
    ]
    assert judged[0] != pytest.approx(judged[1], rel=0.01)
    light = Scenario(mismatch=Mismatch(body_mass=0.5))
    told, untold = (least_damping(light.model_copy(update={"estimation": each}), "lv") for each in (TOLD, UNTOLD))
    assert told != pytest.approx(untold, rel=0.01)


def limit(name: str, ratio: float, actuator: Actuator) -> float:
    """Damping over the believed one below which the loop is unstable."""
    low, high = 0.3, 1.0
    while high - low > 0.002:
        middle = (low + high) / 2
        damped = there(least_damping(near_rest(Mismatch(damping=middle, rebound_ratio=ratio), actuator), name))
        low, high = (middle, high) if damped < 0 else (low, middle)
    return high


def near_rest(mismatch: Mismatch, actuator: Actuator, length: float = 450) -> Scenario:
    return Scenario(
        road=Road(roughness=0, length=length, bump=Bump(height=1e-6, width=1, start=5)),
        speed=Speed(target_speed_kmh=50),
        mismatch=mismatch,
        actuator=actuator,
    )


@pytest.mark.parametrize(
    ("name", "ratio", "actuator", "expected"),
    [
        ("lv", 2, Actuator(), 0.68),
        ("lv", 3, Actuator(), 0.77),
        ("suspension_only", 2.5, Actuator(), 0.73),
        ("suspension_only", 3, Actuator(bandwidth=10), 0.47),
        ("lqr", 3, Actuator(), 0.5),
    ],
)
def test_with_unequal_dampers_the_limit_is_where_a_simulation_begins_to_grow(
    name: str, ratio: float, actuator: Actuator, expected: float
) -> None:
    """To 0.02 of the believed damping, from a bump of a micrometre, 14 to 30 s after it; the mean dampers' is 0.66.

    At a limit a motion neither grows nor dies: so near to it, it takes longer than that to tell which.
    """
    found = limit(name, ratio, actuator)
    assert found == pytest.approx(expected, abs=0.01)
    for share, unstable in ((found - 0.02, True), (found + 0.02, False)):
        signals = simulate(near_rest(Mismatch(damping=share, rebound_ratio=ratio), actuator), name).series
        load = np.hypot(signals["front_tyre_load"], signals["rear_tyre_load"])
        early, late = (load[(signals["position"] > a) & (signals["position"] < a + 30)].max() for a in (200, 419))
        assert (late > early or late > 10) == unstable  # 10 N: a hundred times what the bump makes


@pytest.mark.parametrize("name", ["skyhook", "groundhook", "hybrid"])
def test_a_semi_active_damper_is_not_judged(name: str) -> None:
    """It takes energy out whatever the law (test_semi_active); active, skyhook would be unstable here."""
    lagging = Scenario(hook=Hook(skyhook_damping=100_000, groundhook_damping=100_000), actuator=Actuator(bandwidth=2))
    active = there(least_damping(lagging, name))
    assert (active < 0) == (name == "skyhook")
    assert least_damping(lagging.model_copy(update={"hook": Hook(semi_active=True)}), name) is None
