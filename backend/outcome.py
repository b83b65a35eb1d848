"""One strategy's result, as the JSON that a worker writes and that is stored, answered and put into links as it is.

Workers import this: no web and no database here.
"""

import time
from dataclasses import dataclass
from typing import Literal, Self

import numpy as np
import orjson
from numpy.typing import NDArray

from backend.json_types import JsonObject
from sim_core.controller_files import ControllerFileError
from sim_core.errors import MissingRoadError, RidelabError, TooExpensiveError

SOURCE = b'{"source":'  # begins the JSON of a controller of one's own
OBJECTS = 1500  # what an outcome's own objects take, and a cache's entry [bytes]
JSON_OPTIONS = orjson.OPT_SERIALIZE_NUMPY


@dataclass(frozen=True, slots=True)
class Sampling:
    """Which samples of a run's time histories are wanted, the same ones of all signals.

    Attributes:
        points: About how many.
        part: `bump` is the bump with some road around it, None is the whole road.
    """

    points: int
    part: Literal["bump"] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What a strategy gave on one scenario, or why the core refused it.

    Attributes:
        key: Names the stored result by what it depends on; of a failure that is not `cacheable` nothing finds it.
        strategy: Its id.
        status: `ok` or `failed`; `expired` where retention has removed the JSON.
        json: An object: `StrategyResult.summary()`, or `reason` and perhaps `kind` and `fields` of a failure.
        compute_ms: The worker's own time [ms]; work shared between strategies is counted at the first.
        cacheable: Whether the scenario is to blame for a failure; else it is tried again next time.
        cached: Whether it was there, or being computed, before the request that got it.
        fallbacks: Control steps whose QP found no answer.
        sampling: Which samples `series` has; None where none were asked for.
        series: See `backend.runs.series`; None where none were asked for, or where it failed.
    """

    key: str
    strategy: str
    status: str
    json: bytes
    compute_ms: float
    cacheable: bool = True
    cached: bool = False
    fallbacks: float = 0.0
    sampling: Sampling | None = None
    series: NDArray[np.float32] | None = None

    @classmethod
    def refused(
        cls, key: str, strategy: str, error: RidelabError, begin: float, sampling: Sampling | None = None
    ) -> Self:
        """Of what the core refused; `begin` is when `time.perf_counter()` began."""
        content: JsonObject = {"reason": error.message}
        if isinstance(error, TooExpensiveError):
            content |= {"kind": "too-expensive", "fields": list(error.fields)}
        return cls(
            key=key,
            strategy=strategy,
            status="failed",
            json=orjson.dumps(content),
            compute_ms=elapsed_ms(begin),
            cacheable=not isinstance(error, MissingRoadError | ControllerFileError),
            sampling=sampling,
        )

    @property
    def summary(self) -> JsonObject:
        """The JSON as Python values, read anew each time."""
        content: JsonObject = orjson.loads(self.json)
        return content

    @property
    def size(self) -> int:
        """Memory it takes in a cache, roughly [bytes]."""
        return OBJECTS + len(self.json) + (self.series.nbytes if self.series is not None else 0)

    def answer(self, **fields: object) -> orjson.Fragment:
        """Its entry in the answer about a run, with these members beside its own; a failure's kind is never missing."""
        head = {"status": self.status, "compute_ms": self.compute_ms, **fields}
        if self.status == "ok" and not self.json.startswith(SOURCE):
            head["source"] = None
        if self.status != "ok":
            return orjson.Fragment(orjson.dumps({**head, "kind": "refused", "fields": [], **self.summary}))
        return orjson.Fragment(orjson.dumps(head)[:-1] + b"," + self.json[1:])


def elapsed_ms(begin: float) -> float:
    """Time since `time.perf_counter()` gave `begin` [ms]."""
    return round(1000 * (time.perf_counter() - begin), 2)
