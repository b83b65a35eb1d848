"""The paper page's answers from stored rows; a job computes missing ones."""

import asyncio
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

from backend.cost.estimate import cost_of
from backend.errors import BusyError
from backend.gate import Gate
from backend.job_run import JobRun
from backend.outcome import Sampling
from backend.paper import answers, claims, drawings, paper_rows
from backend.paper.interpretations import DEFAULT, INTERPRETATIONS, OPEN_QUESTIONS
from backend.paper.models import AttributionAnswer, PaperAnswer, PaperFigures, ReadingsAnswer
from backend.paper.report import report
from backend.paper.rows import PaperRows, Rows
from backend.runs.reports import page
from backend.runs.reports.page import Report, in_thread
from backend.runs.results import Results
from sim_core.scenario import Scenario

HISTORY_POINTS = 1200
WAIT_FOR_ROWS = 2.0  # an answer in rows comes after so long with those that are there [s]

Requests = Mapping[str, tuple[JobRun, ...]]


@dataclass(eq=False, kw_only=True)
class Paper:
    """The one service of the paper page."""

    rows: PaperRows
    results: Results
    gate: Gate

    async def reproduction(
        self, choices: Mapping[str, str], roads: range, client: str, *, partial: bool = False
    ) -> PaperAnswer:
        """Every cell under these choices.

        Args:
            choices: Question -> choice, all of them.
            roads: Their seeds.
            client: Who asks.
            partial: Answer at once, with the cells that are there.

        Raises:
            TemporaryError: Too much is being computed.
        """
        sets = {"": choices, "blind": {**choices, "preview": "none"}}
        sets |= {name: item.choices for name, item in INTERPRETATIONS.items()}
        requests = {name: await _requests(each, roads) for name, each in sets.items()}
        rows = await self._get(client, *requests.values(), patience=0.0 if partial else None)

        def answer() -> PaperAnswer:
            values = {
                name: paper_rows.figures_by_strategy(rows.by_key, requests[name], each[claims.WINDOW])
                for name, each in sets.items()
            }
            named = {name: values[name] for name in INTERPRETATIONS}
            return answers.reproduction(choices, roads, values[""], values["blind"], named, rows)

        return await asyncio.to_thread(answer)

    async def readings(self, roads: range, client: str) -> ReadingsAnswer:
        """The effect of each choice by itself, from the rows that are available after a while.

        Raises:
            TemporaryError: Too much is being computed.
        """
        default = DEFAULT.choices
        choices = [(reading.id, choice.id) for reading in OPEN_QUESTIONS.values() for choice in reading.choices[1:]]
        sets = [default, *({**default, reading: choice} for reading, choice in choices)]
        requests = [await _requests(each, roads) for each in sets]
        rows = await self._get(client, *requests, patience=WAIT_FOR_ROWS)

        def answer() -> ReadingsAnswer:
            values = [
                paper_rows.figures_by_strategy(rows.by_key, row_requests, each[claims.WINDOW])
                for row_requests, each in zip(requests, sets, strict=True)
            ]
            needed = set(claims.SIMULATED if rows.reason is not None else claims.STRATEGIES)
            base = claims.judge(values[0])
            return ReadingsAnswer(
                rows=[
                    answers.reading_row(reading, choice, base, claims.judge(ours))
                    for (reading, choice), ours in zip(choices, values[1:], strict=True)
                    if needed <= ours.keys() and needed <= values[0].keys()
                ],
                complete=rows.complete,
                unavailable=answers.unavailable(rows.reason),
            )

        return await asyncio.to_thread(answer)

    async def attribution(self, roads: range, client: str) -> AttributionAnswer:
        """Return what each part contributes.

        Raises:
            TemporaryError: Too much is being computed.
        """
        rows = await self._study(paper_rows.ATTRIBUTION, roads, client)
        return await asyncio.to_thread(answers.attribution, roads, rows)

    async def figures(self, roads: range, client: str) -> PaperFigures:
        """The paper's figures, drawn from our runs.

        Raises:
            TemporaryError: Too much is being computed.
        """
        peaks = await self._study(paper_rows.SPEEDS, roads, client)
        sampling = Sampling(HISTORY_POINTS)
        (results,) = await self.results.get([Scenario()], claims.STRATEGIES, client, sampling=sampling)
        return PaperFigures(figures=await asyncio.to_thread(drawings.all_figures, peaks, results))

    async def report(self, choices: Mapping[str, str], roads: range, client: str, *, compressed: bool) -> Report:
        """The whole page as one HTML file; attribution and figures are by the default choices.

        Raises:
            TemporaryError: Too much is being computed.
        """
        whole = await self.reproduction(choices, roads, client)
        parts, drawn = await self.attribution(roads, client), await self.figures(roads, client)
        with self.gate.computing(client, page.COST):
            return await in_thread(partial(report, whole, parts, drawn.figures, compressed=compressed))

    async def _study(self, study: str, roads: range, client: str) -> list[Any]:
        row_requests = paper_rows.requests_of_study(study, roads)
        rows = await self._get(client, {study: row_requests}, patience=None)
        if len(rows.by_key) < len(row_requests):
            raise BusyError(f"Not every road could be driven. {rows.reason or 'The computation was called off'}.")
        return [rows.by_key[request.key] for request in row_requests]

    async def _get(self, client: str, *requests: Requests, patience: float | None) -> Rows:
        """These rows; one road's runs must be within the cost limit of a request."""
        cost = cost_of(Scenario(), claims.STRATEGIES)
        self.gate.check_cost(cost)
        every = [row for by_strategy in requests for rows in by_strategy.values() for row in rows]
        with self.gate.computing(client, cost * len(every) / len(claims.STRATEGIES)):
            return await self.rows.get(every, client, patience)


async def _requests(choices: Mapping[str, str], roads: range) -> Requests:
    return await asyncio.to_thread(paper_rows.requests_under, choices, roads)
