"""`ridelab cite`: how to name Ridelab, and the paper whose system it rebuilds, in a text."""

import json
from pathlib import Path
from typing import Annotated, Any

from ridelab import __version__
from ridelab.cli.options import AsJson, flag
from ridelab.cli.reporting import say

_CITED = Path(__file__).with_name("cite.json")  # both as items of the Citation Style Language
_IN_BIBTEX = {
    "title": "title",
    "container-title": "journal",
    "volume": "volume",
    "issue": "number",
    "page": "pages",
    "year": "year",
    "DOI": "doi",
    "version": "version",
}


def cite(
    bibtex: Annotated[bool, flag("As entries for BibTeX.", "--bibtex")] = False,
    as_json: AsJson = False,
) -> None:
    """Say how to cite Ridelab and the paper whose system it rebuilds; --json is CSL-JSON, as citation managers read."""
    ours, paper = json.loads(_CITED.read_bytes())
    ours["version"] = __version__
    author, authors = ours["author"][0]["literal"], [each["family"] for each in paper["author"]]
    year = paper["issued"]["date-parts"][0][0]
    if bibtex:
        entries = (("software", ours, f"{{{author}}}"), ("article", {**paper, "year": year}, " and ".join(authors)))
        text = "\n".join(_entry(*each) for each in entries)
    else:
        *first, last = authors
        issue = f"{paper['container-title']} {paper['volume']}({paper['issue']}), {paper['page']}, {year}"
        text = (
            f"{author}. {ours['title']}. Version {__version__}.\n"
            f"{', '.join(first)} and {last}. {paper['title']}. {issue}. doi:{paper['DOI']}"
        )
    say(text, [ours, paper], as_json=as_json)


def _entry(kind: str, item: dict[str, Any], author: str) -> str:
    fields = {"author": author} | {name: item[key] for key, name in _IN_BIBTEX.items() if key in item}
    lines = [f"  {name} = {{{value}}}," for name, value in fields.items()]
    return "\n".join([f"@{kind}{{{item['id']},", *lines, "}"])
