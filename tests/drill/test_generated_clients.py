"""Clients that others generate from the service's OpenAPI description compile, and call it."""

import json
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from backend.settings import Settings
from tests.api.conftest import Service, serve
from tests.servers.process import ROOT

PAGE = ROOT / "docs/reference/api.md"
GENERATOR = Path(sys.prefix) / "clients/bin/openapi-python-client"
PYTHON_CALLS = """
import io, json, math, sys
from ridelab_api import Client
from ridelab_api.api.batches import create_batch, get_batch
from ridelab_api.api.links import create_link, get_link
from ridelab_api.api.roads import create_road
from ridelab_api.api.runs import create_run, get_run
from ridelab_api.models import BatchRequest, LinkRequest, RunRequest
from ridelab_api.types import File

with Client(sys.argv[1]) as client:
    lines = ["distance [m],height [mm]", *(f"{x},{math.sin(x)}" for x in range(200))]
    road = create_road.sync(client=client, body=File(io.BytesIO("\\n".join(lines).encode())))
    body = RunRequest.from_dict({"scenario": {"road": {"profile": road.id}}, "strategies": ["passive"]})
    run = create_run.sync(client=client, body=body)
    assert run.strategies["passive"].travel_time > 0
    stored = get_run.sync(run.id, client=client)
    sweep = {"strategies": ["passive"], "sweep": {"grid": {"road.bump.height": [0.05, 0.06]}}}
    batch = create_batch.sync(client=client, body=BatchRequest.from_dict(sweep))
    assert get_batch.sync(batch.id, client=client).id == batch.id
    link = create_link.sync(client=client, body=LinkRequest.from_dict({"run_id": run.id}))
    opened = get_link.sync(link.slug, client=client)
print(json.dumps([stored.id == run.id, batch.total, opened.run.id == run.id, road.length]))
"""
CALLED = [True, 2, True, 199]


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    yield from serve(Settings(data_dir=tmp_path_factory.mktemp("data"), workers=1, batch_workers=1))


@pytest.fixture
def description(service: Service, tmp_path: Path) -> Path:
    path = tmp_path / "openapi.json"
    path.write_bytes(service.get("/openapi.json").content)
    return path


def run(folder: Path, *command: str | Path) -> str:
    """Run a program in a folder; returns what it prints."""
    programs = os.pathsep.join([str(GENERATOR.parent), str(Path(sys.executable).parent), os.environ["PATH"]])
    environment = {**os.environ, "PATH": programs}
    ended = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stdout[-5000:] + ended.stderr[-5000:]
    return ended.stdout


def test_a_client_by_openapi_python_client(service: Service, description: Path, tmp_path: Path) -> None:
    assert GENERATOR.exists(), "make drill brings it"
    (configuration,) = re.findall(r"```json\n(.*content_type_overrides.*\n(?:.*\n)*?)```", PAGE.read_text())
    (tmp_path / "config.json").write_text(configuration)
    options = ("--path", description, "--output-path", "ridelab_api", "--meta", "none", "--config", "config.json")
    assert "Warning" not in run(tmp_path, GENERATOR, "generate", *options, "--fail-on-warning")
    printed = run(tmp_path, GENERATOR.with_name("python"), "-c", PYTHON_CALLS, str(service.base_url))
    assert json.loads(printed) == CALLED


def test_a_client_by_openapi_typescript(service: Service, description: Path, tmp_path: Path) -> None:
    modules = ROOT / "frontend/node_modules"
    (tmp_path / "node_modules").symlink_to(modules)
    (tmp_path / "package.json").write_text('{"type": "module"}')
    shutil.copy(Path(__file__).with_name("generated_client.ts"), tmp_path)
    cli = modules / "openapi-typescript/bin/cli.js"
    run(tmp_path, "node", cli, description, "--output", "openapi.ts", "--default-non-nullable", "false")
    strictly = "--noEmit --strict --skipLibCheck --target es2023 --module nodenext --allowImportingTsExtensions"
    run(tmp_path, "node", modules / "typescript/bin/tsc", *strictly.split(), "--types", "node", "generated_client.ts")
    assert json.loads(run(tmp_path, "node", "generated_client.ts", str(service.base_url).rstrip("/"))) == CALLED
