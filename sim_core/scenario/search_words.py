"""What people may look for a field of the scenario by, beside its title and help: search_words.toml has it."""

import tomllib
from functools import cache
from pathlib import Path


@cache
def search_words() -> dict[str, dict[str, str]]:
    """Return the words by part and field."""
    words: dict[str, dict[str, str]] = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))
    return words


def search_terms(words: str) -> list[str]:
    """Return the single words, and behind them the phrases."""
    single, *phrases = words.split(",")
    return [*single.split(), *map(str.strip, phrases)]
