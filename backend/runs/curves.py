"""The curves of stored runs: time histories as files and over roads, figures, and how far curves lie apart."""

import asyncio
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from backend.errors import InvalidError, NotFoundError
from backend.file_formats import FormatName
from backend.gate import Gate
from backend.http.spool import SpoolFile
from backend.json_types import JsonObject
from backend.runs import deviations, exports, figures, series
from backend.runs.deviations import Deviations
from backend.runs.histories import Histories
from backend.runs.service import Runs, ordered
from sim_core.catalogue import SIGNALS
from sim_core.comparison.requirements import baseline_of


@dataclass(eq=False, kw_only=True)
class RunCurves:
    """Answers with what was recorded along a run's drives."""

    runs: Runs
    histories: Histories
    gate: Gate

    async def series(
        self,
        run_id: str,
        client: str,
        *,
        strategies: Sequence[str] | None,
        signals: Sequence[str] | None,
        points: int | None,
        file_format: FormatName,
        encoding: Literal["list", "base64"],
    ) -> bytes | SpoolFile:
        """Return time histories of a stored run in one of the formats.

        Args:
            run_id: The run.
            client: Who asks.
            strategies: Which of the run's; None where it has one.
            signals: Which; None is all.
            points: At most how many samples; None is all.
            file_format: The format.
            encoding: How JSON holds numbers.

        Raises:
            NotFoundError: No such run.
            GoneError: Its time histories are gone.
            InvalidError: Strategies it does not have.
        """
        stored = await self.runs.stored(run_id, client)
        keys = await self.histories.keys(stored)
        names = list(keys) if strategies is None else ordered(strategies)
        if not set(names) <= set(keys) or (strategies is None and len(names) != 1):
            message = f"This run has time histories of {', '.join(keys) or 'no strategy'}; name some of them"
            raise InvalidError(message, parameter="strategy")
        export = exports.Export(
            strategies=names,
            signals=series.ordered_signals(signals),
            points=points,
            file_format=file_format,
            encoding=encoding,
            core_version=stored.core_version,
            sources={name: source for name in names if (source := stored.by_strategy[name][0].summary.get("source"))},
        )
        return await self.histories.exported(stored, {name: keys[name] for name in names}, export, client)

    async def bands(
        self,
        run_id: str,
        client: str,
        *,
        strategies: Sequence[str] | None,
        signals: Sequence[str] | None,
        points: int | None,
        encoding: Literal["list", "base64"],
    ) -> bytes | SpoolFile:
        """Return time histories over all roads of a stored run as JSON; arguments as of `series`, no strategies: all.

        Raises:
            NotFoundError: No such run.
            GoneError: Another core version computed it.
            InvalidError: It is of one road, or does not have these strategies.
        """
        stored = await self.runs.stored(run_id, client)
        if stored.roads == 1:
            raise InvalidError("This run is of one road: its time histories are at /series", parameter="id")
        keys = [item.strategy for item in stored.shown]
        names = keys if strategies is None else ordered(strategies)
        if not names or not set(names) <= set(keys):
            message = f"This run has time histories of {', '.join(keys) or 'no strategy'}"
            raise InvalidError(message, parameter="strategy")
        asked = series.ordered_signals(signals)
        return await self.histories.over_roads(stored, names, asked, points, encoding, client)

    async def figures(self, run_id: str, name: str | None, axis: str, client: str) -> JsonObject:
        """Return one figure of a stored run, or all of them by name, with data.

        Raises:
            NotFoundError: No such run or figure.
            GoneError: Its time histories are gone.
        """
        if name is not None and name not in figures.PANELS:
            raise NotFoundError(f"There is no such figure; there are {', '.join(figures.PANELS)}.")
        stored = await self.runs.stored(run_id, client)
        outcomes = await self.histories.outcomes(stored, client)
        with self.gate.computing(client, 0.0):
            if name is not None:
                return figures.filled(name, outcomes, axis)
            return {"figures": {each: figures.filled(each, outcomes, axis) for each in figures.PANELS}}

    async def deviations(self, run_id: str, baseline: str | None, client: str) -> Deviations:
        """Return how far the curves of a stored run's strategies lie from one's.

        Raises:
            NotFoundError: No such run.
            GoneError: Its time histories are gone.
            InvalidError: There is no curve of the baseline.
        """
        stored = await self.runs.stored(run_id, client)
        baseline = baseline_of(list(stored.by_strategy), baseline)
        outcomes = await self.histories.outcomes(stored, client, deviations.POINTS)
        series = {name: outcome.series for name, outcome in outcomes.items() if outcome.series is not None}
        if baseline not in series:
            message = (
                f"This run has time histories of {', '.join(series) or 'no strategy'}; the baseline is one of them"
            )
            raise InvalidError(message, parameter="baseline")
        units = {key: SIGNALS[key].unit for key in deviations.COMPARED}
        by_strategy = await asyncio.to_thread(deviations.deviations, series, baseline)
        return Deviations(baseline=baseline, units=units, strategies=by_strategy)
