"""A service with shipped settings, one for all drills of a file."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.servers.process import Api


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where it stores what it has."""
    return tmp_path_factory.mktemp("drill")


@pytest.fixture(scope="module")
def api(folder: Path) -> Iterator[Api]:
    """The service, ready."""
    with Api(folder) as api:
        api.wait_until_ready()
        yield api
