"""Skyhook, groundhook and hybrid: the law by its definition, and what it is for."""

import numpy as np
import pytest

from sim_core.scenario import Bump, Hook, Mpc, Road, Scenario, Vehicle
from sim_core.simulate import prepare, simulate
from tests.validation.reference.sampled import to_deflections


@pytest.mark.parametrize(("alpha", "sky", "ground"), [(1.0, 3000, 0), (0.0, 0, 2000), (0.3, 900, 1400)])
def test_the_law_is_dampers_against_sky_and_ground(alpha: float, sky: float, ground: float) -> None:
    """In absolute coordinates the forces are those of dampers between bodies above the axles and the sky, ..."""
    car = Vehicle(cg_to_front=1.2, cg_to_rear=1.5)
    q, speeds = np.array([0.01, 0.02, 0.003, -0.004]), np.array([0.3, -0.2, 0.7, -0.5])
    state = to_deflections(car) @ np.concatenate([q, speeds])
    hook = Hook(skyhook_damping=3000, groundhook_damping=2000, alpha=alpha)
    run = prepare(Scenario(vehicle=car, hook=hook), "hybrid")
    run.controller.start(run.setup())
    law = run.controller.linear_law("cruise")
    assert law is not None
    force = law.force(state, np.zeros(2), np.zeros((3, 0)))
    body = speeds[0] + np.array([-1.2, 1.5]) * speeds[1]
    np.testing.assert_allclose(force, -sky * body + ground * speeds[2:], rtol=1e-12, atol=1e-9)


def test_each_law_does_what_it_is_for() -> None:
    """Against the same drive without them (Karnopp et al. 1974): and semi-active does less than active, but does it."""
    soft = Vehicle(front_damping=1500, rear_damping=1500)
    rough = Scenario(vehicle=soft, road=Road(roughness=256e-6, bump=Bump(height=0)), mpc=Mpc(sample_time=0.002))
    semi = rough.model_copy(update={"hook": Hook(semi_active=True)})

    def rms(scenario: Scenario, strategy: str, signal: str) -> float:
        return simulate(scenario, strategy).metrics["whole"][signal]["rms"]

    active, half, none = (
        rms(scenario, law, "body_acceleration")
        for scenario, law in ((rough, "skyhook"), (semi, "skyhook"), (rough, "speed_only"))
    )
    assert active < half < none
    for axle in ("front", "rear"):
        load = f"{axle}_tyre_load"
        assert rms(rough, "groundhook", load) < rms(rough, "speed_only", load)
