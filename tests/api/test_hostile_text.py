"""Scripts, formulas, paths and methods that want to be more than they are; and the headers that contain the rest."""

import csv
import io
import json
import re
from pathlib import Path
from typing import Any

import httpx
import pytest

from backend.batches import table as batch_table
from backend.http.middleware import HEADERS
from backend.settings import BUILT_PAGE
from sim_core.catalogue import METRICS, SIGNALS
from sim_core.strategies import STRATEGIES
from tests.api.test_hostile_connections import exchange, head
from tests.servers.batches import computed

SCRIPT = "<script>alert(1)</script>"
NAMES = [SCRIPT, "'\"><img src=x onerror=alert(1)>", "=HYPERLINK(1)", "{{7*7}}${7*7}", "%3Cscript%3Ea\u202eb"]
FORMULA = re.compile(r"^[=+\-@\t\r]")


def no_script(response: httpx.Response) -> None:
    for part in ("<script>alert", "onerror", "HYPERLINK", "7*7", "%3Cscript", "\u202e"):
        assert part not in response.text
        assert all(part not in value for value in response.headers.values())


@pytest.mark.parametrize("name", NAMES)
def test_no_name_comes_back(client: httpx.Client, run: dict[str, Any], name: str) -> None:
    for path, body in (
        ("runs", {"strategies": [name], "scenario": {"road": {"bump": {"shape": name, name: name}}}, name: 1}),
        ("live", {"strategies": ["passive"], "signals": [name]}),
        ("batches", {"strategies": ["passive"], "sweep": {"grid": {name: [1], f"{name}.more": [1]}}}),
        ("batches", {"strategies": ["passive"], "sweep": {"list": [{"mpc.preview": name}]}}),
        ("batches", {"strategies": ["passive"], "sweep": {name: {}}}),
        ("tunings", {"strategy": name, "objectives": [{"kind": "figure", "figure": name}], "search": {name: [1, 2]}}),
        ("tunings", {"limits": [{"figure": "travel_time", "at_most": name, name: name}]}),
        ("links", {"run_id": name}),
        ("links", {"run_id": run["id"], "view": {"strategies": [name], "baseline": name, "axis": name, name: name}}),
        ("login", {"token": name, name: name}),
    ):
        response = client.post(f"/api/v1/{path}", json=body)
        assert response.status_code in (404, 422), (path, body, response.text)
        no_script(response)


@pytest.mark.parametrize("name", NAMES)
def test_no_part_of_an_address_comes_back(client: httpx.Client, run: dict[str, Any], name: str) -> None:
    pages = [f"/{name}", f"/r/{name}", f"/b/{name}", f"/s/{name}", f"/assets/{name}", f"/api/v1/{name}"]
    ours = f"/api/v1/runs/{run['id']}"
    for path, query in (
        *((path, {name: name}) for path in (*pages, "/", "/docs")),
        *((f"/api/v1/{things}/{name}", {}) for things in ("runs", "links", "batches", "tunings")),
        (f"{ours}/figures/{name}", {}),
        (f"{ours}/figures", {"x": name}),
        (f"{ours}/series", {"strategy": name}),
        (f"{ours}/series", {"strategy": "lv", "signals": name, "format": name, "points": name}),
    ):
        response = client.get(path, params=query)
        assert response.status_code in (200, 404, 422)
        no_script(response)


def test_no_header_comes_back(client: httpx.Client) -> None:
    sent = dict.fromkeys(("X-Request-ID", "Referer", "Origin", "User-Agent", "X-Forwarded-Host", "Cookie"), SCRIPT)
    sent |= {"Idempotency-Key": SCRIPT + "é", "Last-Event-ID": SCRIPT, "If-None-Match": SCRIPT, "Range": SCRIPT}
    for path in ("/", "/nowhere", "/api/v1/schema", "/api/v1/runs/x", "/api/v1/batches/x/events", "/favicon.svg"):
        response = client.get(path, headers={name.encode(): value.encode() for name, value in sent.items()})
        assert response.status_code < 500
        no_script(response)
        assert "access-control-allow-origin" not in response.headers
        assert "set-cookie" not in response.headers


PATHS = """
/assets/../index.html /assets/..%2findex.html /assets/%2e%2e/%2e%2e/pyproject.toml /assets/..%5c..%5cpyproject.toml
/assets/....//....//etc/passwd /assets//etc/passwd /assets/%00 /assets/%c0%ae%c0%ae/ /assets /assets/
/docs-assets/../../../pyproject.toml /docs-assets/%252e%252e/%252e%252e/pyproject.toml /docs-assets/
/../../../etc/passwd //etc/passwd /r/../../etc/passwd /.git/config /ridelab.sqlite /data/ridelab.sqlite
"""


@pytest.mark.parametrize("path", PATHS.split())
def test_files_are_served_from_their_folder_alone(client: httpx.Client, path: str) -> None:
    assert client.base_url.port is not None
    address = (client.base_url.host, client.base_url.port)
    answer = exchange(address, f"GET {path} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n".encode("latin-1"))
    assert head(answer)[0] == 404, answer[:300]
    assert b"application/problem+json" in answer
    assert b"root:" not in answer
    assert b"[project]" not in answer


@pytest.mark.parametrize("method", ["OPTIONS", "TRACE", "PUT", "PATCH", "CONNECT", "PROPFIND", "X" * 50])
def test_other_methods_are_refused(client: httpx.Client, method: str) -> None:
    for path in ("/", "/healthz", "/api/v1/runs", "/docs", "/assets/x", "/nowhere"):
        response = client.request(method, path, headers={"Origin": "https://elsewhere.example", "X-Secret": SCRIPT})
        assert response.status_code in (403, 404, 405)  # another site may not even ask for what changes something
        assert "access-control-allow-origin" not in response.headers
        no_script(response)


def test_the_policy_evaluates_nothing_and_loads_nothing_from_elsewhere() -> None:
    directives = dict(part.split(" ", 1) for part in HEADERS["Content-Security-Policy"].split("; "))
    assert "unsafe-eval" not in HEADERS["Content-Security-Policy"]
    assert directives["script-src"] == "'self'"
    assert directives["object-src"] == directives["frame-ancestors"] == directives["base-uri"] == "'none'"
    assert "http" not in HEADERS["Content-Security-Policy"]
    assert "*" not in HEADERS["Content-Security-Policy"]


@pytest.fixture(scope="module")
def batch(client: httpx.Client) -> str:
    """A finished batch whose cells are texts, lists, booleans, reasons and numbers of either sign."""
    changes = [
        {"road.bump.shape": "cosine", "lqr.weights": [1, 2, 3], "road.bump.height": -0.05, "road.bump.start": 80},
        {"road.bump.shape": "cosine", "lqr.weights": [3, 2, 1], "road.bump.height": 0.05, "road.bump.start": 119},
    ]
    scenario, sweep = {"road": {"length": 121, "bump": {"start": 80}}}, {"list": changes}
    return str(computed(client, scenario=scenario, strategies=["lqr", "passive"], sweep=sweep)["id"])


def test_every_kind_of_answer_has_every_header(client: httpx.Client, run: dict[str, Any], batch: str) -> None:
    """Each test of a problem looks at its headers (test_problems.check)."""
    dist: Path = BUILT_PAGE
    assets = [f"/assets/{path.name}" for path in (dist / "assets").iterdir() if path.suffix != ".br"]
    assert assets
    series = f"/api/v1/runs/{run['id']}/series?strategy=lv&points=50"
    answers = {
        200: [client.get(path) for path in ("/", "/r/x", "/docs", "/docs.js", "/openapi.json", "/metrics", *assets)],
        304: [client.get(f"/api/v1/runs/{run['id']}", headers={"If-None-Match": "*"})],
        404: [client.get(path) for path in ("/nowhere", "/assets/none.js", "/docs-assets/none.js", "/s/none")],
        405: [client.post("/healthz"), client.delete("/assets/x.js"), client.put("/docs")],
    }
    answers[200] += [client.get(f"{series}&format={name}") for name in ("json", "csv")]
    answers[200].append(client.get(f"/api/v1/batches/{batch}/events"))  # of a batch that has ended: whole at once
    answers[200] += [client.head("/"), *(client.get(path) for path in ("/healthz", "/readyz", "/api/v1/schema"))]
    answers[206] = [client.get(assets[0], headers={"Range": "bytes=0-1"})]
    for status, responses in answers.items():
        for response in responses:
            assert response.status_code == status, (response.url, response.text[:200])
            for name, value in HEADERS.items():
                assert response.headers[name] == value, response.url
            assert response.headers["cache-control"]
            assert response.headers["x-request-id"]
            assert "server" not in response.headers


def test_no_cell_of_a_table_is_a_formula(client: httpx.Client, run: dict[str, Any], batch: str) -> None:
    texts = [
        client.get(f"/api/v1/runs/{run['id']}/series", params={"strategy": "lv,passive", "format": "csv"}).text,
        client.get(f"/api/v1/batches/{batch}/results", params={"format": "csv"}).text,
    ]
    for text in texts:
        rows = list(csv.reader(io.StringIO(text)))
        assert len(rows) > 2
        for row in rows:
            for cell in filter(FORMULA.match, row):
                float(cell)
    assert any(cell.startswith("-") for row in csv.reader(io.StringIO(texts[1])) for cell in row), "no negative number"


def test_no_name_of_ours_is_a_formula_or_a_script() -> None:
    for name in (*STRATEGIES, *SIGNALS, *METRICS, *batch_table.FIXED):
        assert re.fullmatch(r"[a-z][a-z0-9_.]*", name), name


def test_the_documentation_loads_nothing_from_elsewhere(client: httpx.Client) -> None:
    page = client.get("/docs").text
    assert "<script>" not in page, "the content security policy would block it"
    loaded = re.findall(r'<(?:script|link|img|iframe|a)\b[^>]*?(?:src|href)="([^"]*)"', page)
    assert len(loaded) >= 3
    for source in loaded:
        assert re.match(r"/[a-z]", source)
        assert client.get(source).status_code == 200
    assert "://" not in page + client.get("/docs.js").text
    style = client.get("/docs-assets/swagger-ui.css").text
    assert "@import" not in style
    assert not re.findall(r"url\(\s*+['\"]?+(?!data:)", style)
    assert "://" not in json.dumps(client.get("/openapi.json").json().get("servers", []))
