"""What commands print with --json, for programs to read, and how to cite, for them and for people."""

import io
import json
import sys
import zipfile
from collections.abc import Iterator
from typing import Any

import pytest
import typer
import yaml

from ridelab.cli import app
from tests.client.cli import ROOT, Cli
from tests.client.conftest import ADDRESS, RUN, SHORT, Prepared

EMPTY_ZIP = b"PK\5\6" + bytes(18)


def commands(group: Any, *before: str) -> Iterator[tuple[tuple[str, ...], Any]]:
    for name, each in group.commands.items():
        if hasattr(each, "commands"):
            yield from commands(each, *before, name)
        else:
            yield (*before, name), each


def test_every_command_answers_machines_too() -> None:
    without = [
        words
        for words, command in commands(typer.main.get_command(app.app))
        if not any("--json" in parameter.opts for parameter in command.params)
    ]
    assert without == []


def test_what_was_written_is_said_to_machines_and_in_a_terminal(
    cli: Cli, prepared: Prepared, monkeypatch: pytest.MonkeyPatch
) -> None:
    batch = prepared.job("batch", scenario=SHORT)
    prepared.answers[f"GET /batches/{batch}/results"] = b"a,b\n"
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w") as fmu:
        fmu.writestr("binaries/win64/lv.dll", b"")
    prepared.answers["POST /fmus"] = archive.getvalue()
    assert json.loads(cli("export", batch, "--out", "b.csv", "--json")) == {"file": "b.csv", "size": 4, "format": "csv"}
    written = {"file": "ridelab.fmu", "size": len(archive.getvalue()), "platforms": ["win64"]}
    assert json.loads(cli("fmu", "--json")) == written
    prepared.answers["POST /fmus"] = EMPTY_ZIP
    assert json.loads(cli("fmu", "--json", code=1))["platforms"] == [], "no tool loads it"
    assert (cli("export", batch, "--out", "b.csv"), cli.error) == ("", "")
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    assert (cli("export", batch, "--out", "b.csv"), cli.error) == ("", "b.csv: 4 bytes\n")
    assert json.loads(cli("open", RUN, "--print", "--json")) == {"address": f"{ADDRESS}/r/{RUN}"}


def test_how_to_cite_is_what_the_citation_file_says(cli: Cli) -> None:
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    (paper,) = citation["references"]
    authors = " and ".join(each["family-names"] for each in paper["authors"])
    bibtex = cli("cite", "--bibtex")
    for work, names in ((citation, ("title", "version")), (paper, ("title", "journal", "doi"))):
        assert all(f"  {name} = {{{work[name]}}},\n" in bibtex for name in names)
    assert f"  author = {{{authors}}},\n" in bibtex
    assert f"doi:{paper['doi']}\n" in cli("cite")
    ours, theirs = json.loads(cli("cite", "--json"))
    assert (ours["title"], ours["version"]) == (citation["title"], str(citation["version"]))
    assert (theirs["DOI"], [each["family"] for each in theirs["author"]]) == (paper["doi"], authors.split(" and "))
