"""The paper page where hardware in the loop has no numbers: its eight cells are not counted, the others stand."""

from collections.abc import Iterator
from typing import Any

import httpx
import pytest

from backend.paper import models
from backend.settings import Settings
from tests.api.conftest import Service, serve
from tests.client.cli import Cli
from tests.html import check, read
from tests.servers.reproduction import store_without_ecu

REASON = "Nobody drove there"


@pytest.fixture(scope="module")
def gaps(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    for service in serve(Settings(data_dir=tmp_path_factory.mktemp("data"), workers=1, batch_workers=1)):
        store_without_ecu(service.app.state.store, REASON)
        yield service


@pytest.fixture
def command(gaps: Service, capfdbinary: pytest.CaptureFixture[bytes], monkeypatch: pytest.MonkeyPatch) -> Cli:
    monkeypatch.setenv("RIDELAB_SERVER", str(gaps.client.base_url))
    return Cli(capfdbinary)


def paper(service: Service, path: str = "", **query: str) -> httpx.Response:
    answer = service.client.get(f"/api/v1/paper{path}", params=query)
    assert answer.status_code == 200, answer.text
    return answer


def by_verdict(cells: list[dict[str, Any]]) -> dict[str, int]:
    verdicts = [cell["verdict"] for cell in cells]
    return {verdict: verdicts.count(verdict) for verdict in verdicts}


def test_of_the_paper_the_simulated_cells_stand(gaps: Service, command: Cli) -> None:
    answer = paper(gaps).json()
    models.PaperAnswer.model_validate(answer)
    missing = [cell for cell in answer["cells"] if cell["verdict"] == "unavailable"]
    assert answer["unavailable"] == {"cells": len(missing), "reason": REASON}
    assert {(cell["table"], cell["strategy"]) for cell in missing} == {(9, "lv_hil"), (10, "lv_hil")}
    assert (len(answer["cells"]), len(missing), answer["total"]) == (48, 8, 40)
    for cell in missing:
        assert cell["our_value"] is cell["our_change"] is cell["ci"] is cell["certain"] is None
        assert cell["our_base"] > 0
        assert cell["without_preview"]["verdict"] == "unavailable"
    assert answer["counts"] | {"unavailable": 8} == by_verdict(answer["cells"])
    assert sum(answer["without_preview"]["counts"].values()) == 40
    lines = command("paper").splitlines()
    assert sum("not available" in line for line in lines[1:49]) == 8
    assert f"8 cells not available here. {REASON}" in lines
    assert lines[-1].startswith(f"{answer['reached']} of 40 cells reached")


def test_so_do_they_in_the_report(gaps: Service) -> None:
    page = read(paper(gaps, "/report.html").text)
    check(page)
    assert next(page.all("h1")).text.endswith(" of 40 cells reached, 8 not available here")
    assert f"not counted. {REASON}." in page.text
    judged = [row for row in page.all("tr") if row.attributes.get("data-verdict") == "unavailable"]
    assert [row.text.count("not available") for row in judged] == [2] * 8
