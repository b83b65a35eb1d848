"""What is printed in the paper and what Ridelab uses instead, from errata.toml; docs/reference/errata.md shows it."""

import tomllib
from pathlib import Path

from backend.paper.models import Erratum

_DATA = tomllib.loads(Path(__file__).with_name("errata.toml").read_text(encoding="utf-8"))
ERRATA = [Erratum(**entry) for entry in _DATA["erratum"]]


def page() -> str:
    """Return the text of docs/reference/errata.md."""
    rows = "".join(f"| {item.place} | {item.printed} | {item.here} |\n" for item in ERRATA)
    return f"{_DATA['head']}{rows}{_DATA['tail']}"
