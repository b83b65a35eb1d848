"""Pages of docs whose commands take long show what these print; UPDATE_DOCS=1 writes it there."""

import os
from collections.abc import Iterator
from pathlib import Path

import httpx
import pytest

from backend.paper.claims import SEEDS
from backend.settings import Settings
from tests.api.conftest import serve
from tests.api.test_cli_docs import check
from tests.api.test_paper_docs import PAGE, with_blocks
from tests.docs import causes
from tests.servers.reproduction import store_in


@pytest.fixture
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    for service in serve(Settings(data_dir=tmp_path_factory.mktemp("data"), workers=2)):
        store_in(service.services.store)
        yield service


@pytest.mark.parametrize(
    "name",
    [
        "explanation/robustness.md",
        "how-to/fmu.md",
        "how-to/fuzzy-controller.md",
        "how-to/hil.md",
        "how-to/measured-road.md",
        "how-to/own-controller.md",
        "how-to/which-hump.md",
        "reference/cli.md",
        "tutorials/validate.md",
    ],
)
def test_a_page_shows_what_its_commands_print(
    name: str, client: httpx.Client, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    check(name, client, tmp_path, monkeypatch)


def test_the_causes_in_paper_md() -> None:
    page = PAGE.read_text(encoding="utf-8")
    block = {"causes": causes.page(range(1, SEEDS + 1))}
    if os.environ.get("UPDATE_DOCS"):
        PAGE.write_text(with_blocks(page, block), encoding="utf-8")
    else:
        assert with_blocks(page, block) == page
