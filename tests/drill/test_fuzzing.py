"""Schemathesis at length: DRILL_EXAMPLES requests (100) of each operation, made by DRILL_SEED (1)."""

import os
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from backend.settings import Settings
from tests.api.conftest import serve
from tests.api.fuzzing import fuzz

EXAMPLES = int(os.environ.get("DRILL_EXAMPLES", "100"))
SEED = os.environ.get("DRILL_SEED", "1")


@pytest.fixture
def client(tmp_path: Path) -> Iterator[httpx.Client]:
    """The shipped limits except for the cost, so that much is computed and nothing takes minutes."""
    settings = Settings(data_dir=tmp_path, workers=2, max_request_cost=3, max_batch_runs=200, max_batch_cost=20)
    for service in serve(settings):
        yield service.client


@pytest.mark.timeout(60 + 60 * EXAMPLES)
def test_every_answer_is_as_described(client: httpx.Client, tmp_path: Path) -> None:
    patience = ("--request-timeout", "120")  # the paper on 99 roads is computed anew
    fuzz(client, tmp_path, "--max-examples", str(EXAMPLES), "--seed", SEED, *patience, short=False)
