"""One real service for all these tests: uvicorn in a thread, workers in processes of their own."""

import asyncio
import itertools
import json
import re
import socket
import threading
from collections.abc import Coroutine, Iterator
from contextlib import closing
from dataclasses import replace
from typing import Any, TypeVar

import httpx
import pytest
import uvicorn
from fastapi import FastAPI

from backend.__main__ import listen
from backend.app import create_app
from backend.compute import workers
from backend.http.server import server_config
from backend.outcome import REFUSED, failure_json
from backend.services import Services
from backend.settings import Settings
from backend.store import Store
from sim_core.scenario import Scenario
from tests.servers.postgres import Postgres
from tests.servers.process import HANG_TIMEOUT, wait_until
from tests.servers.reproduction import store_in

T = TypeVar("T")
# Kinds of problems that any request may meet; they belong to no operation.
BEFORE_ANY_ROUTE = ("address-too-long", "connections", "cross-site", "headers-too-long", "other-host", "two-lengths")
TOKENS = {"ann": "ann-0123456789abcdef", "ben": "ben/+~.0123456789==", "o" * 64: "of-the-longest-name"}
DESCRIBED: dict[str, Any] = {}  # the paths of the API's description, which takes two seconds and is all services' same
HEIGHTS = (0.04 + 1e-5 * number for number in itertools.count(1))
ROAD = {"length": 130, "bump": {"start": 90}}  # not the paper's, so that stored paper runs never matter here


class Service(httpx.Client):
    """Asks the running service over HTTP; beside it the application, and the event loop that it runs in."""

    def __init__(self, address: str, app: FastAPI, loop: asyncio.AbstractEventLoop) -> None:
        super().__init__(base_url=address, timeout=HANG_TIMEOUT, event_hooks={"response": [check_described]})
        self.app = app
        self.loop = loop

    @property
    def services(self) -> Services:
        """What the application's routes call."""
        services: Services = self.app.state.services
        return services

    def run(self, strategies: list[str], scenario: dict[str, Any] | None = None, **more: Any) -> httpx.Response:
        return self.post("/api/v1/runs", json={"scenario": scenario or {}, "strategies": strategies, **more})

    def live(self, strategies: list[str], scenario: dict[str, Any] | None = None, **more: Any) -> httpx.Response:
        body = {"scenario": scenario or {}, "strategies": strategies, **more}
        return self.post("/api/v1/live", json=body)

    def begun(self, method: str, path: str, body: Any = None) -> socket.socket:
        """The connection of a request that was sent and is not answered yet; who closes it goes away."""
        content = json.dumps(body).encode() if body is not None else b""
        kind = "Content-Type: application/json\r\n" if body is not None else ""
        assert self.base_url.port is not None
        connection = socket.create_connection((self.base_url.host, self.base_url.port))
        head = f"{method} {path} HTTP/1.1\r\nHost: x\r\n{kind}Content-Length: {len(content)}\r\n\r\n"
        connection.sendall(head.encode() + content)
        return connection

    def inside(self, work: Coroutine[Any, Any, T]) -> T:
        """The result of the work, run in the service's own event loop."""
        return asyncio.run_coroutine_threadsafe(work, self.loop).result(HANG_TIMEOUT)


class LoopServer(uvicorn.Server):
    """Tells which event loop it runs in."""

    loop: asyncio.AbstractEventLoop

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        self.loop = asyncio.get_running_loop()
        await super().startup(sockets)


def serve(settings: Settings) -> Iterator[Service]:
    app = create_app(settings)
    app.state.services.store.migrate()
    server = LoopServer(server_config(app, settings))
    with listen("127.0.0.1", 0) as listener, pytest.MonkeyPatch.context() as patch:
        patch.setattr(workers, "WAIT_FOR_PROCESS", HANG_TIMEOUT)  # on a busy machine one may take a minute to start
        address = f"http://127.0.0.1:{listener.getsockname()[1]}"
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
        thread.start()
        try:
            DESCRIBED.update({} if DESCRIBED else app.openapi()["paths"])
            wait_until(lambda: ready(address), "the service gets ready")
            with Service(address, app, server.loop) as service:
                yield service
        finally:
            server.should_exit = True
            thread.join()


def check_described(response: httpx.Response) -> None:
    """Fail where the API's description does not have the answer's status, whatever test asked."""
    for path, operations in DESCRIBED.items():
        operation = operations.get(response.request.method.lower())
        if operation is not None and re.fullmatch(re.sub(r"\{\w+\}", "[^/]+", path), response.request.url.path):
            if response.headers.get("content-type") == "application/problem+json":
                response.read()
                if response.json()["type"].rpartition(":")[2] in BEFORE_ANY_ROUTE:
                    return
            name = operation["operationId"]
            assert str(response.status_code) in operation["responses"], f"{name} does not describe {response}"


def ready(address: str) -> bool:
    try:
        return httpx.get(f"{address}/readyz").status_code == 200
    except httpx.TransportError:
        return False


@pytest.fixture(scope="session")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    yield from serve(Settings(data_dir=tmp_path_factory.mktemp("data"), workers=2, batch_workers=1))


@pytest.fixture(scope="session")
def with_tokens(
    postgres: Postgres, migrated_postgres: str, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Service]:
    """One on PostgreSQL for whoever has a token: TOKENS, by name."""
    folder = tmp_path_factory.mktemp("guarded")
    file = folder / "tokens"
    file.write_text("".join(f"{name} {token}\n" for name, token in TOKENS.items()))
    settings = {"workers": 1, "batch_workers": 1, "tokens_file": file, "data_dir": folder}
    yield from serve(Settings.model_validate({**settings, "database_url": postgres.new_database(migrated_postgres)}))


@pytest.fixture(scope="session")
def guarded(with_tokens: Service) -> Iterator[tuple[httpx.Client, httpx.Client]]:
    """Clients of that service with the tokens of ann and of ben."""
    ann, ben = (
        httpx.Client(base_url=with_tokens.base_url, headers={"Authorization": f"Bearer {TOKENS[name]}"}, timeout=60)
        for name in ("ann", "ben")
    )
    with ann, ben:
        yield ann, ben


@pytest.fixture(scope="session")
def reproduced(service: Service) -> None:
    """The service has the paper's reproduction stored."""
    store_in(service.services.store)


@pytest.fixture(scope="session")
def client(service: Service) -> httpx.Client:
    return service


@pytest.fixture(scope="session")
def road() -> dict[str, Any]:
    return ROAD


@pytest.fixture(scope="session")
def run(service: Service) -> Any:
    """A stored run of three strategies, as its POST answered."""
    response = service.run(["passive", "lv", "lqr"], {"road": ROAD})
    assert response.status_code == 200, response.text
    return response.json()


@pytest.fixture
def fresh(service: Service, road: dict[str, Any]) -> Any:
    """A stored run of two strategies that no other test has, as its POST answered."""
    scenario = {"road": {**road, "bump": {**road["bump"], "height": next(HEIGHTS)}}}
    return service.run(["lv", "passive"], scenario).raise_for_status().json()


@pytest.fixture
def worker_calls(service: Service, monkeypatch: pytest.MonkeyPatch) -> list[tuple[Any, ...]]:
    """What the workers are asked for during the test: function and arguments of each call, cost at the end."""
    calls, call = list[tuple[Any, ...]](), service.services.workers.call

    async def noted(function: Any, *arguments: Any, **queued: Any) -> Any:
        calls.append((function, *arguments, queued.get("cost", 0.0)))
        return await call(function, *arguments, **queued)

    monkeypatch.setattr(service.services.workers, "call", noted)
    return calls


@pytest.fixture
def lqr_fails(service: Service, monkeypatch: pytest.MonkeyPatch) -> int:
    """During the test no run of LQR succeeds on the road of the seed that this gives."""
    call, seed = service.services.workers.call, 72

    async def refused(function: Any, scenario: Scenario, *arguments: Any, **queued: Any) -> Any:
        outcomes = await call(function, scenario, *arguments, **queued)
        if isinstance(outcomes, dict) and "lqr" in outcomes and scenario.road.seed == seed:
            reason = failure_json("no controller", REFUSED)
            outcomes["lqr"] = replace(outcomes["lqr"], status="failed", json=reason, compute_ms=1.0, series=None)
        return outcomes

    monkeypatch.setattr(service.services.workers, "call", refused)
    return seed


@pytest.fixture
def store(migrated_url: str) -> Iterator[Store]:
    """An empty one of the newest schema, on each kind of database."""
    with closing(Store(migrated_url)) as store:
        yield store


@pytest.fixture
def server_store(postgres: Postgres, migrated_postgres: str) -> Iterator[Store]:
    """An empty one on PostgreSQL, whose server may be stopped meanwhile."""
    with closing(Store(postgres.new_database(migrated_postgres))) as store:
        yield store
    postgres.start()
