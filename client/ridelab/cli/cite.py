"""`ridelab cite`: how to name Ridelab, and the paper whose system it rebuilds, in a text."""

from typing import Annotated, Any

from ridelab import __version__
from ridelab.cli.options import AsJson, flag
from ridelab.cli.reporting import say

TITLE = "Ridelab: a what-if laboratory for active suspension over bumps"
AUTHOR = "The Ridelab maintainers"
PAPER_AUTHORS = ["Meng", "Kong", "Ding", "Liu", "Wang"]
PAPER = {
    "title": "Research on Active Suspension Control Based on Vehicle Speed Control Under Transient Pavement Excitation",
    "journal": "World Electric Vehicle Journal",
    "volume": "16",
    "number": "4",
    "pages": "232",
    "year": "2025",
    "doi": "10.3390/wevj16040232",
}


def cite(
    bibtex: Annotated[bool, flag("As entries for BibTeX.", "--bibtex")] = False,
    as_json: AsJson = False,
) -> None:
    """Say how to cite Ridelab and the paper whose system it rebuilds; --json is CSL-JSON, as citation managers read."""
    if bibtex:
        ours = {"title": TITLE, "author": f"{{{AUTHOR}}}", "version": __version__}
        paper = {"author": " and ".join(PAPER_AUTHORS), **PAPER}
        text = "\n".join((_entry("software", "ridelab", ours), _entry("article", "meng2025", paper)))
    else:
        *first, last = PAPER_AUTHORS
        issue = f"{PAPER['journal']} {PAPER['volume']}({PAPER['number']}), {PAPER['pages']}, {PAPER['year']}"
        text = (
            f"{AUTHOR}. {TITLE}. Version {__version__}.\n"
            f"{', '.join(first)} and {last}. {PAPER['title']}. {issue}. doi:{PAPER['doi']}"
        )
    say(text, _csl(), as_json=as_json)


def _entry(kind: str, key: str, fields: dict[str, str]) -> str:
    lines = [f"  {name} = {{{value}}}," for name, value in fields.items()]
    return "\n".join([f"@{kind}{{{key},", *lines, "}"])


def _csl() -> list[dict[str, Any]]:
    """Both as items of the Citation Style Language."""
    ours = {
        "id": "ridelab",
        "type": "software",
        "title": TITLE,
        "author": [{"literal": AUTHOR}],
        "version": __version__,
    }
    paper = {
        "id": "meng2025",
        "type": "article-journal",
        "title": PAPER["title"],
        "author": [{"family": name} for name in PAPER_AUTHORS],
        "container-title": PAPER["journal"],
        "volume": PAPER["volume"],
        "issue": PAPER["number"],
        "page": PAPER["pages"],
        "issued": {"date-parts": [[int(PAPER["year"])]]},
        "DOI": PAPER["doi"],
    }
    return [ours, paper]
