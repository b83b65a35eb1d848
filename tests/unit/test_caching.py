"""The cache that runs share stays within its bytes, and large results are not cached."""

import numpy as np

from sim_core import caching
from sim_core.arrays import FloatArray
from sim_core.caching import MEBIBYTE, Cache
from sim_core.scenario import Mpc, Scenario, Vehicle
from sim_core.simulate import simulate


def test_latest_results_are_cached_while_they_fit() -> None:
    calls: list[int] = []

    @Cache(MEBIBYTE).cached
    def make(quarters: int, number: int) -> FloatArray:
        calls.append(number)
        return np.zeros(quarters * MEBIBYTE // 4 // 8 - 1000)

    assert make(1, 1) is make(1, 1)
    for number in (2, 3, 4):
        make(1, number)
    assert calls == [1, 2, 3, 4]
    make(1, 1)  # still there: four quarters fit
    assert calls == [1, 2, 3, 4]
    make(1, 5)  # pushes 2 out, the one not used for longest
    make(1, 2)
    assert calls == [1, 2, 3, 4, 5, 2]
    make(8, 6)
    make(8, 6)  # larger than the whole cache: made again each time
    assert calls[-2:] == [6, 6]


def test_runs_with_nothing_in_common_stay_within_the_limit() -> None:
    for number in range(4):
        longest = Mpc(prediction_horizon=200, control_horizon=100 - number)
        simulate(Scenario(vehicle=Vehicle(body_mass=1000.0 + number), mpc=longest), "lv")
    assert caching.MAX_BYTES / 2 < caching.SHARED.size <= caching.MAX_BYTES
