"""Reports of stored runs: what their file needs is read, then it is written beside the event loop."""

import asyncio
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from backend.errors import GoneError
from backend.gate import Gate
from backend.requirements import Requirement
from backend.runs.answers import as_plain, run_answer
from backend.runs.histories import Histories
from backend.runs.reports import page
from backend.runs.reports import run as run_report
from backend.runs.reports.page import Report, in_thread
from backend.runs.results import Outcomes
from backend.runs.service import Runs, check_has
from sim_core.comparison.requirements import baseline_of


@dataclass(eq=False, kw_only=True)
class RunReports:
    """Writes runs as files for people."""

    runs: Runs
    histories: Histories
    gate: Gate

    async def report(
        self,
        run_id: str,
        client: str,
        *,
        baseline: str | None,
        against: str | None,
        axis: str,
        compressed: bool,
        requirements: Sequence[Requirement] = (),
    ) -> Report:
        """A stored run as one HTML file; without figures where its time histories are gone.

        Args:
            run_id: The run.
            client: Who asks.
            baseline: Whose figures the changes refer to; None is the run's own, or passive, or the first.
            against: The run whose figures, strategy by strategy, the changes refer to instead.
            axis: `position` or `time`, for x of the figures.
            compressed: Whether whoever asked takes gzip.
            requirements: What the run is held to.

        Raises:
            NotFoundError: No such run.
            InvalidError: It has no such strategy as `baseline`, or changes `against` that run do not exist.
        """
        stored = await self.runs.stored(run_id, client)
        names = list(stored.by_strategy)
        check_has(stored, "baseline", [] if baseline is None else [baseline])
        outcomes: Outcomes = {}
        gone = None
        try:
            outcomes = await self.histories.outcomes(stored, client)
        except GoneError as error:
            gone = error.message
        base = baseline_of(names, baseline or stored.baseline)
        other = None if against is None else await self.runs.reference(against, client)
        judged = partial(run_answer, stored, requirements=requirements, baseline=baseline, against=other)
        answer = as_plain(await asyncio.to_thread(judged))
        facts = run_report.RunFacts(
            answer=answer,
            created_at=stored.created_at,
            baseline=base,
            against=against,
            changes=answer["comparison"]["changes" if against is None else "changes_against"],
            outcomes=outcomes,
            axis=axis,
            gone=gone,
        )
        with self.gate.computing(client, page.COST):
            return await in_thread(partial(run_report.report, facts, compressed=compressed))
