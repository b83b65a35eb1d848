"""The paper's report, as it is served: what it says is what GET /paper and its neighbours say."""

import json
from pathlib import Path
from typing import Any

import httpx
import plotly.graph_objects as go
import pytest

from ridelab.cli import app
from tests.html import Element, check, read
from tests.servers.reproduction import requests, rows, store_as

SEEDS = 22  # nobody else asks for so many


@pytest.fixture(scope="module")
def answers(service: Any, reproduced: None) -> dict[str, Any]:
    """The answers in the report: the reproduction on 20 roads, stored as if they were 22."""
    for row in requests(range(21, SEEDS + 1)):
        changes = {**json.loads(row.changes), "road.seed": json.loads(row.changes)["road.seed"] - 20}
        like = next(
            each for each in requests() if each.strategy == row.strategy and json.loads(each.changes) == changes
        )
        store_as(service.app.state.store, [row], [rows()[like.key]])
    answers: dict[str, Any] = {}
    for name in ("paper", "paper/attribution", "paper/figures"):
        response = service.client.get(f"/api/v1/{name}", params={"seeds": SEEDS})
        assert response.status_code == 200, response.text
        answers[name] = response.json()
    assert answers["paper"]["seeds"] == SEEDS
    return answers


@pytest.fixture(scope="module")
def page(client: httpx.Client, answers: dict[str, Any]) -> Element:
    response = client.get("/api/v1/paper/report.html", params={"seeds": SEEDS})
    assert response.status_code == 200, response.text[:300]
    assert "script-src 'sha256-" in response.headers["content-security-policy"]
    assert response.headers["content-disposition"] == 'inline; filename="ridelab-paper.html"'
    assert len(response.content) <= 1.5e6
    root = read(response.text)
    check(root)
    return root


def test_its_count_is_that_of_its_cells(page: Element, answers: dict[str, Any]) -> None:
    answer = answers["paper"]
    rows = {str(row.attributes["data-judged"]): row for row in page.all("tr") if "data-judged" in row.attributes}
    assert len(rows) == answer["total"]
    verdicts = [row.attributes["data-verdict"] for row in rows.values()]
    assert verdicts.count("reached") == answer["reached"]
    assert f"{answer['reached']} of {answer['total']} cells reached" in next(page.all("h1")).text
    assert f"Without preview of the road: {answer['without_preview']['reached']} of" in page.text
    for item in answer["interpretations"]:
        (row,) = (row for row in page.all("tr") if row.attributes.get("data-interpretation") == item["id"])
        shown = [cell.text for cell in row.all("td")]
        near = (item["agreement"]["within"], item["agreement"]["in_interval"])
        parts = (item, item["simulated"], item["ecu"])
        assert shown == [
            *(f"{part['reached']} of {part['total']}" for part in parts),
            *(f"{number} of 40" for number in near),
        ]
    for cell in answer["cells"]:
        row = rows[f"{cell['table']}.{cell['strategy']}.{cell['against']}.{cell['signal']}"]
        assert float(str(row.attributes["data-value"])) == cell["our_change"]
        assert row.attributes["data-verdict"] == cell["verdict"]
        assert cell["verdict"] in row.text
        assert ("misprint" in row.text) == (cell["misprint"] is not None)
        blind = cell["without_preview"]
        judgements = [cell, *([blind] if blind else [])]
        assert row.text.count("not certain") == sum(not item["certain"] for item in judgements)
        assert ("looks ahead" in row.text) == (blind is None)


def test_it_has_every_figure_erratum_rule_sentence_and_share(page: Element, answers: dict[str, Any]) -> None:
    figures = json.loads(next(page.all("script", id="figures")).text)
    assert list(figures) == [f"figure-{item['number']}" for item in answers["paper/figures"]["figures"]]
    headings = [heading.text for heading in page.all("h3")]
    for item in answers["paper/figures"]["figures"]:
        go.Figure(figures[f"figure-{item['number']}"])
        assert any(text.startswith(f"Fig. {item['number']}: {item['title']}") for text in headings)
    for item in answers["paper"]["errata"]:
        assert item["here"].replace("`", "") in page.text
    for text in answers["paper"]["rules"].values():
        assert text in page.text
    plain = page.text.replace("−", "-")
    for text in answers["paper/attribution"]["sentences"]:
        assert text.replace("−", "-") in plain
    shown = [float(str(cell.attributes["data-value"])) for cell in page.all("td") if "data-share" in cell.attributes]
    assert shown == [
        item[factor] for item in answers["paper/attribution"]["shares"] for factor in ("speed", "preview", "switching")
    ]


@pytest.fixture
def command(client: httpx.Client, capfdbinary: pytest.CaptureFixture[bytes]) -> Any:
    """The command in this process: its exit code, output and errors."""

    def run(*arguments: str) -> tuple[int, str, str]:
        roads = () if "--seeds" in arguments else ("--seeds", str(SEEDS))
        code = app.run(["paper", *roads, "--server", str(client.base_url), *arguments])
        captured = capfdbinary.readouterr()
        return code, captured.out.decode(), captured.err.decode()

    return run


def test_the_command_answers_machines_and_writes_the_report(
    command: Any, answers: dict[str, Any], page: Element, tmp_path: Path
) -> None:
    file = tmp_path / "paper.html"
    same = ("--seeds", f"1-{SEEDS}", "--interpretation", "default", "--reading", "preview=lookahead")
    code, printed, errors = command("--json", "--report", str(file), *same)
    assert code == 0
    assert json.loads(printed) == answers["paper"]
    assert str(file) in errors
    assert read(file.read_text(encoding="utf-8")).text == page.text


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (
            ["--reading", "preview=crystal_ball"],
            "preview: Input should be 'lookahead', 'obstacle', 'wheelbase' or 'none'",
        ),
        (["--reading", "preview"], "--reading takes READING=CHOICE"),
        (["--reading", "preview=none", "--reading", "preview=none"], "--reading: one is given twice"),
        (["--report", "/nowhere/paper.html"], "--report: there is no folder /nowhere"),
        (["--seeds", "few"], "--seeds takes N or A-B"),
    ],
)
def test_the_command_refuses_what_there_is_not(command: Any, arguments: list[str], said: str) -> None:
    code, printed, errors = command(*arguments)
    assert code == 2
    assert printed == ""
    assert said in errors
