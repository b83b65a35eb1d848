"""The application: its addresses and its layers, and the services while it runs."""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager

from anyio.lowlevel import checkpoint
from fastapi import APIRouter, FastAPI
from fastapi.responses import Response
from starlette.middleware import Middleware
from starlette.middleware.gzip import DEFAULT_EXCLUDED_CONTENT_TYPES, GZipMiddleware

from backend.api import (
    batches,
    controller,
    health,
    library,
    links,
    login,
    paper,
    recordings,
    roads,
    runs,
    site,
    tunings,
)
from backend.compute import memory
from backend.compute.workers import Workers
from backend.file_formats import BINARY
from backend.http import openapi, problems
from backend.http.middleware import RequestMiddleware
from backend.http.tokens import TokenMiddleware
from backend.library import answers
from backend.services import Services, interactive_workers
from backend.settings import BUILT_MANUAL, BUILT_PAGE, Settings
from sim_core import __version__

DESCRIPTION = """A what-if laboratory for active suspension over bumps.

SI units everywhere, except speeds a person types (`*_kmh`). Errors are RFC 9457 `application/problem+json`."""

# Their routers are included in this order, those of one module as they stand there.
MODULES = (runs, batches, tunings, links, paper, controller, library, roads, recordings, login, health)
TRIM_INTERVAL = 60.0  # else freed pages add up in hours of mixed work (tests/drill/test_soak.py) [s]
COMPRESS_FROM = 2048  # shorter answers fit two network packets as they are [bytes]


def create_app(settings: Settings, workers: Workers | None = None) -> FastAPI:
    """A service with these settings, whose workers start with it.

    Call `app.state.services.store.migrate()` before serving: a database that cannot be used then ends the start.

    Args:
        settings: Of the service.
        workers: Perhaps spawned already; by default its own.
    """
    services = Services(settings, workers or interactive_workers(settings))
    by_token = []
    if services.tokens is not None and services.logins is not None:
        by_token = [Middleware(TokenMiddleware, services.tokens, services.logins)]
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
            Middleware(RequestMiddleware, settings.hosts),
            *by_token,
            Middleware(
                GZipMiddleware,
                COMPRESS_FROM,
                compresslevel=1,
                exclude_content_types=(*DEFAULT_EXCLUDED_CONTENT_TYPES, BINARY),
            ),
        ],
    )
    app.state.services = services
    problems.register(app)
    for module in MODULES:
        for router in vars(module).values():
            if isinstance(router, APIRouter):
                app.include_router(router)
    site.add_site(app, BUILT_PAGE, BUILT_MANUAL)
    app.openapi = lambda: openapi.describe(app)  # type: ignore[method-assign]  # FastAPI's own way to change it
    # Made on the first request, in a thread.
    app.add_route(
        "/openapi.json",
        lambda _: Response(openapi.encoded(app), media_type="application/json"),
        include_in_schema=False,
    )
    return app


async def _trim_memory() -> None:
    while True:
        await asyncio.sleep(TRIM_INTERVAL)
        await asyncio.to_thread(memory.trim_memory)


@asynccontextmanager
async def _lifespan(app: FastAPI) -> AsyncIterator[None]:
    services: Services = app.state.services
    trimming = asyncio.create_task(_trim_memory())
    try:
        await checkpoint()  # loads what the first answer in pieces would load in the event loop, 35 ms
        warming = asyncio.create_task(asyncio.to_thread(answers.warm))  # beside: nobody waits for it
        await asyncio.to_thread(services.spool.clear)
        await services.start()
        yield
        await warming
    finally:
        trimming.cancel()
        await services.close()
