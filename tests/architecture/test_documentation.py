"""The reference pages of docs/ are what the code says: every field, preset, strategy, signal and erratum."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from backend.paper import errata
from tests.docs import scenario_reference

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize(("page", "name"), [(scenario_reference.page, "scenario.md"), (errata.page, "errata.md")])
def test_a_reference_page_is_what_the_core_says(page: Callable[[], str], name: str) -> None:
    """UPDATE_DOCS=1 writes it."""
    path = ROOT / "docs" / name
    if os.environ.get("UPDATE_DOCS"):
        path.write_text(page(), encoding="utf-8")
    assert path.read_text(encoding="utf-8") == page()
