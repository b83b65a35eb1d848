"""Time histories of stored runs: pinned by a link, or simulated again by the core version that computed the run."""

import asyncio
from collections.abc import AsyncIterator, Iterable, Mapping, Sequence
from contextlib import asynccontextmanager
from dataclasses import dataclass, field, replace
from functools import partial

from cachetools import LRUCache

from backend import digest
from backend.compute.shared_computations import SharedComputations
from backend.compute.workers import Workers
from backend.cost.estimate import cost_of, estimate
from backend.custom_controllers.registry import is_custom
from backend.errors import CostLimitError, GoneError, InvalidError, RoadGoneError, TemporaryError
from backend.gate import Gate
from backend.http.spool import Spool, SpoolFile, refused_where_full
from backend.means_over_roads import with_seeds
from backend.outcome import Outcome, Sampling
from backend.recordings.service import Recordings
from backend.roads.service import MeasuredRoads
from backend.runs import bands, exports, pins
from backend.runs.results import Results
from backend.runs.series import SAMPLE_BYTES, SamplingHints, most_samples
from backend.store import Store, StoredRun
from sim_core import STRATEGIES, Scenario
from sim_core import __version__ as CORE_VERSION
from sim_core.scenario.recorded import recording_id

FIGURE_POINTS = 2000
SHORTER_RUN = "run a shorter road or a higher speed"
BAND_BYTES = 64 * 1024 * 1024  # of cached bands: those of a dozen strategies
MIN_CACHED_BAND = 4 * 1024 * 1024  # a shorter one counts as this long, so that few files stay open [bytes]


class ControllerMissingError(GoneError):
    """A custom controller has changed or gone since the run."""

    def __init__(self) -> None:
        super().__init__(
            "The file of a custom controller has changed or gone since this run: its numbers stay, and what has "
            "to be driven again is gone. Post its scenario to run it with the controller that is there now."
        )


@dataclass(eq=False, kw_only=True)
class Histories:
    """Reads or simulates time histories."""

    store: Store
    workers: Workers
    results: Results
    gate: Gate
    roads: MeasuredRoads
    recordings: Recordings
    spool: Spool
    _bands: LRUCache[str, SpoolFile] = field(
        init=False,
        default_factory=lambda: LRUCache(BAND_BYTES, getsizeof=lambda band: max(MIN_CACHED_BAND, band.size)),
    )
    _in_progress: SharedComputations[str, SpoolFile] = field(init=False, default_factory=SharedComputations)

    async def keys(self, stored: StoredRun) -> dict[str, str]:
        """Return the result keys of the strategies whose exact time histories are pinned or can be simulated again.

        Of a run over several roads they are the first road's.

        Raises:
            GoneError: Another core version computed the run and nothing is pinned.
        """
        keys = {item.strategy: item.key for item in stored.shown}
        current = {name: keys[name] for name in keys.keys() - changed_controllers(stored)}
        if stored.core_version == CORE_VERSION and current == keys:
            return keys
        pinned = await self.store.read(self.store.links.pinned, keys.values())
        if stored.core_version == CORE_VERSION:
            if set(keys.values()) <= pinned:
                return keys
            if not current:
                raise ControllerMissingError
            return {name: key for name, key in keys.items() if name in current}
        if not pinned:
            raise GoneError(
                f"Core version {stored.core_version} computed this run, and this service runs {CORE_VERSION}: its time "
                "histories cannot be made again, and no link pinned them. Its metrics stay; post its scenario to run "
                "it on this version."
            )
        return {name: key for name, key in keys.items() if key in pinned}

    async def outcomes(self, stored: StoredRun, client: str, points: int = FIGURE_POINTS) -> dict[str, Outcome]:
        """Return the strategies that have time histories, with at most so many samples (by default a figure's).

        Raises:
            GoneError: Another core version computed the run, or its road is gone, and nothing is pinned.
        """
        keys = await self.keys(stored)
        if not keys:
            return {}
        scenario = Scenario.model_validate(stored.scenario)
        async with self._pinned(scenario, keys, client) as pinned:
            if pinned is None:
                await self._on_its_road(scenario, keys)
                (outcomes,) = await self.results.get([scenario], list(keys), client, sampling=Sampling(points))
                return outcomes
            with self.gate.computing(client, 0.0):
                arrays = await self.workers.call(pins.opened, pinned, _stages(stored), points, client=client)
        return {
            item.strategy: replace(item, sampling=Sampling(points), series=arrays[item.strategy])
            for item in stored.shown
            if item.strategy in arrays
        }

    async def exported(
        self, stored: StoredRun, keys: Mapping[str, str], export: exports.Export, client: str
    ) -> bytes | SpoolFile:
        """Return those strategies' time histories (`keys` has their result keys) as a file.

        Raises:
            CostLimitError: It would be too long.
            TemporaryError: Too much is being computed, or waits to be read.
        """
        scenario = Scenario.model_validate(stored.scenario)
        size = export.size(most_samples(scenario, name, jumps=True) for name in keys)
        cost = exports.BYTE_COST * size
        async with self._pinned(scenario, keys, client) as pinned:
            if pinned is None:
                scenario = await self._on_its_road(scenario, keys)
                cost += cost_of(scenario, keys)
            with self.gate.computing(client, cost), self.spool.reserved(client, size) as write:
                call = partial(self.workers.call, client=client, cost=cost)
                if pinned is None:
                    work = partial(call, exports.render, scenario, export)
                else:
                    work = partial(call, exports.render_pinned, pinned, _stages(stored), export)
                return await write(work)

    async def over_roads(
        self,
        stored: StoredRun,
        names: Sequence[str],
        signals: Sequence[str],
        points: int | None,
        encoding: str,
        client: str,
    ) -> bytes | SpoolFile:
        """Return mean, smallest and largest values of those strategies over the run's roads as JSON (`bands.render`).

        Raises:
            GoneError: Another core version computed the run: links pin the first road's time histories alone.
            CostLimitError: Its time histories are too long.
            TemporaryError: Too much is being computed, or waits to be read.
        """
        if stored.core_version != CORE_VERSION:
            raise GoneError(
                f"Core version {stored.core_version} computed this run, and this service runs {CORE_VERSION}: the time "
                "histories of all its roads cannot be made again. Post its scenario to run it on this version."
            )
        if changed_controllers(stored) & set(names):
            raise ControllerMissingError
        roads = with_seeds(Scenario.model_validate(stored.scenario), stored.roads)
        keys = {name: digest.band_key(roads[0], name, stored.roads) for name in names}
        driven = {name: self._bands[key] for name, key in keys.items() if key in self._bands}
        missing = [name for name in names if name not in driven]
        size = bands.text_size((most_samples(roads[0], name) for name in names), signals, points, encoding)
        render_cost = exports.BYTE_COST * size
        cost = stored.roads * cost_of(roads[0], missing) + render_cost
        self._check_memory(roads[0], names)
        with self.gate.computing(client, cost), self.spool.reserved(client, size) as write:
            tasks = [
                asyncio.create_task(self._in_progress.join(keys[name], partial(self._drive, roads, name, client)))
                for name in missing
            ]
            try:
                driven |= dict(zip(missing, await asyncio.gather(*tasks), strict=True))
            finally:
                for task in tasks:
                    task.cancel()
            self._bands.update({keys[name]: driven[name] for name in missing if driven[name].size <= BAND_BYTES})
            paths = {name: driven[name].path for name in names}
            shown = (paths, stored.roads, _stages(stored), signals, points, encoding)
            return await write(partial(self.workers.call, bands.render, *shown, client=client, cost=render_cost))

    @staticmethod
    def _check_memory(scenario: Scenario, names: Sequence[str]) -> None:
        """Refuse bands that would be too large for a worker."""
        size = sum(bands.Band.most_nbytes(scenario, name) for name in names)
        if size > bands.MAX_BYTES:
            raise CostLimitError(
                f"The time histories over all roads would take {size >> 20} MiB, and the limit is "
                f"{bands.MAX_BYTES >> 20} MiB: ask for fewer strategies, or {SHORTER_RUN}.",
                parameter="strategy",
            )

    async def _drive(self, roads: Sequence[Scenario], name: str, client: str) -> SpoolFile:
        """Return the band of one strategy over all roads, slice by slice, so that other requests come in between."""
        size, done = bands.Band.most_nbytes(roads[0], name), 0
        before, after = (self.spool.file(client, size, advice=SHORTER_RUN) for _ in range(2))
        cost = max(bands.LONGEST_TASK, estimate(roads[0], name))
        with refused_where_full():
            while done < len(roads):
                done = await self.workers.call(
                    bands.drive, roads, name, (before.path, done), after.path, client=client, cost=cost
                )
                before, after = after, before
        return before

    async def _on_its_road(self, scenario: Scenario, names: Iterable[str] = ()) -> Scenario:
        """Return a stored run's scenario with the heights of its measured road, and with its recordings.

        Raises:
            RoadGoneError: The road is not stored any more.
        """
        try:
            return await self.recordings.on(await self.roads.on(scenario), names)
        except InvalidError:
            raise RoadGoneError from None

    @asynccontextmanager
    async def _pinned(
        self, scenario: Scenario, keys: Mapping[str, str], client: str
    ) -> AsyncIterator[dict[str, bytes] | None]:
        """Yield by strategy its pinned time histories, from result keys; None unless every one is pinned.

        Raises:
            TemporaryError: Those of other requests take the memory.
        """
        wanted = set(keys.values())
        if not wanted <= await self.store.read(self.store.links.pinned, wanted):
            yield None
            return
        size = SAMPLE_BYTES * sum(most_samples(scenario, name, jumps=True) for name in keys)
        with self.gate.memory.hold(client, size):
            contents = await self.store.read(self.store.links.load_pins, wanted)
            if not wanted <= contents.keys():
                message = "A stored time history was damaged and has been dropped: ask again."
                raise TemporaryError(message, kind="store-unavailable", retry_after=1)
            yield {name: contents[key] for name, key in keys.items()}


def changed_controllers(stored: StoredRun) -> set[str]:
    """Return the run's custom controllers that are there no more, or are other ones: nothing can be driven again."""
    others = [item for item in stored.shown if item.strategy not in STRATEGIES and recording_id(item.strategy) is None]
    if not others:
        return set()
    scenario = Scenario.model_validate(stored.scenario)
    return {
        item.strategy
        for item in others
        if not is_custom(item.strategy) or digest.result_key(scenario, item.strategy) != item.key
    }


def _stages(stored: StoredRun) -> dict[str, SamplingHints]:
    """Return by strategy its driving stages: decimation preserves the extremes of each."""
    return {
        item.strategy: SamplingHints.of(
            (span["stage"], span["start_time"], span["end_time"]) for span in item.summary["stages"]
        )
        for item in stored.shown
    }
