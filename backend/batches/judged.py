"""Count a batch's runs that satisfy its requirements, read row by row: a point's strategies lie side by side."""

from collections import Counter
from collections.abc import Sequence

import orjson

from backend.batches.models import BatchRequirementResult, BatchRequirements, FailingRun
from backend.job_run import JobRow
from backend.store import StoredJob
from sim_core.comparison.requirements import LIMITS, Driven, Requirement, Result, baseline_of, judge_strategy

ENDED = ("ok", "failed")
COUNTS = ("pass", "fail", "not_computed", "unfinished")


class JudgedRuns:
    """A batch's runs, taken in page by page."""

    def __init__(self, batch: StoredJob) -> None:
        self._names: list[str] = batch.request["strategies"]
        self._baseline: str | None = batch.request.get("baseline")
        self._requirements = [Requirement(**each) for each in batch.request.get("requirements", [])]
        self._counts: dict[tuple[int, str], Counter[str]] = {
            (index, name): Counter(dict.fromkeys(COUNTS, 0))
            for index, each in enumerate(self._requirements)
            for name in each.strategies_judged(self._names, self._baseline)
        }
        self._first: dict[tuple[int, str], FailingRun] = {}
        self._worst: dict[tuple[int, str], FailingRun] = {}
        self._reasons: dict[tuple[int, str], str | None] = {}
        self._runs: list[Result | None] = []
        self._pending: list[JobRow] = []  # of a point whose other rows are on the next page

    def add(self, rows: Sequence[JobRow]) -> None:
        """Take a page in."""
        rows = [*self._pending, *rows]
        whole = len(rows) // len(self._names) * len(self._names)
        self._pending = rows[whole:]
        for first in range(0, whole, len(self._names)):
            self._judge(rows[first : first + len(self._names)])

    def _judge(self, point: Sequence[JobRow]) -> None:
        driven = {row.strategy: _driven(row) for row in point if row.status in ENDED}
        base = baseline_of(self._names, self._baseline)
        for row in point:
            worst: Result | None = None
            for index, requirement in enumerate(self._requirements):
                key = index, row.strategy
                counts = self._counts.get(key)
                if counts is None:
                    continue
                waits = requirement.max_change is not None and base not in driven
                if row.strategy not in driven or waits:
                    counts["unfinished"] += 1
                    continue
                result = judge_strategy(requirement, row.strategy, driven, base)
                worst = "fail" if "fail" in (worst, result.result) else result.result
                if result.value is None:
                    counts["not_computed"] += 1
                    self._reasons.setdefault(key, result.reason)
                    continue
                counts[result.result] += 1
                if result.result == "fail":
                    run = FailingRun(run=row.position, value=result.value, at=orjson.loads(row.changes))
                    self._first.setdefault(key, run)
                    if requirement.excess(run.value) > requirement.excess(self._worst.setdefault(key, run).value):
                        self._worst[key] = run
            self._runs.append(worst)

    def answer(self, batch: StoredJob) -> BatchRequirements:
        """Return the answer for the rows taken in."""
        base = baseline_of(self._names, self._baseline)
        results = []
        for key, counts in self._counts.items():
            requirement = self._requirements[key[0]]
            result: Result = "uncertain" if counts["unfinished"] else "pass"
            results.append(
                BatchRequirementResult(
                    metric=requirement.metric,
                    strategy=key[1],
                    baseline=None if requirement.max_change is None else base,
                    **{limit: getattr(requirement, limit) for limit in LIMITS},
                    result="fail" if counts["fail"] or counts["not_computed"] else result,
                    counts=dict(counts),
                    first_failure=self._first.get(key),
                    worst_failure=self._worst.get(key),
                    reason=self._reasons.get(key),
                )
            )
        return BatchRequirements(batch=batch.id, state=batch.state, requirement_results=results, runs=self._runs)


def _driven(row: JobRow) -> Driven:
    summary = orjson.loads(row.summary) if row.summary is not None else {}
    return [summary] if row.status == "ok" else row.reason or summary.get("reason") or "It failed"
