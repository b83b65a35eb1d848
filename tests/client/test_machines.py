"""What commands print with --json, for programs to read, and how to cite, for them and for people."""

import io
import json
import sys
import zipfile
from collections.abc import Iterator
from typing import Any

import httpx
import pytest
import typer
import yaml

from ridelab.cli import app
from tests.client.cli import ROOT, Cli
from tests.client.conftest import ADDRESS, RUN, SHORT, Prepared


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
    bare = io.BytesIO()
    zipfile.ZipFile(bare, "w").close()
    prepared.answers["POST /fmus"] = bare.getvalue()
    assert json.loads(cli("fmu", "--json", code=1))["platforms"] == []
    assert cli.error.startswith("It has a binary for no platform: no tool loads it before its sources are compiled")
    cli("export", batch, "--out", "-", "--format", "csv", "--json", code=2)
    assert "name another one" in cli.error
    assert (cli("export", batch, "--out", "b.csv"), cli.error) == ("", "")
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    assert (cli("export", batch, "--out", "b.csv"), cli.error) == ("", "b.csv: 4 bytes\n")
    assert json.loads(cli("open", RUN, "--print", "--json")) == {"address": f"{ADDRESS}/r/{RUN}"}


def test_what_becomes_of_jobs_is_said_to_machines(cli: Cli, prepared: Prepared) -> None:
    batch = prepared.job("batch")
    path = f"/batches/{batch}"
    job = prepared.answers[f"GET {path}"]
    assert isinstance(job, dict)
    prepared.answers[f"PATCH {path}"] = {**job, "label": "mine"}
    prepared.answers[f"DELETE {path}"] = httpx.Response(204)
    assert json.loads(cli("jobs", "label", batch, "mine", "--json"))["label"] == "mine"
    assert json.loads(cli("jobs", "delete", batch, "--json")) == [{"kind": "batch", "id": batch}]


def test_how_to_cite_is_what_the_citation_file_says(cli: Cli) -> None:
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    (paper,) = citation["references"]
    authors = " and ".join(each["family-names"] for each in paper["authors"])
    bibtex = cli("cite", "--bibtex")
    for name, value in (
        ("title", citation["title"]),
        ("version", str(citation["version"])),
        ("title", paper["title"]),
        ("author", authors),
        ("journal", paper["journal"]),
        ("pages", str(paper["start"])),
        ("doi", paper["doi"]),
    ):
        assert f"  {name} = {{{value}}},\n" in bibtex
    assert f"doi:{paper['doi']}\n" in cli("cite")
    ours, theirs = json.loads(cli("cite", "--json"))
    assert (ours["title"], ours["version"]) == (citation["title"], str(citation["version"]))
    assert (theirs["DOI"], [each["family"] for each in theirs["author"]]) == (paper["doi"], authors.split(" and "))
