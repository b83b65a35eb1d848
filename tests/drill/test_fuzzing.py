"""The service answers as its own OpenAPI description says: DRILL_EXAMPLES requests (100) of each operation.

Schemathesis makes them by DRILL_SEED (1).
"""

import json
import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import httpx
import pytest

from backend.settings import Settings
from tests.api.conftest import serve

EXAMPLES = int(os.environ.get("DRILL_EXAMPLES", "100"))
SEED = os.environ.get("DRILL_SEED", "1")
LONGEST_LINE, MOST_OUTPUT = 400, 50_000  # of what is told of failures [characters]


PHASES = ["Examples", "Coverage", "Fuzzing", "Stateful"]

CONFIGURATION = Path(__file__).with_name("schemathesis.toml")
SCENARIO = {"road": {"length": 120, "bump": {"start": 80}}}


def seed(client: httpx.Client) -> dict[str, str]:
    """A stored run, a finished batch, a tuning and a link, so that paths lead somewhere: their ids."""
    run = _good(client.post("/api/v1/runs", json={"scenario": SCENARIO, "strategies": ["lv", "passive"]}))
    sweep = {"grid": {"road.bump.height": [0.05, 0.1]}}
    batch = _good(client.post("/api/v1/batches", json={"scenario": SCENARIO, "strategies": ["lqr"], "sweep": sweep}))
    short = {"road": {"length": 30, "bump": {"start": 15}}, "speed": {"target_speed_kmh": 45}}
    small = {"scenario": short, "strategy": "lqr", "trials": 2, "seeds": [1], "fresh_seeds": [2, 3]}
    tuning = _good(client.post("/api/v1/tunings", json=small))
    link = _good(client.post("/api/v1/links", json={"run_id": run["id"], "view": {"baseline": "passive"}}))
    client.get(f"/api/v1/batches/{batch['id']}/events")  # a stream that ends with it
    assert _good(client.get(f"/api/v1/batches/{batch['id']}"))["state"] == "done"
    return {"RUN": run["id"], "BATCH": batch["id"], "TUNING": tuning["id"], "LINK": link["slug"]}


def fuzz(client: httpx.Client, folder: Path, *arguments: str, phases: Sequence[str] = PHASES) -> None:
    """Run schemathesis against the service behind `client`, with more of its options; any failure is told in full."""
    configuration = CONFIGURATION.read_text()
    for name, identifier in seed(client).items():
        configuration = configuration.replace(f'"{name}"', f'"{identifier}"')
    (folder / "schemathesis.toml").write_text(configuration)
    description = client.get("/openapi.json")  # made on the first request, for which schemathesis waits 10 s at most
    address = str(description.raise_for_status().url)
    command = [str(Path(sys.executable).parent / "schemathesis"), "--no-color", "--config-file", "schemathesis.toml"]
    command += ["run", address, "--phases", ",".join(phases).lower(), *arguments]
    ended = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    lines = (line[:LONGEST_LINE] for line in ended.stdout.splitlines())  # an address may have thousands of characters
    assert ended.returncode == 0, "\n".join(lines)[-MOST_OUTPUT:] + ended.stderr[-5_000:]
    for phase in phases:
        assert f"✅ {phase}" in ended.stdout or f"✅  {phase}" in ended.stdout, ended.stdout
    assert client.get("/readyz").status_code == 200


def _good(response: httpx.Response) -> Any:
    assert response.status_code < 300, response.text
    return json.loads(response.content)


@pytest.fixture
def client(tmp_path: Path) -> Iterator[httpx.Client]:
    """The shipped limits except for the cost, so that much is computed and nothing takes minutes."""
    settings = Settings(data_dir=tmp_path, workers=2, max_request_cost=3, max_batch_cost=20)
    yield from serve(settings)


@pytest.mark.timeout(1800 + 60 * EXAMPLES)
def test_every_answer_is_as_described(client: httpx.Client, tmp_path: Path) -> None:
    patience = ("--request-timeout", "120")  # the paper on 99 roads is computed anew
    fuzz(client, tmp_path, "--max-examples", str(EXAMPLES), "--seed", SEED, *patience)
