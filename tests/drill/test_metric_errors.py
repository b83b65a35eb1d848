"""Every metric of twenty roads of each class, of every bump and of lagging actuators, against steps of 0.02 ms.

With -s it prints how far they are off, of class B the columns of docs/explanation/metrics.md.
"""

import multiprocessing
import re
from collections import defaultdict
from functools import partial
from itertools import product

import pytest

from sim_core import STRATEGIES, Actuator, Bump, Mpc, Road, Scenario, simulate
from sim_core.scenario.presets import PRESETS
from sim_core.scenario.road import BumpShape
from tests.validation.reference.held import errors

CLASSES = {"A": 16e-6, "B": 64e-6, "C": 256e-6, "D": 1024e-6, "E": 4096e-6}
SHAPES: tuple[BumpShape, ...] = ("cosine", "half_sine", "circular", "flat_top", "trapezoid", "kerb")
SEEDS = range(1, 21)


def errors_of(strategy: str, scenario: Scenario) -> dict[str, float]:
    """Return how far each metric of a run is from the reference's, relative."""
    return errors(scenario, strategy, simulate(scenario, strategy))


def judged(scenarios: list[Scenario], strategy: str) -> None:
    """RMS within 0.3 % on every road; peaks within 0.5 % on average, within 1 % on the worst road."""
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        found = pool.map(partial(errors_of, strategy), scenarios, chunksize=5)
    alike = defaultdict[str, list[float]](list)  # of both windows and both axles
    for key in found[0]:
        sizes = [abs(each[key]) for each in found]
        if not key.startswith("whole"):
            alike[re.sub(r"^\w+\.(front_|rear_)?", "", key)] += sizes
        if key.endswith(("peak", "peak_power")):
            assert sum(sizes) / len(sizes) < 0.005, key
            assert max(sizes) < 0.01, key
        else:
            assert max(sizes) < 0.003, key
    print(f"\n{strategy}, % off, mean (worst road)")
    for name, sizes in alike.items():
        print(f"{name:24} {100 * sum(sizes) / len(sizes):.2f} ({100 * max(sizes):.2f})")


@pytest.mark.timeout(1800)
@pytest.mark.parametrize(("name", "strategy"), list(product(CLASSES, STRATEGIES)))
def test_twenty_roads_of_each_class(name: str, strategy: str) -> None:
    judged([Scenario(road=Road(roughness=CLASSES[name], seed=seed)) for seed in SEEDS], strategy)


@pytest.mark.timeout(1800)
@pytest.mark.parametrize("strategy", STRATEGIES)
def test_every_bump(strategy: str) -> None:
    bumps = [
        Bump(shape=shape, height=height, width=width)
        for shape, (height, width) in product(SHAPES, [(0.1, 4), (0.06, 1), (-0.06, 1)])
    ]
    bumps += [PRESETS[name].scenario.road.bump for name in ("three_humps", "washboard")]
    judged([Scenario(road=Road(bump=bump, seed=seed)) for bump in bumps for seed in (1, 2)], strategy)


@pytest.mark.timeout(1800)
@pytest.mark.parametrize("strategy", ["lv", "lv_hil", "lqr", "suspension_only"])
@pytest.mark.parametrize("sample_time", [0.005, 0.02])
def test_other_sample_times_and_lagging_actuators(strategy: str, sample_time: float) -> None:
    scenarios = [
        Scenario(road=Road(seed=seed), mpc=Mpc(sample_time=sample_time), actuator=actuator)
        for actuator in (Actuator(), Actuator(bandwidth=10))
        for seed in range(1, 6)
    ]
    judged(scenarios, strategy)
