"""The paper page's answers: what is stored is answered at once, the rest is computed beside what others do."""

import asyncio
import time
from collections import Counter
from collections.abc import Callable, Mapping
from contextlib import nullcontext
from functools import partial
from typing import Any

from backend import digest
from backend.admission import Admission
from backend.compute import Workers
from backend.hil.drive import EcuUnavailableError
from backend.paper import answers, drawings, work
from backend.paper.turns import Turns
from backend.problems import ProblemError
from backend.reports import paper as paper_report
from backend.reports.making import made
from backend.reports.page import Report
from backend.results import Results
from backend.store import Store, StoredResult
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import Scenario
from sim_core.study import paper
from sim_core.study.interpretations import READINGS

AT_ONCE = 4  # roads one worker task drives
HISTORY_POINTS = 1200
RETRY_AFTER = 30
MOST_UNDER_WAY = 8  # computations, of all visitors
PATIENCE = 20.0  # after so long an answer in rows begins no further one [s]


class Paper:
    """The one service of the paper page; its methods belong to the event loop."""

    def __init__(self, *, store: Store, workers: Workers, results: Results, admission: Admission) -> None:
        self._store = store
        self._workers = workers
        self._results = results
        self._admission = admission
        self._under_way: dict[str, asyncio.Task[Any]] = {}
        self._waiting: Counter[asyncio.Task[Any]] = Counter()
        # A visitor's what-if finds a worker free: this work takes one of them at a time.
        self._turns = Turns()

    async def reproduction(self, chosen: Mapping[str, str], seeds: int, client: str) -> dict[str, Any]:
        """Every cell under these readings (reading -> choice, all of them), as `PaperAnswer`.

        Raises:
            ProblemError: 429 or 503.
        """
        without = {**chosen, "preview": "none"}
        ours, reason = await self._values(chosen, seeds, client, ahead=True)
        blind, blind_reason = (
            (ours, reason) if without == chosen else await self._values(without, seeds, client, ahead=True)
        )
        return answers.reproduction(chosen, seeds, ours, blind, reason or blind_reason)

    async def readings(self, seeds: int, client: str) -> dict[str, Any]:
        """What each switch does by itself, as `ReadingsAnswer`; as many rows as there are after a while.

        Raises:
            ProblemError: 429 or 503.
        """
        default = paper.default_choices()
        values, reason = await self._values(default, seeds, client)
        base = paper.judge(values)
        end, rows = time.monotonic() + PATIENCE, []
        choices = [(reading.id, choice.id) for reading in READINGS.values() for choice in reading.choices[1:]]
        for reading, choice in choices:
            values, this_reason = await self._values({**default, reading: choice}, seeds, client)
            rows.append(answers.reading_row(reading, choice, base, paper.judge(values)))
            reason = this_reason or reason
            if time.monotonic() > end:
                break
        return {"rows": rows, "complete": len(rows) == len(choices), "unavailable": answers.unavailable(reason)}

    async def attribution(self, seeds: int, client: str) -> dict[str, Any]:
        """What each part contributes, as `AttributionAnswer`.

        Raises:
            ProblemError: 429 or 503.
        """
        return answers.attribution(seeds, await self._rows(work.combinations, (), seeds, client))

    async def figures(self, seeds: int, client: str) -> dict[str, Any]:
        """The paper's figures made by us, as `PaperFigures`.

        Raises:
            ProblemError: 429 or 503.
        """
        peaks = await self._rows(work.peaks_over_speed, (), seeds, client)
        found = await self._results.get(Scenario(), paper.STRATEGIES, client, points=HISTORY_POINTS)
        outcomes = {name: item.outcome for name, item in found.items()}
        return {"figures": await asyncio.to_thread(drawings.all_figures, peaks, outcomes)}

    async def report(self, chosen: Mapping[str, str], seeds: int, client: str, *, compressed: bool) -> Report:
        """All of it as one HTML file; what each part contributes and the figures are by the default readings.

        Raises:
            ProblemError: 429 or 503.
        """
        found = await self.reproduction(chosen, seeds, client)
        parts, drawn = await self.attribution(seeds, client), await self.figures(seeds, client)
        with self._admission.computing(client, Scenario(), ()):
            return await made(partial(paper_report.report, found, parts, drawn["figures"], compressed=compressed))

    async def _values(
        self, chosen: Mapping[str, str], seeds: int, client: str, *, ahead: bool = False
    ) -> tuple[paper.Values, str | None]:
        """Each strategy's figures; where the ECU's program cannot take part, all others' and why."""
        given = (dict(chosen),)
        simulated = paper.gathered(await self._rows(work.simulated_values, given, seeds, client, ahead=ahead))
        try:
            in_ecu = await self._rows(work.ecu_values, given, seeds, client, ahead=ahead)
        except EcuUnavailableError as error:
            return simulated, error.message
        return simulated | paper.gathered(in_ecu), None

    async def _rows(
        self,
        function: Callable[..., list[Any]],
        given: tuple[Any, ...],
        seeds: int,
        client: str,
        *,
        ahead: bool = False,
    ) -> list[Any]:
        """`function(*given, roads)` for roads 1 to `seeds`, a row each: stored, under way, or computed and stored.

        What is `ahead` is computed before what is not.

        Raises:
            EcuUnavailableError: The ECU's program cannot take part; nothing is stored then.
            ProblemError: 429 or 503.
        """
        key = _key(function, given, seeds)
        stored = await self._store.call(self._store.runs.load_results, [key])
        if key in stored:
            rows: list[Any] = stored[key].summary["rows"]
            return rows
        self._admission.check(Scenario(), paper.STRATEGIES)  # one road's worth: who allows no more has no paper page
        with self._admission.computing(client, Scenario(), paper.STRATEGIES):
            task = self._under_way.get(key)
            if task is None:
                if len(self._under_way) >= MOST_UNDER_WAY:
                    detail = "The service is full: too much of the paper page is being computed."
                    raise ProblemError(503, detail, kind="full", retry_after=RETRY_AFTER)
                task = self._under_way[key] = asyncio.create_task(self._compute(key, function, given, seeds))
            self._waiting[task] += 1
            try:
                with self._turns.ahead(key) if ahead else nullcontext():
                    return await asyncio.shield(task)
            finally:
                self._leave(key, task)

    def _leave(self, key: str, task: asyncio.Task[Any]) -> None:
        """One request less waits; what nobody waits for any more is called off."""
        self._waiting[task] -= 1
        if not self._waiting[task]:
            del self._waiting[task]
            self._under_way.pop(key, None)
            task.cancel()

    async def _compute(
        self, key: str, function: Callable[..., list[Any]], given: tuple[Any, ...], seeds: int
    ) -> list[Any]:
        begin, rows = time.perf_counter(), []
        for first in range(1, seeds + 1, AT_ONCE):
            roads = list(range(first, min(first + AT_ONCE, seeds + 1)))
            async with self._turns.turn(key):
                rows += await self._workers.call(function, *given, roads)
        took = 1000 * (time.perf_counter() - begin)
        item = stored_rows(function, given, seeds, rows, took)
        await self._store.call(self._store.runs.save_result, item, CORE_VERSION)
        return rows


def stored_rows(
    function: Callable[..., list[Any]], given: tuple[Any, ...], seeds: int, rows: list[Any], compute_ms: float
) -> StoredResult:
    """`function(*given, roads)` for roads 1 to `seeds`, as it is stored."""
    key = _key(function, given, seeds)
    return StoredResult(key=key, strategy=_name(function), status="ok", summary={"rows": rows}, compute_ms=compute_ms)


def _key(function: Callable[..., list[Any]], given: tuple[Any, ...], seeds: int) -> str:
    return digest.derived_key(_name(function), {"given": given, "seeds": seeds})


def _name(function: Callable[..., list[Any]]) -> str:
    return f"paper.{function.__name__}"
