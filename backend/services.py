"""The services of one application: each room's, made at the start from what they share, in one typed object."""

from dataclasses import dataclass, replace
from functools import partial
from operator import attrgetter

from cachetools import LRUCache
from prometheus_client import CollectorRegistry

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


@dataclass(frozen=True, slots=True, kw_only=True)
class Services:
    """Every service, and what they work with; none runs before `start`.

    Attributes:
        tokens: Who may ask; None where the service has no tokens.
        logins: With those; None likewise.
    """

    settings: Settings
    gate: Gate
    tokens: Tokens | None
    logins: Logins | None
    own_files: Watch
    store: Store
    workers: Workers
    batch_workers: Workers
    metrics: CollectorRegistry
    spool: Spool
    tables: Tables
    roads: MeasuredRoads
    recordings: Recordings
    runs: Runs
    curves: RunCurves
    reports: RunReports
    solver: Solver
    analysis: ControlAnalysis
    batches: BatchService
    tunings: TuningService
    paper: Paper
    links: Links
    controllers: Controllers
    fmus: Fmus
    tuning_steps: TuningSteps
    scheduler: Scheduler

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


def make_services(settings: Settings, workers: Workers) -> Services:
    """Make the services with these settings and these interactive workers."""
    store, gate = Store(settings.store_url), Gate(settings)
    tokens = None if settings.tokens_file is None else Tokens(settings.tokens_file)
    # Where Dask computes the jobs, one process is left for longer planning and summaries.
    count = settings.batch_workers if settings.dask_scheduler is None else 1
    batch_workers = Workers(count, timeout=settings.run_timeout, warm_up=WARM_UP, nice=BATCH_NICE)
    spool = Spool(settings.data_dir / "spool", Budget("the space for long answers", settings.spool_bytes))
    tables = Tables(workers=workers, gate=gate)
    roads = MeasuredRoads(store=store, workers=workers, gate=gate, tables=tables)
    recordings = Recordings(store=store, workers=workers, gate=gate, tables=tables)
    memory = LRUCache[str, Outcome](settings.series_cache_bytes, getsizeof=attrgetter("size"))
    results = Results(store=store, workers=workers, memory=memory, gate=gate, roads=roads, recordings=recordings)
    runs = Runs(store=store, results=results, gate=gate, roads=roads, recordings=recordings)
    histories = Histories(
        store=store, workers=workers, results=results, gate=gate, roads=roads, recordings=recordings, spool=spool
    )
    batches = BatchService(
        store=store,
        workers=workers,
        batch_workers=batch_workers,
        gate=gate,
        settings=settings,
        roads=roads,
        spool=spool,
    )
    tunings = TuningService(store=store, batch_workers=batch_workers, gate=gate, settings=settings)
    own_files = Watch(settings.controller_timeout)
    tuning_steps = TuningSteps(store, batches, own_files)
    return Services(
        settings=settings,
        gate=gate,
        tokens=tokens,
        logins=None if tokens is None else _logins(tokens, store),
        own_files=own_files,
        store=store,
        workers=workers,
        batch_workers=batch_workers,
        metrics=service_registry(workers, gate),
        spool=spool,
        tables=tables,
        roads=roads,
        recordings=recordings,
        runs=runs,
        curves=RunCurves(runs=runs, histories=histories, gate=gate),
        reports=RunReports(runs=runs, histories=histories, gate=gate),
        analysis=ControlAnalysis(runs=runs, workers=workers, gate=gate, roads=roads),
        solver=Solver(runs=runs, gate=gate, roads=roads),
        batches=batches,
        tunings=tunings,
        paper=Paper(rows=PaperRows(store), results=results, gate=gate),
        links=Links(store=store, workers=workers, runs=runs, gate=gate, roads=roads, recordings=recordings),
        controllers=Controllers(workers=workers, gate=gate, roads=roads),
        fmus=Fmus(workers=workers, gate=gate, roads=roads),
        tuning_steps=tuning_steps,
        scheduler=Scheduler(
            store=store,
            settings=settings,
            kinds=(
                replace(SWEEP, plan=batches.plan),
                REPRODUCTION,
                replace(TUNING, plan=tunings.plan, step=tuning_steps.step),
            ),
            connect=partial(_connect, settings, batch_workers),
            workers=batch_workers,
        ),
    )


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
