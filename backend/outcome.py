"""One strategy's result, as the JSON that a worker writes and that is stored, answered and put into links as it is.

Workers import this: no web and no database here.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, Self

import numpy as np
import orjson
from numpy.typing import NDArray

from backend.json_types import JsonObject
from sim_core.errors import RefusedError, RidelabError, TooExpensiveError

SOURCE = b'{"source":'  # begins the JSON of a custom controller
OBJECTS = 1500  # what an outcome's own objects take, and a cache's entry [bytes]
FAILED = "failed"  # a status
# Kinds of failures. The first two follow from scenario and program, and are stored.
REFUSED, TOO_EXPENSIVE, UNAVAILABLE = "refused", "too-expensive", "unavailable"
UNSTORED_FAILURE = b'{"failed":true}'  # the JSON of an expired result that failed, for a reason that may have passed
JSON_OPTIONS = orjson.OPT_SERIALIZE_NUMPY


@dataclass(frozen=True, slots=True)
class Sampling:
    """The samples of a run's time histories that are wanted, the same ones of all signals.

    Attributes:
        points: At most how many.
        part: `bump` is the bump with some road around it, None is the whole road.
    """

    points: int
    part: Literal["bump"] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """One strategy's result on one scenario, or why the core refused it.

    Attributes:
        key: Names the stored result by what it depends on.
        strategy: Its id.
        status: `ok` or `failed`; `expired` where there is no JSON: retention has removed it, or a failure was none that
            is stored.
        json: An object: `StrategyResult.summary()`, or `reason`, `kind` and `fields` of a failure.
        compute_ms: The worker's own time [ms]; work shared between strategies is counted at the first.
        cacheable: Whether it follows from scenario and program alone. Any other failure is answered once, is neither
            stored nor cached, and is tried again when it is asked for.
        core_version: That computed it; None of one that was not stored when it was read.
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
    core_version: str | None = None
    cached: bool = False
    fallbacks: float = 0.0
    sampling: Sampling | None = None
    series: NDArray[np.float32] | None = None

    @classmethod
    def failure(
        cls, key: str, strategy: str, error: RidelabError, begin: float, sampling: Sampling | None = None
    ) -> Self:
        """Return the outcome of a strategy that failed; `begin` is when `time.perf_counter()` began."""
        fields: tuple[str, ...] = ()
        if isinstance(error, TooExpensiveError):
            kind, fields = TOO_EXPENSIVE, error.fields
        else:
            kind = REFUSED if isinstance(error, RefusedError) else UNAVAILABLE
        return cls(
            key=key,
            strategy=strategy,
            status=FAILED,
            json=failure_json(error.message, kind, fields),
            compute_ms=elapsed_ms(begin),
            cacheable=kind != UNAVAILABLE,
            sampling=sampling,
        )

    @property
    def failed_unstored(self) -> bool:
        """Check whether it is a stored failure without its reason, which is tried again."""
        return self.json == UNSTORED_FAILURE

    @property
    def summary(self) -> JsonObject:
        """Return the JSON as Python values, read anew each time."""
        content: JsonObject = orjson.loads(self.json)
        return content

    @property
    def source(self) -> JsonObject | None:
        """Return the file of the custom controller that it is of, with its digest; None where it does not say."""
        source: JsonObject | None = self.summary.get("source") if self.json.startswith(SOURCE) else None
        return source

    @property
    def size(self) -> int:
        """Return the memory it takes in a cache, roughly [bytes]."""
        return OBJECTS + len(self.json) + (self.series.nbytes if self.series is not None else 0)

    def answer(self, **fields: object) -> orjson.Fragment:
        """Return its entry in the answer about a run, with these members beside its own."""
        head = {"status": self.status, "compute_ms": self.compute_ms, **fields}
        if self.status == "ok" and not self.json.startswith(SOURCE):
            head["source"] = None
        return orjson.Fragment(orjson.dumps(head)[:-1] + b"," + self.json[1:])


def failure_json(reason: str, kind: str, fields: Sequence[str] = ()) -> bytes:
    """Return the JSON of a failure."""
    return orjson.dumps({"reason": reason, "kind": kind, "fields": list(fields)})


def elapsed_ms(begin: float) -> float:
    """Return the time since `time.perf_counter()` gave `begin` [ms]."""
    return round(1000 * (time.perf_counter() - begin), 2)
