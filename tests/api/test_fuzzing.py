"""The service answers requests that schemathesis makes as its own description says; the drill has many more of them."""

from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from backend.settings import Settings
from tests.api.conftest import serve
from tests.drill.test_fuzzing import fuzz

LONG = "/paper|/tunings|/fmus|/controller|/solve"  # of which one request takes seconds


@pytest.fixture
def client(tmp_path: Path) -> Iterator[httpx.Client]:
    """A service of which no request takes long."""
    yield from serve(Settings(data_dir=tmp_path, workers=2, max_request_cost=0.5, max_batch_cost=5))


def test_answers_are_as_described(client: httpx.Client, tmp_path: Path) -> None:
    fuzz(
        client,
        tmp_path,
        *("--max-examples", "2", "--seed", "1", "--request-timeout", "120", "--exclude-path-regex", LONG),
        phases=["Fuzzing"],
    )
