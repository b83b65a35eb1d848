"""OpenAPI, its page, and the answers that describe the core.

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

from backend import app
from backend.http.openapi import FIELDS, FIELDS_OF_MODELS
from backend.library.models import PresetAnswer
from backend.settings import Settings
from sim_core.catalogue import SIGNALS
from sim_core.check_controller import ID
from sim_core.scenario import SCHEMA_VERSION, Scenario
from sim_core.scenario.data_sheet import DataSheet
from sim_core.scenario.presets import PRESETS
from sim_core.strategies import STRATEGIES, reads
from tests.servers import loops
from tests.servers.process import HANG_TIMEOUT

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def description(client: httpx.Client) -> Any:
    response = client.get("/openapi.json")
    assert response.status_code == 200
    return response.json()


def test_operations_have_names_of_their_own(description: dict[str, Any]) -> None:
    """Programs that others generate call them so; which addresses there are docs/reference/api.md says."""
    assert description["openapi"].startswith("3.1")
    operations = [each for methods in description["paths"].values() for each in methods.values()]
    names = [operation["operationId"] for operation in operations]
    assert len(set(names)) == len(names)
    assert all(re.fullmatch("[a-z]+[A-Za-z]*", name) for name in names)
    assert all(operation["description"] for operation in operations)


def test_every_address_is_documented_with_its_parameters(description: dict[str, Any]) -> None:
    rows = re.findall(
        r"^\| `([A-Z]+ /[^`]*)` \|([^|]*)\| [^|]+ \|$", (ROOT / "docs/reference/api.md").read_text(), re.MULTILINE
    )
    assert {address: re.findall("`([^`]+)`", names) for address, names in rows} == {
        f"{method.upper()} {path}": [item["name"] for item in operation.get("parameters", []) if item["in"] == "query"]
        for path, methods in description["paths"].items()
        for method, operation in methods.items()
    }


def test_every_body_has_an_example_that_is_taken(
    client: httpx.Client, description: dict[str, Any], run: dict[str, Any]
) -> None:
    bodies = {
        path: operation["requestBody"]["content"]["application/json"]["schema"]["$ref"].rpartition("/")[2]
        for path, operations in description["paths"].items()
        for operation in operations.values()
        if "application/json" in operation.get("requestBody", {}).get("content", {})
    }
    assert len(bodies) > 7
    for path, name in bodies.items():
        (example,) = description["components"]["schemas"][name]["examples"]
        if name in ("BatchRequest", "TuningRequest"):
            example = {**example, "dry_run": True}
        elif name == "LinkRequest":
            example = {**example, "run_id": run["id"]}
        untried = ("/api/v1/login", "/api/v1/controller/report")  # takes 10 s
        if path not in untried and name != "LabelRequest":  # of a job, which tests/api/test_batches.py has
            assert client.post(path, json=example).is_success, path


def test_headers_tags_links_and_names_are_described(description: dict[str, Any]) -> None:
    operations = {each["operationId"]: each for methods in description["paths"].values() for each in methods.values()}
    assert {name for each in operations.values() for name in each["tags"]} == {
        tag["name"] for tag in description["tags"] if tag["description"]
    }
    for operation in operations.values():
        for status, answer in operation["responses"].items():
            assert "X-Request-ID" in answer["headers"]
            assert ("Retry-After" in answer["headers"]) is (status in ("429", "503"))
            assert answer["description"] not in ("", "Successful Response")
        for link in (link for answer in operation["responses"].values() for link in answer.get("links", {}).values()):
            parameters = {parameter["name"] for parameter in operations[link["operationId"]]["parameters"]}
            assert set(link["parameters"]) <= parameters
    assert all(header["description"] for header in description["components"]["headers"].values())
    schemas = description["components"]["schemas"]
    for name in ("Batch", "Tuning", "TuningItem"):
        assert "queued" in schemas[name]["properties"]["state"]["enum"]
    assert schemas["BatchRow"]["properties"]["strategy"]["pattern"] == ID
    assert all(parameter["description"] for each in operations.values() for parameter in each.get("parameters", ()))


def test_schemas_have_titles_of_their_own_and_every_field_is_described(description: dict[str, Any]) -> None:
    """Generators name types by titles, and put descriptions beside each field."""
    schemas = description["components"]["schemas"]
    titles = [schema["title"] for schema in schemas.values()]
    assert len(set(titles)) == len(titles)
    fields = {
        f"{name}.{field}": each
        for name, schema in schemas.items()
        for field, each in schema.get("properties", {}).items()
    }
    assert [name for name, each in fields.items() if not each.get("description")] == []
    unused = {field for field in FIELDS if not any(each["description"] == FIELDS[field] for each in fields.values())}
    assert unused | (FIELDS_OF_MODELS.keys() - fields.keys()) == set()


def test_what_no_id_names_is_not_found(client: httpx.Client, description: dict[str, Any]) -> None:
    for path, operations in description["paths"].items():
        address = re.sub(r"\{(id|slug)\}", "A" * 22, path).replace("{name}", "speed")
        for method in operations if address != path else ():
            body = {"label": None} if method == "patch" else None
            assert client.request(method, address, json=body).status_code == 404, (method, path)


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


def visitor(page: Path) -> httpx.AsyncClient:
    """Return a client of an application that was not started: pages need neither store nor workers."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(app, "BUILT_PAGE", page)
        made = app.create_app(Settings())
    return httpx.AsyncClient(transport=httpx.ASGITransport(app=made), base_url="http://ridelab")


def test_the_dashboard_is_served_at_its_addresses(built: Path) -> None:
    async def visit() -> None:
        async with visitor(built) as client:
            for path in ("/", "/r/AAAAAAAAAAAAAAAAAAAAAA", "/b/AAAAAAAAAAAAAAAAAAAAAA"):
                page = await client.get(path)
                assert page.status_code == 200
                assert page.headers["content-type"].startswith("text/html")
                assert page.headers["cache-control"] == "no-cache"
                assert "Ridelab" in page.text
            hashed = await client.get("/assets/index-abc123.js")
            assert "immutable" in hashed.headers["cache-control"]
            assert hashed.headers["content-type"].startswith("text/javascript")
            assert "content-encoding" not in hashed.headers  # none was made
            (built / "assets/index-abc123.js.br").write_bytes(bytes.fromhex("0b0480657870") + b"ort {}\x03")
            small = await client.get("/assets/index-abc123.js", headers={"Accept-Encoding": "gzip, br;q=0.9"})
            assert (small.headers["content-encoding"], small.headers["vary"]) == ("br", "Accept-Encoding")
            assert small.headers["content-type"].startswith("text/javascript")
            assert "immutable" in small.headers["cache-control"]
            for without in ("gzip", "gzip, br;q=0", "br; q=0.000"):
                plain = await client.get("/assets/index-abc123.js", headers={"Accept-Encoding": without})
                assert (plain.text, "content-encoding" in plain.headers) == ("export {}", False)
            assert (await client.get("/assets/index-abc123.js.br")).status_code == 404, "no script"
            assert (await client.get("/favicon.svg")).headers["content-type"] == "image/svg+xml"
            assert (await client.get("/docs-assets/swagger-ui-bundle.js")).status_code == 200
            for path in ("/r/a/b", "/index.htm", "/s", "/b"):
                assert (await client.get(path)).status_code == 404

    loops.run(visit)


def test_an_unknown_address_is_a_page_to_a_browser_and_a_problem_to_a_script(built: Path) -> None:
    async def visit() -> None:
        browser = {"Accept": "text/html,application/xhtml+xml,*/*;q=0.8"}
        async with visitor(built.parent / "none") as client:
            assert (await client.get("/")).status_code == 503, "no dashboard was built"
        async with visitor(built) as client:
            page = await client.get("/nowhere", headers=browser)
            assert (page.status_code, page.headers["content-type"]) == (404, "text/html; charset=utf-8")
            assert "Ridelab" in page.text
            for path, accept in (("/nowhere", "*/*"), ("/api/v1/nowhere", browser["Accept"]), ("/assets/x.js", "*/*")):
                answer = await client.get(path, headers={"Accept": accept})
                assert (answer.status_code, answer.headers["content-type"]) == (404, "application/problem+json")

    loops.run(visit)


def test_the_core_is_described_as_it_is(client: httpx.Client) -> None:
    schema, presets, strategies, catalogue = (
        client.get(f"/api/v1/{name}").json() for name in ("schema", "presets", "strategies", "catalogue")
    )
    assert schema.pop("schema_version") == SCHEMA_VERSION
    assert schema.pop("data_sheet") == json.loads(json.dumps(DataSheet.model_json_schema()))
    assert schema == json.loads(json.dumps(Scenario.model_json_schema()))
    assert next(iter(PRESETS)) == "paper"
    assert [(each.id, each.scenario) for each in map(PresetAnswer.model_validate, presets)] == [
        (name, preset.scenario) for name, preset in PRESETS.items()
    ]
    assert [(each["id"], tuple(each["reads"])) for each in strategies] == [
        (name, reads(strategy)) for name, strategy in STRATEGIES.items()
    ]
    assert {each["key"]: each["unit"] for each in catalogue["signals"]} == {
        key: quantity.unit for key, quantity in SIGNALS.items()
    }


def test_health(client: httpx.Client) -> None:
    assert client.get("/healthz").json() == {"status": "ok"}
    assert client.get("/readyz").json() == {
        "status": "ready",
        "store": True,
        "workers": True,
        "reason": None,
        "controllers": {},
    }
