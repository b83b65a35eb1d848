"""The pages of docs/ name what the code has."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from sim_core import reference
from sim_core.catalogue import SIGNALS
from sim_core.scenario import Scenario
from sim_core.scenario.presets import PRESETS
from sim_core.strategies import STRATEGIES
from sim_core.study import errata

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def words() -> str:
    """README and all of docs/ as one text."""
    return "\n".join(path.read_text() for path in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))])


def fields() -> list[str]:
    """Dotted names of the scenario's fields."""
    parts = Scenario.model_fields
    return [f"{part}.{field}" for part in parts for field in type(getattr(Scenario(), part)).model_fields]


def test_every_field_is_documented(words: str) -> None:
    missing = [name for name in fields() if name.split(".")[-1] not in words]
    assert not missing


@pytest.mark.parametrize("names", [STRATEGIES, PRESETS, SIGNALS], ids=["strategies", "presets", "signals"])
def test_every_name_is_documented(words: str, names: dict[str, object]) -> None:
    assert not [name for name in names if name not in words]


@pytest.mark.parametrize(("page", "name"), [(reference.page, "scenario.md"), (errata.page, "errata.md")])
def test_a_reference_page_is_what_the_core_says(page: Callable[[], str], name: str) -> None:
    """UPDATE_DOCS=1 writes it."""
    path = ROOT / "docs" / name
    if os.environ.get("UPDATE_DOCS"):
        path.write_text(page(), encoding="utf-8")
    assert path.read_text(encoding="utf-8") == page()
