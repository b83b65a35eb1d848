"""The services of one application: each room's, made at the start from what they share, in one typed object."""

from dataclasses import replace
from functools import partial
from operator import attrgetter

from cachetools import LRUCache

from backend.batches.kind import SWEEP
from backend.batches.service import BatchService
from backend.compute.executor import Executor
from backend.compute.local_executor import LocalExecutor
from backend.compute.workers import BATCH_NICE, RESERVED, Workers
from backend.custom_controllers.registry import Watch
from backend.ecu.service import Controllers
from backend.fmu.service import Fmus
from backend.gate import Budget, Gate
from backend.http.spool import Spool
from backend.http.tokens import Logins, Tokens
from backend.jobs.scheduler import Scheduler
from backend.links.service import Links
from backend.metrics import service_registry
from backend.outcome import Outcome
from backend.paper.rows import REPRODUCTION, PaperRows
from backend.paper.service import Paper
from backend.recordings.service import Recordings
from backend.roads.service import MeasuredRoads
from backend.runs import WARM_UP
from backend.runs.analysis import ControlAnalysis
from backend.runs.curves import RunCurves
from backend.runs.histories import Histories
from backend.runs.reports.service import RunReports
from backend.runs.results import Results
from backend.runs.service import Runs
from backend.runs.solve.service import Solver
from backend.settings import Settings
from backend.store import Store
from backend.tables import Tables
from backend.tunings.service import TuningService
from backend.tunings.steps import TUNING, TuningSteps


class Services:
    """Every service, and what they work with; none runs before `start`.

    Args:
        settings: Of all.
        workers: The processes that answer requests.

    Attributes:
        tokens: Who may ask; None where the service has no tokens.
        logins: With those; None likewise.
    """

    def __init__(self, settings: Settings, workers: Workers) -> None:
        self.settings = settings
        self.workers = workers
        self.store, self.gate = Store(settings.store_url), Gate(settings)
        self.tokens = None if settings.tokens_file is None else Tokens(settings.tokens_file)
        self.logins = None if self.tokens is None else _logins(self.tokens, self.store)
        # Where Dask computes the jobs, one process is left for longer planning and summaries.
        count = settings.batch_workers if settings.dask_scheduler is None else 1
        self.batch_workers = Workers(count, timeout=settings.run_timeout, warm_up=WARM_UP, nice=BATCH_NICE)
        self.metrics = service_registry(workers, self.gate)
        self.spool = Spool(settings.data_dir / "spool", Budget("the space for long answers", settings.spool_bytes))
        self.own_files = Watch(settings.controller_timeout)
        self._add_runs()
        self._add_jobs()

    def _add_runs(self) -> None:
        """Make what answers requests from runs and files."""
        store, workers, gate = self.store, self.workers, self.gate
        self.tables = Tables(workers=workers, gate=gate)
        self.roads = roads = MeasuredRoads(store=store, workers=workers, gate=gate, tables=self.tables)
        self.recordings = recordings = Recordings(store=store, workers=workers, gate=gate, tables=self.tables)
        memory = LRUCache[str, Outcome](self.settings.series_cache_bytes, getsizeof=attrgetter("size"))
        results = Results(store=store, workers=workers, memory=memory, gate=gate, roads=roads, recordings=recordings)
        self.runs = runs = Runs(store=store, results=results, gate=gate, roads=roads, recordings=recordings)
        histories = Histories(
            store=store,
            workers=workers,
            results=results,
            gate=gate,
            roads=roads,
            recordings=recordings,
            spool=self.spool,
        )
        self.curves = RunCurves(runs=runs, histories=histories, gate=gate)
        self.reports = RunReports(runs=runs, histories=histories, gate=gate)
        self.analysis = ControlAnalysis(runs=runs, workers=workers, gate=gate, roads=roads)
        self.solver = Solver(runs=runs, gate=gate, roads=roads)
        self.paper = Paper(rows=PaperRows(store), results=results, gate=gate)
        self.links = Links(store=store, workers=workers, runs=runs, gate=gate, roads=roads, recordings=recordings)
        self.controllers = Controllers(workers=workers, gate=gate, roads=roads)
        self.fmus = Fmus(workers=workers, gate=gate, roads=roads)

    def _add_jobs(self) -> None:
        """Make what accepts jobs and has them computed."""
        store, workers, gate, settings = self.store, self.batch_workers, self.gate, self.settings
        self.batches = BatchService(
            store=store,
            workers=self.workers,
            batch_workers=workers,
            gate=gate,
            settings=settings,
            roads=self.roads,
            spool=self.spool,
        )
        self.tunings = TuningService(store=store, batch_workers=workers, gate=gate, settings=settings)
        self.tuning_steps = TuningSteps(store, self.batches, self.own_files)
        sweep = replace(SWEEP, plan=self.batches.plan)
        tuning = replace(TUNING, plan=self.tunings.plan, step=self.tuning_steps.step)
        self.scheduler = Scheduler(
            store=store,
            settings=settings,
            kinds=(sweep, REPRODUCTION, tuning),
            connect=partial(_connect, settings, workers),
            workers=workers,
        )

    async def start(self) -> None:
        """Spawn the workers, and lead jobs where no other service does; batch workers start with their first task."""
        self.workers.start()
        await self.own_files.refresh_if_changed()  # jobs that go on may drive them
        self.scheduler.start()

    async def close(self) -> None:
        """End what runs, the database last."""
        await self.own_files.close()
        await self.scheduler.close()
        self.tuning_steps.close()
        await self.workers.close()
        await self.batch_workers.close()
        self.store.close()


def interactive_workers(settings: Settings) -> Workers:
    """Return the processes that answer requests."""
    return Workers(settings.workers, timeout=settings.run_timeout, warm_up=WARM_UP, reserved=RESERVED)


def _logins(tokens: Tokens, store: Store) -> Logins:
    return Logins(
        tokens,
        remember=lambda login: store.write(store.logins.end, login),
        has_ended=lambda login: store.read(store.logins.has_ended, login),
    )


async def _connect(settings: Settings, batch_workers: Workers) -> Executor:
    """Return what computes the runs of jobs."""
    if settings.dask_scheduler is None:
        return LocalExecutor(batch_workers)
    from backend.compute.dask_executor import DaskExecutor  # takes half a second to import: not before there is a job

    return await DaskExecutor.connected(settings, WARM_UP)
