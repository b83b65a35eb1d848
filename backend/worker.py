"""What runs inside a worker process: simulations, and the heavy forms of their time histories.

Nothing of the web is imported here, so that a worker starts quickly and stays small.
"""

import os
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass
from multiprocessing import parent_process
from typing import Any

import numpy as np
import orjson
from numpy.typing import NDArray

from sim_core.errors import RidelabError
from sim_core.result import StrategyResult
from sim_core.scenario import Scenario
from sim_core.signals import SIGNALS
from sim_core.simulation import simulate
from sim_core.strategies import STRATEGIES

SeriesArray = NDArray[np.float32]


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """One strategy's computed result.

    Attributes:
        summary: `StrategyResult.summary()` as plain JSON values, or `{"reason": …}` where the core refused.
        compute_ms: The worker's own time [ms]; work shared between strategies is counted at the first.
        series: float32, shape (len(SIGNALS), samples), rows in the catalogue's order; None where it failed.
    """

    status: str
    summary: dict[str, Any]
    compute_ms: float
    series: SeriesArray | None

    @property
    def size(self) -> int:
        """Memory it takes, roughly [bytes]."""
        return 8192 + (self.series.nbytes if self.series is not None else 0)


def start() -> None:
    """First thing in a new worker: end with the service, even when that was killed and could say nothing."""
    parent = parent_process()
    if parent is not None:

        def follow() -> None:
            parent.join()
            os._exit(1)

        threading.Thread(target=follow, name="follow-service", daemon=True).start()


def warm_up() -> None:
    """Run the paper's scenario with every strategy once, so that a first request meets filled caches."""
    for strategy in STRATEGIES:
        simulate(Scenario(), strategy)


def run(scenario: Scenario, strategies: Sequence[str]) -> dict[str, Outcome]:
    """Simulate the strategies one after the other, so that what they share is worked out once."""
    return {strategy: _run_one(scenario, strategy) for strategy in strategies}


def _run_one(scenario: Scenario, strategy: str) -> Outcome:
    begin = time.perf_counter()
    status, series = "ok", None
    try:
        result = simulate(scenario, strategy)
    except RidelabError as error:
        status, summary = "failed", {"reason": error.message}
    else:
        summary = orjson.loads(orjson.dumps(result.summary(), option=orjson.OPT_SERIALIZE_NUMPY, default=dict))
        series = pack(result)
    return Outcome(
        status=status, summary=summary, compute_ms=round(1000 * (time.perf_counter() - begin), 2), series=series
    )


def pack(result: StrategyResult) -> SeriesArray:
    """The time histories as one float32 array, rows in the catalogue's order."""
    packed = np.empty((len(SIGNALS), len(result.series["time"])), dtype=np.float32)
    for row, key in enumerate(SIGNALS):
        packed[row] = result.series[key]
    return packed
