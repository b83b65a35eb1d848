"""The service answers as its own OpenAPI description says, whatever is sent; `make drill` does this at length."""

from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from backend.settings import Settings
from tests.api.conftest import serve
from tests.api.fuzzing import fuzz


@pytest.fixture(scope="module")
def modest(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    """A service that refuses what takes long: here answers count, not computing."""
    limits = {"max_request_cost": 0.1, "max_batch_runs": 20, "max_batch_cost": 0.2}
    for service in serve(
        Settings.model_validate(
            {"data_dir": tmp_path_factory.mktemp("fuzzed"), "workers": 1, "batch_workers": 1, **limits}
        )
    ):
        yield service.client


def test_every_answer_is_as_described(modest: httpx.Client, tmp_path: Path) -> None:
    fuzz(modest, tmp_path, "--max-examples", "1", "--seed", "1", short=True)
