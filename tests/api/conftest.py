"""One real service for all these tests: uvicorn in a thread, workers in processes of their own."""

import json
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import httpx
import pytest
import uvicorn
from fastapi import FastAPI

from backend.__main__ import listen
from backend.app import create_app
from backend.protocol import server_config
from backend.settings import Settings
from tests.api.cli import Cli
from tests.servers.postgres import Postgres

STORED = ("test_runs", "test_batches", "test_links")
ROAD = {"length": 130, "bump": {"start": 90}}  # not the paper's, so that stored paper runs never matter here


@dataclass
class Service:
    """The running service: its HTTP client, and the application behind it."""

    client: httpx.Client
    app: FastAPI

    def run(self, strategies: list[str], scenario: dict[str, Any] | None = None) -> httpx.Response:
        return self.client.post("/api/v1/runs", json={"scenario": scenario or {}, "strategies": strategies})

    def live(self, strategies: list[str], scenario: dict[str, Any] | None = None, **more: Any) -> httpx.Response:
        body = {"scenario": scenario or {}, "strategies": strategies, **more}
        return self.client.post("/api/v1/live", json=body)


def serve(settings: Settings) -> Iterator[Service]:
    app = create_app(settings)
    server = uvicorn.Server(server_config(app, settings))
    with listen("127.0.0.1", 0) as listener:
        address = f"http://127.0.0.1:{listener.getsockname()[1]}"
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]})
        thread.start()
        try:
            with httpx.Client(base_url=address, timeout=30) as client:
                wait_until_ready(client)
                yield Service(client=client, app=app)
        finally:
            server.should_exit = True
            thread.join()


def wait_until_ready(client: httpx.Client, seconds: float = 40) -> None:
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            if client.get("/readyz").status_code == 200:
                return
        except httpx.TransportError:
            pass
        time.sleep(0.05)
    raise TimeoutError("The service did not get ready")


@pytest.fixture(scope="session")
def service(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    settings = Settings(data_dir=tmp_path_factory.mktemp("data"), workers=2)
    if request.param == "postgresql":
        server: Postgres = request.getfixturevalue("postgres")
        settings = settings.model_copy(update={"database_url": server.new_database()})
    yield from serve(settings)


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Tests of what is stored run on both databases, one service after the other; the rest on SQLite."""
    if "service" in metafunc.fixturenames:
        stores = Path(metafunc.definition.path).stem in STORED
        databases = ["sqlite", "postgresql"] if stores else ["sqlite"]
        metafunc.parametrize("service", databases, indirect=True, scope="session")


@pytest.fixture(scope="session")
def client(service: Service) -> httpx.Client:
    return service.client


@pytest.fixture(scope="session")
def road() -> dict[str, Any]:
    return ROAD


@pytest.fixture(scope="session")
def run(service: Service) -> dict[str, Any]:
    """A stored run of three strategies, as its POST answered."""
    response = service.run(["passive", "lv", "lqr"], {"road": ROAD})
    assert response.status_code == 200, response.text
    answer: dict[str, Any] = response.json()
    return answer


@pytest.fixture
def cli(client: httpx.Client, capfdbinary: pytest.CaptureFixture[bytes], monkeypatch: pytest.MonkeyPatch) -> Cli:
    """The command, with the tests' service."""
    monkeypatch.setenv("RIDELAB_SERVER", str(client.base_url))
    return Cli(capfdbinary)


@pytest.fixture
def scenario(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """The test module's SCENARIO as a file."""
    path = tmp_path / "scenario.json"
    path.write_text(json.dumps(request.module.SCENARIO), encoding="utf-8")
    return path
