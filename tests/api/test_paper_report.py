"""The paper's report, as it is served: what it says is what GET /paper and its neighbours say."""

import json
from typing import Any

import httpx
import plotly.graph_objects as go
import pytest

from tests.html import Element, check, read


@pytest.fixture(scope="module")
def answers(client: httpx.Client, reproduced: None) -> dict[str, Any]:
    """The answers in the report."""
    names = ("paper", "paper/attribution", "paper/figures")
    return {name: client.get(f"/api/v1/{name}").raise_for_status().json() for name in names}


@pytest.fixture(scope="module")
def page(client: httpx.Client, answers: dict[str, Any]) -> Element:
    response = client.get("/api/v1/paper/report.html")
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
