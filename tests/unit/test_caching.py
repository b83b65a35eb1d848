"""The cache that runs share stays within its bytes, and large results are not cached."""

import gc
import sys
from functools import _lru_cache_wrapper
from types import FunctionType, ModuleType
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from sim_core import caching
from sim_core.scenario import Actuator, Estimation, Lqr, Mismatch, Mpc, Scenario, Vehicle
from sim_core.simulate import simulate
from sim_core.speed.fuzzy import torque_rules
from sim_core.strategies import STRATEGIES


@pytest.mark.thorough
def test_runs_with_nothing_in_common_stay_within_the_limit() -> None:
    for number in range(4):
        longest = Mpc(prediction_horizon=200, control_horizon=100 - number)
        simulate(Scenario(vehicle=Vehicle(body_mass=1000.0 + number), mpc=longest), "lv")
    assert caching.MAX_BYTES / 2 < caching.SHARED.size <= caching.MAX_BYTES


def test_nobody_can_write_into_what_runs_share() -> None:
    """Everything that the cached results of all strategies lead to, by the interpreter's own references.

    Some of it is public, such as `regulator`'s gain: a controller that changed it in place would change our LQR.
    """
    other = Scenario(
        vehicle=Vehicle(rebound_ratio=2, tyre_lift_off=True),
        actuator=Actuator(bandwidth=10),
        estimation=Estimation(kind="kalman"),
        mismatch=Mismatch(preview_noise=0.001, preview_resolution=0.05),
        mpc=Mpc(preview="wheelbase"),
        lqr=Lqr(preview="obstacle"),
    )
    caching.SHARED.clear()  # a drive that an earlier test looked at keeps its controller, whose state is nobody else's
    for strategy in STRATEGIES:
        simulate(Scenario(), strategy)
        simulate(other, strategy)
    core = [module for name, module in sys.modules.items() if name.startswith("sim_core.")]
    named = [each for module in core for each in vars(module).values()]
    # The arrays of torque_rules are C's alone.
    caches = [each for each in named if isinstance(each, _lru_cache_wrapper) and each is not torque_rules]
    assert len(caches) > 15
    shared = arrays_reached_from([*caching.SHARED.results(), *caches])
    assert len(shared) > 150
    assert not [array.shape for array in shared if array.flags.writeable]


def arrays_reached_from(roots: list[object]) -> list[NDArray[Any]]:
    ways, seen, found = [*roots], set[int](), []
    while ways:
        value = ways.pop()
        if id(value) in seen or isinstance(value, type | ModuleType | FunctionType):
            continue
        seen.add(id(value))
        if isinstance(value, np.ndarray):
            found.append(value)
            ways.append(value.base)
        else:
            ways += gc.get_referents(value)
    return found
