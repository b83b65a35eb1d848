"""The pages of README and manual, by what in them can be run; a new page is found by itself."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
CELL = re.compile(r"^```python$", re.MULTILINE)
COMMAND = re.compile(r"^\$ ", re.MULTILINE)
CLIENT = re.compile(r"^(?:from|import) ridelab\b", re.MULTILINE)


def pages() -> dict[str, str]:
    """Return the text of each page, by its path in the repository."""
    files = [*ROOT.glob("*.md"), *ROOT.glob("[!.]*/README.md"), *(ROOT / "docs").rglob("*.md")]
    return {str(path.relative_to(ROOT)): path.read_text(encoding="utf-8") for path in sorted(files)}


def with_commands() -> list[str]:
    """Return the pages with commands after a `$`, or with cells of Python that ask a service."""
    return [
        name for name, text in pages().items() if COMMAND.search(text) or (CELL.search(text) and CLIENT.search(text))
    ]


def with_cells_alone() -> list[str]:
    """Return the pages with cells of Python that need no service."""
    asking = with_commands()
    return [name for name, text in pages().items() if CELL.search(text) and name not in asking]
