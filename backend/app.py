"""The application: its parts put together, started and ended."""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from fastapi import FastAPI
from starlette.middleware import Middleware
from starlette.middleware.gzip import GZipMiddleware

from backend.batches.driver import Driver
from backend.batches.service import Batches
from backend.compute import Workers
from backend.hil.service import Controllers
from backend.http import openapi, problems
from backend.http.admission import Admission
from backend.http.guard import GuardMiddleware
from backend.http.request_log import RequestLogMiddleware
from backend.http.tokens import TokenMiddleware, Tokens
from backend.links.service import Links
from backend.memory import Memory
from backend.metrics import service_registry
from backend.paper.service import Paper
from backend.results import Results
from backend.routes import batches, controller, health, links, login, paper, runs, schema, site, tunings
from backend.runs import Runs
from backend.settings import Settings
from backend.store import Store
from backend.tuner.driver import TuningDriver
from backend.tuner.service import Tunings
from sim_core import __version__

DESCRIPTION = """A what-if laboratory for active suspension over bumps.

SI units everywhere, except speeds a person types (`*_kmh`). Errors are RFC 9457 `application/problem+json`."""

ROUTERS = (
    runs.computing,
    runs.runs,
    runs.drawing,
    batches.submitting,
    batches.batches,
    tunings.beginning,
    tunings.tunings,
    links.sharing,
    links.links,
    paper.paper,
    controller.controller,
    schema.schema,
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
    app = FastAPI(
        title="Ridelab",
        version=__version__,
        description=DESCRIPTION,
        docs_url=None,
        redoc_url=None,
        lifespan=_lifespan,
        redirect_slashes=False,  # the address it would send people to comes from the request
        middleware=[
            Middleware(RequestLogMiddleware),
            Middleware(GuardMiddleware, settings.hosts),
            *([Middleware(TokenMiddleware, tokens)] if tokens is not None else []),
            Middleware(GZipMiddleware, COMPRESS_FROM, compresslevel=1),
        ],
    )
    app.state.settings = settings
    app.state.tokens = tokens
    app.state.store = Store(settings.store_url)
    app.state.workers = workers or Workers(settings.workers, timeout=settings.run_timeout)
    problems.register(app)
    for router in ROUTERS:
        app.include_router(router)
    site.add_site(app, settings.frontend_dir)
    app.openapi = lambda: openapi.describe(app)  # type: ignore[method-assign]  # FastAPI's own way to change it
    return app


@asynccontextmanager
async def _lifespan(app: FastAPI) -> AsyncIterator[None]:
    settings: Settings = app.state.settings
    store: Store = app.state.store
    workers: Workers = app.state.workers
    workers.start()
    driver = Driver(store=store, settings=settings)
    tuner: TuningDriver | None = None
    try:
        warming = asyncio.create_task(asyncio.to_thread(schema.warm))  # beside: nobody waits for it
        admission = _admission(settings)
        memory = Memory(settings.series_cache_bytes)
        results = Results(store=store, workers=workers, memory=memory, admission=admission)
        app.state.admission = admission
        app.state.metrics = service_registry(workers, admission)
        app.state.runs = Runs(store=store, workers=workers, results=results, admission=admission)
        app.state.paper = Paper(store=store, workers=workers, results=results, admission=admission)
        app.state.controllers = Controllers(
            workers=workers, admission=admission, max_request_cost=settings.max_request_cost
        )
        app.state.links = Links(store=store, workers=workers, admission=admission)
        app.state.batches = Batches(store=store, workers=workers, admission=admission, driver=driver, settings=settings)
        tuner = TuningDriver(store=store, batches=app.state.batches, driver=driver)
        app.state.tunings = Tunings(
            store=store,
            workers=workers,
            admission=admission,
            batches=app.state.batches,
            driver=tuner,
            settings=settings,
        )
        driver.start()
        tuner.start()
        yield
        await warming
    finally:
        if tuner is not None:
            await tuner.close()
        await driver.close()
        await workers.close()
        store.close()


def _admission(settings: Settings) -> Admission:
    return Admission(
        max_request_cost=settings.max_request_cost,
        max_queued_cost=settings.max_queued_cost,
        max_client_requests=settings.max_client_requests,
        max_wait=settings.max_wait,
        workers=settings.workers,
        max_client_streams=settings.max_client_streams,
        max_streams=settings.max_streams,
    )
