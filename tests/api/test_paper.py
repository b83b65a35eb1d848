"""The paper page's answers against runs asked for one by one."""

import statistics
from collections.abc import Mapping
from typing import Any

import httpx
import pytest

from backend.errors import BusyError, TooManyRequestsError
from backend.job_run import JobRun
from backend.paper import models
from backend.paper.rows import MAX_CLIENT_JOBS, MAX_JOBS, PaperRows
from backend.store import Store
from sim_core import __version__ as CORE_VERSION
from tests.api.conftest import Service
from tests.servers.process import wait_until

PAPER = "/api/v1/paper"
FEW = 2  # roads that are driven anew

pytestmark = pytest.mark.usefixtures("reproduced")


@pytest.fixture(scope="module")
def answer(client: httpx.Client) -> Any:
    response = client.get(PAPER)
    assert response.status_code == 200, response.text
    return response.json()


def test_every_printed_change_has_a_cell_of_the_described_shape(answer: dict[str, Any]) -> None:
    models.PaperAnswer.model_validate(answer)
    assert answer["total"] == len(answer["cells"]) == 48
    assert [cell["verdict"] for cell in answer["cells"]].count("reached") == answer["reached"]
    assert sum(answer["counts"].values()) == 48
    for cell in answer["cells"]:
        assert cell["ci"][0] <= cell["our_change"] <= cell["ci"][1]
        assert (cell["without_preview"] is None) == (
            {cell["strategy"], cell["against"]} <= {"passive", "speed_only", "lqr"}
        )


def test_a_switch_changes_what_it_says(client: httpx.Client, answer: dict[str, Any]) -> None:
    blind = client.get(PAPER, params={"preview": "none"}).json()
    assert blind["scenario"]["mpc"]["preview"] == "none"
    assert blind["counts"] == answer["without_preview"]["counts"]
    by_place = {(cell["table"], cell["strategy"], cell["against"], cell["signal"]): cell for cell in answer["cells"]}
    for cell in blind["cells"]:
        without = by_place[cell["table"], cell["strategy"], cell["against"], cell["signal"]]["without_preview"]
        if without is not None:
            assert {key: cell[key] for key in without} == without


def test_the_named_sets_stand_beside_each_other_under_any_reading(client: httpx.Client, answer: dict[str, Any]) -> None:
    names = ["default", "favourable", "nearest"]
    pages = [answer, *(client.get(PAPER, params={"interpretation": name}).json() for name in names[1:])]
    assert [page["interpretation"] for page in pages] == [item["id"] for item in answer["interpretations"]] == names
    for item, page in zip(answer["interpretations"], pages, strict=True):
        assert page["interpretations"] == answer["interpretations"]
        assert {key: page[key] for key in models.Counted.model_fields}.items() <= item.items()
        assert item["choices"] == {reading["id"]: reading["chosen"] for reading in page["readings"]}
        simulated = [cell["verdict"] for cell in page["cells"] if cell["strategy"] != "lv_hil"]
        assert item["simulated"] == {"reached": simulated.count("reached"), "total": 40}
    assert pages[2]["scenario"] == client.get("/api/v1/presets").json()[2]["scenario"]


def test_absolutes_stand_beside_the_printed_ones_and_say_where_tyre_loads_are_doubled(
    client: httpx.Client, answer: dict[str, Any]
) -> None:
    """In the cells of the tables too; a factor cancels in every change."""
    nearest = client.get(PAPER, params={"interpretation": "nearest"}).json()
    plain = client.get(PAPER, params={"interpretation": "nearest", "tyre_loads": "computed"}).json()
    assert answer["absolutes"] == nearest["absolutes"]
    rows = {(row["window"], row["signal"], row["strategy"]): row for row in answer["absolutes"]["rows"]}
    assert len(rows) == 48
    for one, other, single in zip(answer["cells"], nearest["cells"], plain["cells"], strict=True):
        row = rows[one["window"], one["signal"], one["strategy"]]
        assert row["printed"] == one["paper_value"]
        for name, cell in (("default", one), ("nearest", other)):
            assert row[name]["value"] == pytest.approx(cell["our_value"], rel=1e-12)
            assert row[name]["factor"] == cell["our_factor"]
        assert other["our_factor"] == (2 if "tyre_load" in other["signal"] else 1)
        assert single["our_factor"] == one["our_factor"] == 1
        assert other["our_value"] == other["our_factor"] * single["our_value"]
        assert other["our_change"] == single["our_change"]
    distances = {item["interpretation"]: item for item in answer["absolutes"]["distances"]}
    assert 1.1 < distances["nearest"]["uncontrolled"]["median"] < 1.15
    assert 2.4 < distances["default"]["uncontrolled"]["median"] < 2.6


def test_a_single_switch_overrides_the_named_set(service: Service) -> None:
    """Where the RMS are taken changes no run, so nothing is computed for it."""
    query = {"interpretation": "favourable", "window": "to_bump"}
    answer = service.get(PAPER, params=query | {"preview": "lookahead"}).json()
    assert answer["interpretation"] is None
    choices = {reading["id"]: reading["chosen"] for reading in answer["readings"]}
    assert choices == answer["interpretations"][1]["choices"] | {"window": "to_bump"}
    assert answer["scenario"]["vehicle"]["cg_height"] == 0
    full = service.get(PAPER, params={"interpretation": "favourable"}).json()
    for one, other in zip(answer["cells"], full["cells"], strict=True):
        assert (one["our_value"] == other["our_value"]) == (one["window"] == "bump")


def test_cells_of_other_roads_appear_as_they_come(service: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    """A partial answer comes at once, and asked again it has more until it is complete.

    Of the roads asked for, only the first few are driven here.
    """
    paper, answers = service.services.paper, list[dict[str, Any]]()
    reproduction = paper.reproduction

    def of_few(choices: Mapping[str, str], roads: range, client: str, **more: Any) -> Any:
        assert roads == range(31, 61)
        return reproduction(choices, roads[:FEW], client, **more)

    def is_complete() -> bool:
        answers.append(service.get(PAPER, params={"first_seed": 31, "seeds": 30, "partial": True}).json())
        return bool(answers[-1]["complete"])

    monkeypatch.setattr(paper, "reproduction", of_few)
    wait_until(is_complete, "the last cell comes", pause=0.5)
    first, last = answers[0], answers[-1]
    assert {cell["verdict"] for cell in first["cells"]} == {"pending"}
    assert first["progress"]["done"] < first["progress"]["total"] == last["progress"]["done"]
    wanted = {"against": "passive", "table": 5, "signal": "rear_tyre_load"}
    (base,) = {cell["our_base"] for cell in last["cells"] if wanted.items() <= cell.items()}
    runs = [service.run(["passive"], {"road": {"seed": seed}}).json() for seed in range(31, 31 + FEW)]
    peaks = [run["strategies"]["passive"]["metrics"]["bump"]["rear_tyre_load"]["peak"] for run in runs]
    assert base == pytest.approx(statistics.fmean(peaks), rel=1e-9)


def test_what_each_part_contributes(client: httpx.Client) -> None:
    attribution = client.get(f"{PAPER}/attribution").json()
    models.AttributionAnswer.model_validate(attribution)
    assert {row["is"] for row in attribution["rows"]} == {"passive", "speed_only", "lqr", "lv", None}
    for share in attribution["shares"]:
        assert share["speed"] + share["preview"] + share["switching"] == pytest.approx(100)
    # Driven at constant speed, no suspension changes how long it takes.
    times = {row["travel_time"] for row in attribution["rows"] if row["speed"] == "constant"}
    assert len(times) == 1


def test_one_visitor_leaves_the_paper_page_to_others_and_all_have_a_limit(service: Service, store: Store) -> None:
    rows = PaperRows(store)

    async def ask(client: str, number: int) -> bool:
        request = JobRun(0, "{}", "paper.lv", f"key {number}")
        return (await rows.get([request], client, patience=0.0)).complete

    async def ask_all() -> None:
        for number in range(MAX_CLIENT_JOBS):
            assert not await ask("greedy", number), "nobody computes here"
        with pytest.raises(TooManyRequestsError):
            await ask("greedy", 100)
        assert not await ask("greedy", 0), "what is being computed is no further part"
        for number in range(MAX_JOBS - MAX_CLIENT_JOBS):
            assert not await ask(f"polite {number}", 101 + number)
        with pytest.raises(BusyError):
            await ask("one more", 200)

    service.inside(ask_all())


def test_rows_that_failed_are_not_computed_again_for_who_asks_every_second(service: Service, store: Store) -> None:
    rows = PaperRows(store)

    async def ask() -> str | None:
        answer = await rows.get([JobRun(0, "{}", "paper.lv", "a key")], "one", patience=0.0)
        return answer.reason if answer.complete else None

    assert service.inside(ask()) is None
    (job,) = store.jobs.unfinished()
    store.job_runs.save(job.id, [], CORE_VERSION, {0: "Its process died"})
    assert store.jobs.finish(job.id)
    assert service.inside(ask()) == service.inside(ask()) == "Its process died"
    assert not store.jobs.unfinished()
