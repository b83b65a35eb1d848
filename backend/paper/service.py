"""The paper page's answers: what is stored is answered at once, the rest is computed beside what others do."""

import asyncio
import time
from collections import Counter
from collections.abc import Callable, Mapping
from contextlib import nullcontext
from functools import partial
from typing import Any

from backend import digest
from backend.compute import Workers
from backend.errors import BusyError, EcuUnavailableError
from backend.http.admission import Admission
from backend.paper import answers, drawings, work
from backend.paper.turns import Turns
from backend.reports import paper as paper_report
from backend.reports.making import made
from backend.reports.page import Report
from backend.results import Results
from backend.store import Store, StoredResult
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario import Scenario
from sim_core.study import paper
from sim_core.study.interpretations import DEFAULT, INTERPRETATIONS
from sim_core.study.readings import READINGS

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

    async def reproduction(self, chosen: Mapping[str, str], roads: range, client: str) -> dict[str, Any]:
        """Every cell under these readings (reading -> choice, all of them), as `PaperAnswer`.

        Raises:
            TemporaryError: Too much is being computed.
        """
        values, reason = await self._values(chosen, roads, client, ahead=True)
        blind, blind_reason = await self._values({**chosen, "preview": "none"}, roads, client, ahead=True)
        named = {}
        for name, item in INTERPRETATIONS.items():
            named[name], named_reason = await self._values(item.choices, roads, client, ahead=True)
            reason = reason or named_reason
        return answers.reproduction(chosen, roads, values, blind, named, reason or blind_reason)

    async def readings(self, roads: range, client: str) -> dict[str, Any]:
        """What each switch does by itself, as `ReadingsAnswer`; as many rows as there are after a while.

        Raises:
            TemporaryError: Too much is being computed.
        """
        default = DEFAULT.choices
        values, reason = await self._values(default, roads, client)
        base = paper.judge(values)
        end, rows = time.monotonic() + PATIENCE, []
        choices = [(reading.id, choice.id) for reading in READINGS.values() for choice in reading.choices[1:]]
        for reading, choice in choices:
            values, this_reason = await self._values({**default, reading: choice}, roads, client)
            rows.append(answers.reading_row(reading, choice, base, paper.judge(values)))
            reason = this_reason or reason
            if time.monotonic() > end:
                break
        return {"rows": rows, "complete": len(rows) == len(choices), "unavailable": answers.unavailable(reason)}

    async def attribution(self, roads: range, client: str) -> dict[str, Any]:
        """What each part contributes, as `AttributionAnswer`.

        Raises:
            TemporaryError: Too much is being computed.
        """
        return answers.attribution(roads, await self._rows(work.combinations, (), roads, client))

    async def figures(self, roads: range, client: str) -> dict[str, Any]:
        """The paper's figures made by us, as `PaperFigures`.

        Raises:
            TemporaryError: Too much is being computed.
        """
        peaks = await self._rows(work.peaks_over_speed, (), roads, client)
        found = await self._results.get(Scenario(), paper.STRATEGIES, client, points=HISTORY_POINTS)
        outcomes = {name: item.outcome for name, item in found.items()}
        return {"figures": await asyncio.to_thread(drawings.all_figures, peaks, outcomes)}

    async def report(self, chosen: Mapping[str, str], roads: range, client: str, *, compressed: bool) -> Report:
        """All of it as one HTML file; what each part contributes and the figures are by the default readings.

        Raises:
            TemporaryError: Too much is being computed.
        """
        found = await self.reproduction(chosen, roads, client)
        parts, drawn = await self.attribution(roads, client), await self.figures(roads, client)
        with self._admission.computing(client, Scenario(), ()):
            return await made(partial(paper_report.report, found, parts, drawn["figures"], compressed=compressed))

    async def _values(
        self, chosen: Mapping[str, str], roads: range, client: str, *, ahead: bool = False
    ) -> tuple[paper.Values, str | None]:
        """Each strategy's figures; where the ECU's program cannot take part, all others' and why."""
        given = ({name: choice for name, choice in chosen.items() if name != paper.WINDOW},)
        window = chosen[paper.WINDOW]
        simulated = paper.gathered(await self._rows(work.simulated_values, given, roads, client, ahead=ahead), window)
        try:
            in_ecu = await self._rows(work.ecu_values, given, roads, client, ahead=ahead)
        except EcuUnavailableError as error:
            return simulated, error.message
        return simulated | paper.gathered(in_ecu, window), None

    async def _rows(
        self,
        function: Callable[..., list[Any]],
        given: tuple[Any, ...],
        roads: range,
        client: str,
        *,
        ahead: bool = False,
    ) -> list[Any]:
        """`function(*given, seeds)` for these roads, a row each: stored, under way, or computed and stored.

        What is `ahead` is computed before what is not.

        Raises:
            EcuUnavailableError: The ECU's program cannot take part; nothing is stored then.
            TemporaryError: Too much is being computed.
        """
        key = _key(function, given, roads)
        stored = await self._store.read(self._store.runs.load_results, [key])
        if key in stored:
            rows: list[Any] = stored[key].summary["rows"]
            return rows
        self._admission.check(Scenario(), paper.STRATEGIES)  # one road's worth: who allows no more has no paper page
        with self._admission.computing(client, Scenario(), paper.STRATEGIES):
            task = self._under_way.get(key)
            if task is None:
                if len(self._under_way) >= MOST_UNDER_WAY:
                    detail = "The service is full: too much of the paper page is being computed."
                    raise BusyError(detail, retry_after=RETRY_AFTER)
                task = self._under_way[key] = asyncio.create_task(self._compute(key, function, given, roads))
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
        self, key: str, function: Callable[..., list[Any]], given: tuple[Any, ...], roads: range
    ) -> list[Any]:
        begin, rows = time.perf_counter(), []
        for begun in range(0, len(roads), AT_ONCE):
            async with self._turns.turn(key):
                rows += await self._workers.call(function, *given, list(roads[begun : begun + AT_ONCE]))
        took = 1000 * (time.perf_counter() - begin)
        item = stored_rows(function, given, roads, rows, took)
        await self._store.write(self._store.runs.save_result, item, CORE_VERSION)
        return rows


def stored_rows(
    function: Callable[..., list[Any]], given: tuple[Any, ...], roads: range, rows: list[Any], compute_ms: float
) -> StoredResult:
    """`function(*given, seeds)` for these roads, as it is stored."""
    key = _key(function, given, roads)
    return StoredResult(key=key, strategy=_name(function), status="ok", summary={"rows": rows}, compute_ms=compute_ms)


def _key(function: Callable[..., list[Any]], given: tuple[Any, ...], roads: range) -> str:
    return digest.derived_key(_name(function), {"given": given, "roads": [roads[0], roads[-1]]})


def _name(function: Callable[..., list[Any]]) -> str:
    return f"paper.{function.__name__}"
