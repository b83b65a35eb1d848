"""Metrics count what happened and nothing of whose; each request has a name and a log line."""

import io
import json
import logging
import re
import sys
from collections.abc import Iterator
from typing import Any

import httpx
import pytest
from prometheus_client.parser import text_string_to_metric_families

from backend.http.middleware import HARMLESS_ID
from backend.logs import CONTROL, configure
from backend.metrics import count_runs
from sim_core import __version__
from tests.servers.process import wait_until

MARK = "Zz9PlaintextMark"
LABELS = {"kind", "status", "outcome", "reason", "method", "route", "state", "version", "python", "le", "what"}
Samples = dict[tuple[str, tuple[tuple[str, str], ...]], float]


def samples(client: httpx.Client) -> Samples:
    response = client.get("/metrics")
    assert response.status_code == 200
    assert response.headers["content-type"].startswith("text/plain")
    return {
        (sample.name, tuple(sorted(sample.labels.items()))): sample.value
        for family in text_string_to_metric_families(response.text)
        for sample in family.samples
    }


def grown(before: Samples, after: Samples, name: str, **labels: str) -> float:
    key = (name, tuple(sorted(labels.items())))
    return after[key] - before.get(key, 0)


def test_runs_and_the_cache_are_counted(service: Any) -> None:
    """A stored run is a hit for each of its strategies."""
    scenario = {"road": {"length": 137.5, "bump": {"start": 90}}}
    for strategies, runs, hits, misses in (
        (["passive", "lqr"], 2, 0, 2),
        (["passive"], 0, 1, 0),
        (["passive", "lqr"], 0, 2, 0),
    ):
        before = samples(service)
        service.run(strategies, scenario).raise_for_status()
        after = samples(service)
        assert grown(before, after, "ridelab_runs_total", kind="interactive", status="ok") == runs
        assert grown(before, after, "ridelab_cache_total", outcome="hit") == hits
        assert grown(before, after, "ridelab_cache_total", outcome="miss") == misses


def test_steps_without_an_answer_of_the_solver_are_counted(client: httpx.Client) -> None:
    before = samples(client)
    count_runs("batch", "failed", fallbacks=3)
    after = samples(client)
    assert grown(before, after, "ridelab_solver_fallbacks_total") == 3
    assert grown(before, after, "ridelab_runs_total", kind="batch", status="failed") == 1


def test_latency_and_refusals_go_by_route_template_status_class_and_reason(client: httpx.Client) -> None:
    before = samples(client)
    asked = {
        ("GET", f"/api/v1/runs/{MARK}"): ("GET", "/api/v1/runs/{id}"),
        ("HEAD", "/api/v1/runs/other"): ("HEAD", "/api/v1/runs/{id}"),
        ("GET", f"/{MARK}"): ("GET", "none"),
        ("GET", f"/assets/{MARK}.js"): ("GET", "/assets/{file}"),
        (MARK.upper(), "/healthz"): ("other", "/healthz"),
    }
    for method, path in asked:
        assert client.request(method, path).status_code in (404, 405)
    long, json_body = b" " * 1_100_000, {"Content-Type": "application/json"}
    assert client.post("/api/v1/runs", content=long, headers=json_body).status_code == 413
    after = samples(client)
    for method, route in asked.values():
        count = grown(before, after, "ridelab_request_seconds_count", method=method, route=route, status="4xx")
        assert count == 1, (method, route)
    assert grown(before, after, "ridelab_refused_total", reason="too-long") == 1


def test_gauges_tell_what_is_held_now(service: Any) -> None:
    wait_until(
        lambda: service.services.workers.load["idle"] == 3,
        "two workers and the reserved one are warm and free",
    )
    with (
        service.services.gate.streams.hold("192.0.2.1", 1),
        service.services.gate.compute_queue.admit("192.0.2.1"),
        service.services.gate.computing("192.0.2.1", 0.5),
    ):
        held = samples(service)
    assert held["ridelab_open_streams", ()] == 1
    assert held["ridelab_open_requests", ()] == 1
    assert held["ridelab_admitted_cost_seconds", ()] == 0.5
    assert held["ridelab_workers", (("state", "busy"),)] == 0
    assert held["ridelab_workers", (("state", "idle"),)] == 3
    assert held["ridelab_worker_queue", ()] == 0
    openmetrics = service.get("/metrics", headers={"Accept": "application/openmetrics-text;version=1.0.0"})
    assert openmetrics.headers["content-type"].startswith("application/openmetrics-text"), "as Prometheus asks for it"
    build = [dict(labels) for name, labels in held if name == "ridelab_build_info"]
    assert [labels["version"] for labels in build] == [__version__]
    assert any(name.startswith("process_resident_memory") for name, _ in held)


def test_metrics_hold_nothing_of_anybodys_scenario(service: Any, run: dict[str, Any]) -> None:
    service.get(f"/api/v1/runs/{run['id']}?{MARK}={MARK}", headers={"X-Request-ID": MARK})
    service.post(f"/api/v1/runs?{MARK}", json={"scenario": {MARK: MARK}, "strategies": [MARK]})
    text = service.get("/metrics").text
    assert MARK not in text
    assert run["id"] not in text
    assert str(service.services.settings.data_dir) not in text
    labels = {key for _, labels_of_sample in samples(service) for key, _ in labels_of_sample}
    assert labels <= LABELS


def test_a_requests_name_is_used_where_it_is_harmless(client: httpx.Client) -> None:
    for name in ("a", "trace-1_2.3", "x" * 64):
        assert client.get("/healthz", headers={"X-Request-ID": name}).headers["x-request-id"] == name
    for name in ("", "x" * 65, "a b", "a;b", "<script>", "a\tb", "é"):
        answer = client.get("/healthz", headers=[(b"X-Request-ID", name.encode("latin-1"))])
        assert HARMLESS_ID.fullmatch(answer.headers["x-request-id"])
        assert answer.headers["x-request-id"] not in (name, "a")


@pytest.fixture
def logged(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """Start logging in a form, into a text; afterwards logging is as it was."""
    root = logging.getLogger()
    handlers, level, text = root.handlers, root.level, io.StringIO()

    def start(least: Any = "info", *, terminal: bool = False) -> io.StringIO:
        monkeypatch.setattr(sys, "stderr", text)  # only now: pytest puts its own there before each test
        monkeypatch.setattr("backend.logs.on_terminal", lambda: terminal)
        configure(least)
        return text

    yield start
    root.handlers, root.level = handlers, level
    logging.getLogger("uvicorn.error").filters.clear()
    logging.captureWarnings(False)


def lines(text: io.StringIO) -> list[dict[str, Any]]:
    return [json.loads(line) for line in text.getvalue().splitlines()]


def accesses(text: io.StringIO, name: str) -> list[dict[str, Any]]:
    """Lines of requests of that name. One is written after its answer went out, so the first may still be to come."""

    def entries() -> list[dict[str, Any]]:
        return [line for line in lines(text) if line["logger"] == "backend.access" and line["request_id"] == name]

    wait_until(entries, "a request's line in the log")
    return entries()


def test_each_request_is_one_line_with_its_name_and_template(client: httpx.Client, logged: Any) -> None:
    text = logged()
    client.get("/healthz", headers={"X-Request-ID": "trace-8"})
    client.get(f"/api/v1/runs/{MARK}?{MARK}", headers={"X-Request-ID": "trace-8", "User-Agent": MARK})
    entries = accesses(text, "trace-8")
    assert len(entries) == 1, "health is asked all the time and logged at level debug"
    line = entries[0]
    assert line.pop("duration_ms") > 0
    assert re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d+Z", line.pop("timestamp"))
    assert line == {
        "event": "request",
        "level": "info",
        "logger": "backend.access",
        "request_id": "trace-8",
        "method": "GET",
        "route": "/api/v1/runs/{id}",
        "status": 422,  # a run has no such parameter
        "client": "127.0.0.1",
    }
    ours = [line for line in lines(text) if line["logger"] != "httpx"]
    assert MARK not in json.dumps(ours), "addresses hold the secret of a link"


def test_what_goes_wrong_is_logged_under_its_requests_name(
    service: Any, logged: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def fail(*_: Any, **__: Any) -> None:
        raise RuntimeError("for the log alone")

    monkeypatch.setattr(service.services.runs, "create", fail)
    text = logged()
    response = service.post("/api/v1/runs", json={"strategies": ["passive"]}, headers={"X-Request-ID": "trace-9"})
    assert response.status_code == 500
    error = next(line for line in lines(text) if line["level"] == "error")
    assert error["request_id"] == "trace-9"
    assert "for the log alone" in error["exception"]
    assert "for the log alone" not in response.text
    (line,) = accesses(text, "trace-9")
    assert (line["status"], line["route"]) == (500, "/api/v1/runs")


FORGED = 'x\n{"event": "forged", "level": "error"}\r\x1b[2J\x00\u2028\u0085y'


@pytest.mark.parametrize("terminal", [False, True])
def test_no_text_makes_a_line_of_its_own_or_a_colour(logged: Any, terminal: bool) -> None:
    text = logged("error", terminal=terminal)  # what the service says of its work meanwhile is none
    logging.getLogger("some.library").error("it said %s", FORGED, extra={"more": FORGED})
    logging.getLogger("backend.some").error(FORGED, extra={"value": FORGED, "nested": {"deep": [FORGED]}})
    coloured = "Started server process [\x1b[36m%d\x1b[0m]"  # as uvicorn says it
    logging.getLogger("uvicorn.error").error("Started server process [%d]", 7, extra={"color_message": coloured})
    content = text.getvalue()
    assert len(content.splitlines()) == 3, content
    assert not set(content) & ({chr(code) for code in CONTROL} - {"\n"})
    assert "Started server process [7]" in content
    assert not re.search(r"color|\[36m", content)
    if not terminal:
        assert [line["event"] for line in lines(text)][:2] == ["it said " + FORGED, FORGED]


def test_a_terminal_is_told_of_requests_and_of_what_an_end_waits_for_and_not_of_each_step(logged: Any) -> None:
    text = logged(terminal=True)
    logging.getLogger("uvicorn.error").info("Waiting for application startup.")
    logging.getLogger("uvicorn.error").info("Waiting for connections to close. (CTRL+C to force quit)")
    logging.getLogger("uvicorn.error").warning("Invalid HTTP request received.")
    logging.getLogger("backend.access").info("request")
    assert [line.split(" [info] ")[-1].split(" [warning] ")[-1] for line in text.getvalue().splitlines()] == [
        "Waiting for connections to close. (CTRL+C to force quit) [uvicorn.error]",
        "Invalid HTTP request received. [uvicorn.error]",
        "request [backend.access]",
    ]
