"""Uvicorn as it comes, and what its process needs of the system. A proxy before it bounds slow and many connections."""

import resource
from typing import TYPE_CHECKING

import uvicorn

from backend.settings import Settings

if TYPE_CHECKING:
    from fastapi import FastAPI

KEEP_ALIVE = 30  # longer than clients and proxies keep theirs, or one may send just as the other closes [s]
LONGEST_HEAD = 32_768  # that the parser takes in pieces; `RequestMiddleware` has the exact limits [bytes]
MAX_OPEN_FILES = 65_536  # each idle connection is one


def server_config(app: "FastAPI", settings: Settings) -> uvicorn.Config:
    """Return uvicorn's configuration: our own logs, client addresses only from trusted proxies."""
    return uvicorn.Config(
        app,
        http="h11",  # the parser that refuses a body with two lengths
        ws="none",
        h11_max_incomplete_event_size=LONGEST_HEAD,
        proxy_headers=bool(settings.forwarded_allow_ips),
        forwarded_allow_ips=settings.forwarded_allow_ips,
        log_config=None,
        access_log=False,
        server_header=False,
        timeout_keep_alive=KEEP_ALIVE,
        timeout_graceful_shutdown=3,
    )


def raise_file_limit() -> None:
    """Let this process open as many files as the system allows it, so that idle connections keep nobody out."""
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    most = MAX_OPEN_FILES if hard == resource.RLIM_INFINITY else min(hard, MAX_OPEN_FILES)
    if soft != resource.RLIM_INFINITY and soft < most:
        resource.setrlimit(resource.RLIMIT_NOFILE, (most, hard))
