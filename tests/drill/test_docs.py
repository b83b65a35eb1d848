"""Pages of docs whose commands take long show what these print; UPDATE_DOCS=1 writes it there."""

import os
from pathlib import Path

import httpx
import pytest

from sim_core.study import causes
from sim_core.study.paper import SEEDS
from tests.api.test_cli_docs import check
from tests.api.test_paper_docs import PAGE, with_blocks


def test_robustness_md(client: httpx.Client, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    check("robustness.md", client, tmp_path, monkeypatch)


def test_the_causes_in_paper_md() -> None:
    page = PAGE.read_text(encoding="utf-8")
    block = {"causes": causes.page(range(1, SEEDS + 1))}
    if os.environ.get("UPDATE_DOCS"):
        PAGE.write_text(with_blocks(page, block), encoding="utf-8")
    else:
        assert with_blocks(page, block) == page
