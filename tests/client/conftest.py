"""The client and the command against prepared answers: no workers, no database, no network.

That documented commands and cells work with a real service is shown in tests/manual.
"""

import json
from collections.abc import Callable, Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi import FastAPI

from backend.app import create_app
from backend.settings import Settings
from ridelab import Ridelab
from ridelab.cli.service import Services
from sim_core import Scenario, simulate
from sim_core import __version__ as CORE_VERSION
from sim_core.comparison.compare import compare_summaries
from sim_core.comparison.requirements import baseline_of
from sim_core.comparison.vehicle_cautions import vehicle_facts
from tests.client.cli import Cli
from tests.servers import loops

ADDRESS = "http://ridelab.test"
RUN, SLUG = "r" * 22, "s" * 22
SHORT = {"road": {"length": 61, "bump": {"start": 45}}, "speed": {"detection_distance": 40}}
STORED = ("runs", "batches", "tunings", "links")
Answer = dict[str, Any] | bytes | httpx.Response | Callable[[Any], dict[str, Any]]


class Prepared:
    """Stands for a service.

    Attributes:
        answers: By method and path below /api/v1, such as `POST /runs`: JSON, bytes, a response, or a function of the
            body.
            What is stored and not among them is not there; names, vehicles and data sheets come from an application
            that was not started.
        asked: Method with path, and body, of each request so far.
    """

    def __init__(self, application: FastAPI) -> None:
        self.answers: dict[str, Answer] = {}
        self.asked: list[tuple[str, Any]] = []
        self._application = application

    def __call__(self, request: httpx.Request) -> httpx.Response:
        path = request.url.path.removeprefix("/api/v1")
        name, is_json = f"{request.method} {path}", "json" in request.headers.get("content-type", "")
        body = json.loads(request.content) if is_json else request.content
        self.asked.append((name, body))
        answer = self.answers.get(name)
        if isinstance(answer, httpx.Response):
            return answer
        if answer is not None:
            content = answer(body) if callable(answer) else answer
            return httpx.Response(200, content=content if isinstance(content, bytes) else json.dumps(content))
        if path.split("/")[1] in STORED:
            return httpx.Response(404, json={"status": 404, "detail": "There is none of this id.", "errors": []})
        sent: dict[str, Any] = {}
        if is_json:
            sent = {"content": request.content, "headers": {"Content-Type": "application/json"}}
        real = loops.ask(self._application, request.method, request.url.path, **sent)
        return httpx.Response(real.status_code, json=real.json())

    def bodies(self, name: str) -> list[Any]:
        """What was sent there."""
        return [body for each, body in self.asked if each == name]

    def job(self, kind: str, state: str = "done", **more: Any) -> str:
        """Prepare a batch or a tuning; its id."""
        identifier, path = f"{kind[0]}{len(self.answers):021}", "batches" if kind == "batch" else "tunings"
        counts = {"total": 2, "done": 2 if state == "done" else 0, "failed": 0, "feasible": 2}
        job = {"id": identifier, "state": state, "reason": None, "label": None, **counts, "trials": counts, **more}
        self.answers |= {f"{method} /{path}{below}": job for method, below in (("POST", ""), ("GET", f"/{identifier}"))}
        return identifier


@pytest.fixture(scope="session")
def application(tmp_path_factory: pytest.TempPathFactory) -> FastAPI:
    """The application, not started."""
    return create_app(Settings(data_dir=tmp_path_factory.mktemp("unused")))


@pytest.fixture(scope="session")
def outcomes() -> dict[str, dict[str, Any]]:
    """Answers of two strategies on a short road."""
    scenario = Scenario.model_validate(SHORT)
    return {
        name: {"status": "ok", "cached": False, "compute_ms": 1.0}
        | json.loads(json.dumps(simulate(scenario, name).summary(), default=dict))
        for name in ("lv", "passive")
    }


@pytest.fixture
def prepared(application: FastAPI, outcomes: dict[str, dict[str, Any]]) -> Prepared:
    """Whatever is run has those outcomes, and the scenario that was sent."""
    prepared = Prepared(application)

    def run(body: Any) -> dict[str, Any]:
        sent = Scenario.model_validate(body.get("scenario", {}))
        asked = [name for name in outcomes if name in body["strategies"]]
        strategies = {name: outcomes[name] for name in asked}
        comparison = compare_summaries({name: [strategies[name]] for name in asked}, baseline_of(asked), sent)
        facts = {**vehicle_facts(sent.vehicle), "comparison": json.loads(json.dumps(asdict(comparison)))}
        scenario = {"scenario": sent.model_dump(mode="json"), **facts}
        return {"id": RUN, "core_version": CORE_VERSION, **scenario, "strategies": strategies}

    prepared.answers["POST /runs"] = run
    prepared.answers[f"GET /runs/{RUN}"] = run({"scenario": SHORT, "strategies": list(outcomes)})
    return prepared


@pytest.fixture
def ridelab(prepared: Prepared) -> Iterator[Ridelab]:
    """The client of the prepared service."""
    with Ridelab(ADDRESS, transport=httpx.MockTransport(prepared)) as ridelab:
        yield ridelab


@pytest.fixture
def cli(
    ridelab: Ridelab, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capfdbinary: pytest.CaptureFixture[bytes]
) -> Cli:
    """The command with the prepared service, in an empty folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setenv("RIDELAB_SERVER", ADDRESS)
    monkeypatch.setattr(Services, "at", lambda *_: ridelab)
    return Cli(capfdbinary)


@pytest.fixture
def scenario(tmp_path: Path) -> Path:
    """A file with a short scenario."""
    path = tmp_path / "scenario.json"
    path.write_text(json.dumps(SHORT))
    return path
