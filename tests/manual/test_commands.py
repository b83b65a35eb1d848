"""What README and manual show is what their commands and cells print, run here again in order.

`UPDATE_DOCS=1 python -m pytest tests/manual` prints the outputs into the pages anew.
"""

from collections.abc import Iterator
from pathlib import Path

import pytest

from backend.settings import Settings
from tests.api.conftest import serve
from tests.docs.commands import check
from tests.docs.sources import with_commands
from tests.servers.reproduction import store_in


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The address of a service that has the paper's reproduction stored."""
    for service in serve(Settings(data_dir=tmp_path_factory.mktemp("data"), workers=2)):
        store_in(service.services.store)
        yield str(service.base_url).rstrip("/")


@pytest.mark.parametrize("name", with_commands())
def test_a_page_shows_what_its_commands_print(
    name: str, address: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    check(name, address, tmp_path, monkeypatch)
