"""OpenAPI, its page, and the files of the dashboard.

`UPDATE_DOCS=1 python -m pytest tests/api/test_openapi.py` writes the page's types anew.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import httpx
import pytest
from fastapi import FastAPI

from backend import app
from backend.http.openapi import FIELDS, FIELDS_OF_MODELS
from backend.settings import Settings
from sim_core.check_controller import ID
from sim_core.strategies import STRATEGIES, reads
from tests.servers.loops import ask
from tests.servers.process import HANG_TIMEOUT

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def description(client: httpx.Client) -> Any:
    response = client.get("/openapi.json")
    assert response.status_code == 200
    return response.json()


@pytest.fixture(scope="module")
def operations(description: dict[str, Any]) -> list[tuple[str, str, Any]]:
    """Each method and address with what is described of it."""
    return [(method, path, each) for path, methods in description["paths"].items() for method, each in methods.items()]


def test_names_and_titles_are_unique_and_everything_is_described(
    description: dict[str, Any], operations: list[tuple[str, str, Any]]
) -> None:
    """Generators name functions and types by them, and put descriptions beside each field."""
    assert description["openapi"].startswith("3.1")
    schemas = description["components"]["schemas"]
    fields = {
        f"{name}.{field}": each
        for name, schema in schemas.items()
        for field, each in schema.get("properties", {}).items()
    }
    for names in ([each["operationId"] for *_, each in operations], [each["title"] for each in schemas.values()]):
        assert len(set(names)) == len(names)
    assert all(re.fullmatch("[a-z]+[A-Za-z]*", each["operationId"]) for *_, each in operations)
    parameters = [parameter for *_, each in operations for parameter in each.get("parameters", ())]
    answers = [answer for *_, each in operations for answer in each["responses"].values()]
    described = [*fields.values(), *(each for *_, each in operations), *parameters, *answers, *description["tags"]]
    described += description["components"]["headers"].values()
    assert [each for each in described if each.get("description", "") in ("", "Successful Response")] == []
    unused = {field for field in FIELDS if not any(each["description"] == FIELDS[field] for each in fields.values())}
    assert unused | (FIELDS_OF_MODELS.keys() - fields.keys()) == set()
    assert {name for *_, each in operations for name in each["tags"]} == {each["name"] for each in description["tags"]}
    for name in ("Batch", "Tuning", "TuningItem"):
        assert "queued" in schemas[name]["properties"]["state"]["enum"]
    assert schemas["BatchRow"]["properties"]["strategy"]["pattern"] == ID


def test_answers_say_their_headers_and_what_can_be_asked_next(operations: list[tuple[str, str, Any]]) -> None:
    parameters = {each["operationId"]: {item["name"] for item in each.get("parameters", ())} for *_, each in operations}
    for *_, operation in operations:
        for status, answer in operation["responses"].items():
            assert "X-Request-ID" in answer["headers"]
            assert ("Retry-After" in answer["headers"]) is (status in ("429", "503"))
            for link in answer.get("links", {}).values():
                assert set(link["parameters"]) <= parameters[link["operationId"]]


def test_every_address_is_documented_with_its_parameters(operations: list[tuple[str, str, Any]]) -> None:
    page = (ROOT / "docs/reference/api.md").read_text()
    rows = re.findall(r"^\| `([A-Z]+ /[^`]*)` \|([^|]*)\| [^|]+ \|$", page, re.MULTILINE)
    assert {address: re.findall("`([^`]+)`", names) for address, names in rows} == {
        f"{method.upper()} {path}": [item["name"] for item in each.get("parameters", []) if item["in"] == "query"]
        for method, path, each in operations
    }


def test_every_body_has_an_example_that_is_taken(
    client: httpx.Client, description: dict[str, Any], operations: list[tuple[str, str, Any]], run: dict[str, Any]
) -> None:
    more = {"BatchRequest": {"dry_run": True}, "TuningRequest": {"dry_run": True}, "LinkRequest": {"run_id": run["id"]}}
    tried = 0
    for method, path, operation in operations:
        content = operation.get("requestBody", {}).get("content", {})
        if method == "post" and "application/json" in content and path != "/api/v1/login":
            name = content["application/json"]["schema"]["$ref"].rpartition("/")[2]
            (example,) = description["components"]["schemas"][name]["examples"]
            assert client.post(path, json=example | more.get(name, {})).is_success, path
            tried += 1
    assert tried > 7


def test_what_no_id_names_is_not_found(client: httpx.Client, operations: list[tuple[str, str, Any]]) -> None:
    for method, path, _ in operations:
        address = re.sub(r"\{(id|slug)\}", "A" * 22, path).replace("{name}", "speed")
        body = {"label": None} if method == "patch" else None
        assert address == path or client.request(method, address, json=body).status_code == 404, (method, path)


def test_the_pages_types_are_generated_from_the_description(description: dict[str, Any], tmp_path: Path) -> None:
    source, target, committed = tmp_path / "openapi.json", tmp_path / "schema.gen.ts", "frontend/src/api/schema.gen.ts"
    source.write_text(json.dumps(description))
    node = shutil.which("node", path=os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]))
    assert node is not None, "make development brings node"
    output = ROOT / committed if os.environ.get("UPDATE_DOCS") else target
    subprocess.run(
        [node, "frontend/scripts/generate-api.mjs", source, output], cwd=ROOT, check=True, timeout=HANG_TIMEOUT
    )
    if output == target and target.read_text() != (ROOT / committed).read_text():  # thousands of lines: no diff of them
        pytest.fail(f"{committed} is not what the description gives: UPDATE_DOCS=1 writes it anew")


@pytest.fixture
def built(tmp_path: Path) -> Path:
    """A built frontend, as far as the service cares."""
    for name, text in {
        "index.html": "<!doctype html><title>Ridelab</title>",
        "favicon.svg": "<svg/>",
        "assets/index-abc123.js": "export {}",
        "docs-assets/swagger-ui-bundle.js": "var SwaggerUIBundle",
    }.items():
        path = tmp_path / "dist" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return tmp_path / "dist"


def site(page: Path) -> FastAPI:
    """Return an application that was not started: pages need neither store nor workers."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(app, "BUILT_PAGE", page)
        return app.create_app(Settings())


def test_the_dashboard_is_served_at_its_addresses(built: Path) -> None:
    there = site(built)
    for path in ("/", "/r/AAAAAAAAAAAAAAAAAAAAAA", "/b/AAAAAAAAAAAAAAAAAAAAAA"):
        page = ask(there, "GET", path)
        assert (page.status_code, page.headers["cache-control"], "Ridelab" in page.text) == (200, "no-cache", True)
        assert page.headers["content-type"].startswith("text/html")
    for path, kind in (("/favicon.svg", "image/svg+xml"), ("/docs-assets/swagger-ui-bundle.js", "text/javascript")):
        assert ask(there, "GET", path).headers["content-type"].startswith(kind)
    for path in ("/r/a/b", "/index.htm", "/s", "/b"):
        assert ask(there, "GET", path).status_code == 404


def test_a_script_comes_compressed_where_it_was_and_who_asks_takes_it(built: Path) -> None:
    there, script = site(built), "/assets/index-abc123.js"
    assert "content-encoding" not in ask(there, "GET", script).headers  # none was made
    (built / "assets/index-abc123.js.br").write_bytes(bytes.fromhex("0b0480657870") + b"ort {}\x03")
    small = ask(there, "GET", script, headers={"Accept-Encoding": "gzip, br;q=0.9"})
    assert (small.headers["content-encoding"], small.headers["vary"]) == ("br", "Accept-Encoding")
    assert small.headers["content-type"].startswith("text/javascript")
    assert "immutable" in small.headers["cache-control"]
    for without in ("gzip", "gzip, br;q=0", "br; q=0.000"):
        plain = ask(there, "GET", script, headers={"Accept-Encoding": without})
        assert (plain.text, "content-encoding" in plain.headers) == ("export {}", False)
    assert ask(there, "GET", f"{script}.br").status_code == 404, "no script"


def test_an_unknown_address_is_a_page_to_a_browser_and_a_problem_to_a_script(built: Path) -> None:
    browser = "text/html,application/xhtml+xml,*/*;q=0.8"
    none = site(built.parent / "none")
    assert ask(none, "GET", "/").status_code == 503, "no dashboard was built"
    for path in ("/assets/index.js", "/docs-assets/swagger-ui.css"):
        assert ask(none, "GET", path).status_code == 404
    page = ask(site(built), "GET", "/nowhere", headers={"Accept": browser})
    assert (page.status_code, page.headers["content-type"]) == (404, "text/html; charset=utf-8")
    assert "Ridelab" in page.text
    for path, accept in (("/nowhere", "*/*"), ("/api/v1/nowhere", browser), ("/assets/x.js", "*/*")):
        answer = ask(site(built), "GET", path, headers={"Accept": accept})
        assert (answer.status_code, answer.headers["content-type"]) == (404, "application/problem+json")


def test_each_strategy_says_which_fields_it_reads(client: httpx.Client) -> None:
    """That schema, catalogue, presets and vehicles are the core's is in tests/client/test_in_process.py."""
    answered = client.get("/api/v1/strategies").json()
    expected = {name: list(reads(strategy)) for name, strategy in STRATEGIES.items()}
    assert {each["id"]: each["reads"] for each in answered if not each["own"]} == expected
