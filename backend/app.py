"""The application: creates its parts, starts and ends them."""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from functools import partial

from fastapi import FastAPI
from fastapi.responses import JSONResponse
from starlette.middleware import Middleware
from starlette.middleware.gzip import GZipMiddleware

from backend.api import batches, controller, health, links, login, paper, roads, runs, schema, site, tunings, vehicles
from backend.batches.kind import SWEEP
from backend.batches.service import BatchService
from backend.compute.executor import Executor
from backend.compute.local_executor import LocalExecutor
from backend.compute.workers import BATCH_NICE, RESERVED, Workers
from backend.controller.service import Controllers
from backend.gate import Gate
from backend.http import openapi, problems
from backend.http.guard import GuardMiddleware
from backend.http.logins import Logins
from backend.http.request_log import RequestLogMiddleware
from backend.http.spool import Spool
from backend.http.token_middleware import TokenMiddleware
from backend.http.tokens import Tokens
from backend.jobs.scheduler import Scheduler
from backend.links.service import Links
from backend.metrics import service_registry
from backend.paper.rows import REPRODUCTION
from backend.paper.service import Paper
from backend.roads.service import MeasuredRoads
from backend.runs.result_cache import ResultCache
from backend.runs.result_finder import ResultFinder
from backend.runs.service import Runs
from backend.runs.solve.service import Solver
from backend.runs.warm_up import warm_up
from backend.settings import Settings
from backend.store import Store
from backend.tunings.service import TuningService
from backend.tunings.steps import TuningSteps
from sim_core import __version__

DESCRIPTION = """A what-if laboratory for active suspension over bumps.

SI units everywhere, except speeds a person types (`*_kmh`). Errors are RFC 9457 `application/problem+json`."""

ROUTERS = (
    runs.computing,
    runs.runs,
    runs.drawing,
    batches.submitting,
    batches.reading,
    batches.batches,
    batches.naming,
    tunings.beginning,
    tunings.naming,
    tunings.tunings,
    links.sharing,
    links.links,
    paper.paper,
    controller.controller,
    schema.schema,
    vehicles.vehicles,
    vehicles.data_sheets,
    roads.surveying,
    roads.roads,
    login.login,
    health.health,
)
COMPRESS_FROM = 2048  # shorter answers fit two network packets as they are [bytes]


def create_app(settings: Settings, workers: Workers | None = None) -> FastAPI:
    """A service with these settings, whose workers start with it.

    Call `app.state.store.migrate()` before serving: a database that cannot be used then ends the start.

    Args:
        settings: Of the service.
        workers: Perhaps spawned already; by default its own.
    """
    tokens = None if settings.tokens_file is None else Tokens(settings.tokens_file)
    store = Store(settings.store_url)
    logins = None
    if tokens is not None:
        logins = Logins(
            tokens,
            remember=lambda login: store.write(store.logins.end, login),
            has_ended=lambda login: store.read(store.logins.has_ended, login),
        )
    app = FastAPI(
        title="Ridelab",
        version=__version__,
        description=DESCRIPTION,
        openapi_url=None,  # served below
        docs_url=None,
        redoc_url=None,
        lifespan=_lifespan,
        redirect_slashes=False,  # the address it would send people to comes from the request
        middleware=[
            Middleware(RequestLogMiddleware),
            Middleware(GuardMiddleware, settings.hosts),
            *([Middleware(TokenMiddleware, tokens, logins)] if tokens is not None and logins is not None else []),
            Middleware(GZipMiddleware, COMPRESS_FROM, compresslevel=1),
        ],
    )
    app.state.settings = settings
    app.state.tokens = tokens
    app.state.logins = logins
    app.state.store = store
    app.state.workers = workers or Workers(
        settings.workers, timeout=settings.run_timeout, warm_up=warm_up, reserved=RESERVED
    )
    problems.register(app)
    for router in ROUTERS:
        app.include_router(router)
    site.add_site(app, settings.frontend_dir)
    app.openapi = lambda: openapi.describe(app)  # type: ignore[method-assign]  # FastAPI's own way to change it
    # Made on the first request, in a thread: it takes half a second.
    app.add_route("/openapi.json", lambda _: JSONResponse(app.openapi()), include_in_schema=False)
    return app


@asynccontextmanager
async def _lifespan(app: FastAPI) -> AsyncIterator[None]:
    settings: Settings = app.state.settings
    store: Store = app.state.store
    workers: Workers = app.state.workers
    workers.start()
    batch_workers = _batch_workers(settings)  # start with their first task
    scheduler: Scheduler | None = None
    steps: TuningSteps | None = None
    try:
        warming = asyncio.create_task(asyncio.to_thread(schema.warm))  # beside: nobody waits for it
        gate = Gate(settings)
        memory = ResultCache(settings.series_cache_bytes)
        measured = MeasuredRoads(store=store, workers=workers, gate=gate)
        app.state.roads = measured
        results = ResultFinder(store=store, workers=workers, memory=memory, gate=gate, roads=measured)
        app.state.gate = gate
        app.state.metrics = service_registry(workers, gate)
        spool = Spool(settings.data_dir / "spool", gate)
        await asyncio.to_thread(spool.clear)
        app.state.runs = Runs(store=store, workers=workers, results=results, gate=gate, roads=measured, spool=spool)
        app.state.solver = Solver(runs=app.state.runs, gate=gate, roads=measured)
        app.state.paper = Paper(store=store, results=results, gate=gate)
        app.state.controllers = Controllers(
            workers=workers, gate=gate, roads=measured, max_request_cost=settings.max_request_cost
        )
        app.state.links = Links(store=store, workers=workers, runs=app.state.runs, gate=gate, roads=measured)
        sweeps = BatchService(
            store=store,
            workers=workers,
            batch_workers=batch_workers,
            gate=gate,
            settings=settings,
            roads=measured,
            spool=spool,
        )
        app.state.sweeps = sweeps
        app.state.tunings = TuningService(store=store, batch_workers=batch_workers, gate=gate, settings=settings)
        steps = TuningSteps(store, sweeps)
        scheduler = Scheduler(
            store=store,
            settings=settings,
            kinds=(SWEEP, REPRODUCTION, steps.kind),
            connect=partial(_connect, settings, batch_workers),
            workers=batch_workers,
        )
        scheduler.start()
        yield
        await warming
    finally:
        if scheduler is not None:
            await scheduler.close()
        if steps is not None:
            steps.close()
        await workers.close()
        await batch_workers.close()
        store.close()


def _batch_workers(settings: Settings) -> Workers:
    """Processes for jobs, longer planning and summaries; where Dask computes the jobs, for the others."""
    count = settings.batch_workers if settings.dask_scheduler is None else 1
    return Workers(count, timeout=settings.run_timeout, warm_up=warm_up, nice=BATCH_NICE)


async def _connect(settings: Settings, batch_workers: Workers) -> Executor:
    """What computes the runs of jobs."""
    if settings.dask_scheduler is None:
        return LocalExecutor(batch_workers)
    from backend.compute.dask_executor import DaskExecutor  # takes half a second to import: not before there is a job

    return await DaskExecutor.connected(settings, warm_up)
