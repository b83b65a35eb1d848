"""Measured roads over HTTP: stored by content, driven by runs, links and batches, refused at their lines."""

import csv
import io
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest
from sqlalchemy import delete, update

from backend.db.columns import UNCHECKED
from backend.db.tables import results, roads, run_roads
from backend.errors import BusyError, TooManyRequestsError
from backend.roads.samples import HUMP as HUMP_OF_STREET
from backend.roads.samples import POTHOLE, SAMPLES
from backend.roads.survey import read
from ridelab import Ridelab, RidelabAPIError
from sim_core import Scenario, simulate
from sim_core.tables.text import MAX_BYTES
from tests.api.conftest import Service
from tests.servers.batches import computed
from tests.servers.batches import rows as rows_of

HEAD = "distance [m],height [mm]\n"
X = np.arange(0, 140, 0.1)
HUMP = 80 * np.where((X > 100) & (X < 103), (1 - np.cos(2 * np.pi * (X - 100) / 3)) / 2, 0)
FILE = HEAD + "".join(f"{x:.1f},{h:.2f}\n" for x, h in zip(X, HUMP + 3 * np.sin(X) + 0.4 * X, strict=True))
MISSING = "A" * 22
ROADS = Path(__file__).parents[2] / "docs" / "roads"


def send(client: httpx.Client, content: str | bytes, **headers: str) -> httpx.Response:
    return client.post("/api/v1/roads", content=content, headers={"Content-Type": "text/csv", **headers})


@pytest.fixture(scope="module")
def sent(client: httpx.Client) -> dict[str, Any]:
    answer = send(client, FILE)
    assert answer.status_code == 201, answer.text
    assert answer.headers["location"] == f"/api/v1/roads/{answer.json()['id']}"
    return dict(answer.json())


@pytest.fixture(scope="module")
def scenario(sent: dict[str, Any]) -> dict[str, Any]:
    return {"road": {"profile": sent["id"], "length": 130, "bump": {"height": 0, "start": 100, "width": 3}}}


def test_a_road_is_known_by_its_content_and_the_same_when_its_export_is_sent(
    client: httpx.Client, sent: dict[str, Any]
) -> None:
    assert (sent["length"], sent["samples"]) == (139.9, 13_991)
    (bump,) = sent["bumps"]
    assert (bump["start"], bump["height"]) == (pytest.approx(100, abs=0.5), pytest.approx(0.08, rel=0.1))
    again = send(client, "# once more\r\n" + FILE.replace("\n", "\r\n"), **{"Content-Type": "text/csv; charset=utf-8"})
    assert again.json() == sent
    for points in (2, 3, 400):
        got = client.get(f"/api/v1/roads/{sent['id']}", params={"points": points}).json()
        assert len(got["distance"]) == len(got["height"]) <= points
        assert (got["distance"][0], got["distance"][-1]) == (0, 139.9)
    assert max(got["height"]) == read(FILE.encode()).road.heights().max()
    exported = client.get(f"/api/v1/roads/{sent['id']}", params={"format": "csv"})
    assert f"ridelab-road-{sent['id']}.csv" in exported.headers["content-disposition"]
    again = send(client, exported.content)
    assert (again.json()["id"], again.json()["bumps"]) == (sent["id"], sent["bumps"])
    missing = client.get(f"/api/v1/roads/{MISSING}", params={"format": "csv"})
    assert (missing.status_code, missing.headers["content-type"]) == (404, "application/problem+json")


def test_a_long_file_is_read_from_disk_one_of_a_client_at_a_time(
    service: Service, sent: dict[str, Any], tmp_path: Path
) -> None:
    spool, long = service.services.settings.data_dir / "spool", FILE + "# a comment\n" * 400_000
    others = set(spool.iterdir())  # the files of bands that other tests asked for
    assert send(service, long).json()["id"] == sent["id"]
    assert set(spool.iterdir()) <= others
    tables = service.services.tables
    with tables._place("one", tmp_path), pytest.raises(TooManyRequestsError), tables._place("one", tmp_path):
        pass
    with tables._place("one", tmp_path), tables._place("two", tmp_path), pytest.raises(BusyError):
        tables._place("three", tmp_path).__enter__()


def test_a_road_that_is_not_sure_is_asked_about_and_read_by_the_answers(
    client: httpx.Client, sent: dict[str, Any]
) -> None:
    asked = FILE.replace("distance [m],height [mm]", "a,b")
    problem = send(client, asked).json()
    assert problem["type"].endswith("table-unsure")
    assert [question["guess"] for question in problem["table"]["questions"]] == ["distance", "m", "height", "mm"]
    with Ridelab(str(client.base_url)) as ridelab:
        table = ridelab.describe_table(asked.encode(), {"kind": "road"})
        assert ridelab.upload_road(asked.encode(), table=table)["id"] == sent["id"]
        with pytest.raises(RidelabAPIError) as unsure:
            ridelab.upload_road(asked.encode())
    assert unsure.value.table == problem["table"]


def test_heights_that_are_no_roads_are_cautioned(client: httpx.Client) -> None:
    """In words of their own: an index beyond any road's, for which another unit was meant, or no class of ISO 8608."""
    waves = 10 * np.sin(2 * np.pi * X / 5) + 4 * np.sin(2 * np.pi * X / 2)
    of_waves = HEAD + "".join(f"{x:.1f},{h:.3f}\n" for x, h in zip(X, waves, strict=True))
    for content, kinds in (
        (FILE, []),
        (FILE.replace("[mm]", "[um]"), ["iri"]),
        (FILE.replace("[mm]", "[in]"), ["iri"]),
        (of_waves, ["spectrum"]),
    ):
        road = send(client, content.replace("0.1,", "0.1,1")).json()
        cautions = client.get(f"/api/v1/roads/{road['id']}").json()["cautions"]
        assert cautions == road["cautions"]
        assert [(each["kind"], each["field"]) for each in cautions] == [(kind, "road.profile") for kind in kinds]
        assert "spectrum" not in kinds or road["iso_class"] is None


def test_the_papers_bump_on_a_measured_road_is_cautioned(service: Service, sent: dict[str, Any]) -> None:
    for bump, kinds in ({}, ["added_bump"]), ({"bump": {"height": 0}}, []), ({"bump": {"height": 0.05}}, []):
        run = service.run(["passive"], {"road": {"profile": sent["id"], **bump}}).raise_for_status().json()
        assert [each["kind"] for each in run["cautions"] if each["field"] != "vehicle.front_spring"] == kinds


def test_runs_live_series_and_links_drive_it(service: Service, scenario: dict[str, Any], sent: dict[str, Any]) -> None:
    run = service.run(["lv", "passive"], scenario).json()
    expected = simulate(Scenario.model_validate(scenario).on(read(FILE.encode()).road), "passive")
    peak = expected.metrics["bump"]["body_acceleration"]["peak"]
    assert run["strategies"]["passive"]["metrics"]["bump"]["body_acceleration"]["peak"] == pytest.approx(peak)
    assert run["scenario"]["road"]["profile"] == sent["id"]
    assert service.live(["lv"], scenario).json()["strategies"]["lv"]["status"] == "ok"
    text = service.get(f"/api/v1/runs/{run['id']}/series?strategy=passive&format=csv").text
    driven = [float(row["front_road [m]"]) for row in csv.DictReader(io.StringIO(text))]
    np.testing.assert_allclose(driven, expected.series["front_road"], atol=1e-6)
    assert service.get(f"/api/v1/runs/{run['id']}/figures/road").status_code == 200
    link = service.post("/api/v1/links", json={"run_id": run["id"], "view": {}}).json()
    assert link["series_pinned"]
    assert service.get(f"/api/v1/links/{link['slug']}").json()["scenario"]["road"]["profile"] == sent["id"]
    assert service.post("/api/v1/controller", json={"scenario": scenario}).status_code == 200


def test_a_batch_drives_several_roads(client: httpx.Client, scenario: dict[str, Any], sent: dict[str, Any]) -> None:
    sweep = {"grid": {"road.profile": [sent["id"], None]}}
    body = {"scenario": scenario, "strategies": ["passive"], "sweep": sweep}
    assert client.post("/api/v1/batches", json={**body, "dry_run": True}).json()["estimated_seconds"] > 0
    batch = computed(client, **body)["id"]
    measured, random = (row["metrics"]["bump"]["body_acceleration"]["peak"] for row in rows_of(client, batch))
    assert measured > 3 * random, "the hump is in the profile"
    nominal = client.get(f"/api/v1/batches/{batch}/summary").json()["strategies"]["passive"]
    assert nominal["figures"]["bump.body_acceleration.peak"]["nominal"] == pytest.approx(measured)


def test_a_scenario_without_a_length_ends_with_its_road(service: Service, sent: dict[str, Any]) -> None:
    """Runs, live ones, batches and solve drive and answer the road's own length; a given one is as it was."""
    road = {"profile": sent["id"], "bump": {"height": 0, "start": 100}}
    run = service.run(["passive"], {"road": road}).json()
    assert run["scenario"]["road"]["length"] == sent["length"]
    assert service.run(["passive"], run["scenario"]).json()["id"] == run["id"], "the same run as with that length"
    live = service.live(["passive"], {"road": road}).json()
    assert live["strategies"]["passive"]["travel_time"] == run["strategies"]["passive"]["travel_time"]
    shorter = service.run(["passive"], {"road": {**road, "length": 110}}).json()
    assert (shorter["scenario"]["road"]["length"], shorter["id"] == run["id"]) == (110, False)
    question = {"strategy": "passive", "field": "road.bump.height", "range": [0.01, 0.1], "scenario": {"road": road}}
    solution = service.post("/api/v1/solve", json={**question, "metric": "travel_time", "limit": 99}).json()
    solved = service.get(f"/api/v1/runs/{solution['run_id']}").json()
    assert solved["scenario"]["road"]["length"] == sent["length"]
    sweep = {"grid": {"road.profile": [sent["id"], None]}}
    for given, lengths in ({}, (sent["length"], 150)), ({"length": 145}, (None, 145)):
        scenario = {"road": {"bump": road["bump"], **given}}
        batch = computed(service, scenario=scenario, strategies=["passive"], sweep=sweep)
        assert [row.get("travel_time") for row in rows_of(service, batch["id"])] == [
            length and pytest.approx(length / (50 / 3.6)) for length in lengths
        ]


def test_how_long_a_road_may_be_counts_what_the_profile_does_not_have(
    client: httpx.Client, scenario: dict[str, Any]
) -> None:
    body = {"scenario": scenario, "strategy": "passive", "field": "road.length", "metric": "travel_time", "limit": 1000}
    solution = client.post("/api/v1/solve", json={**body, "range": [120, 145]}).json()
    assert solution["value"] == pytest.approx(139.9, abs=0.02)
    assert solution["bracket"][1] > 139.9


def test_without_its_road_a_run_keeps_its_metrics_and_no_new_one_is_stored(
    service: Service, scenario: dict[str, Any]
) -> None:
    road = send(service, FILE.replace("0.1,", "0.1,1")).json()["id"]
    there = {"road": {**scenario["road"], "profile": road}}
    run = service.run(["passive"], there).json()
    assert service.live(["speed_only"], there).status_code == 200, "its result is in memory"
    with service.services.store.writing() as connection:
        connection.execute(delete(run_roads).where(run_roads.c.road_id == road))
        connection.execute(delete(roads).where(roads.c.id == road))
    refused = service.run(["speed_only"], there)
    assert (refused.status_code, refused.json()["errors"][0]["pointer"]) == (422, "/scenario/road/profile")
    path = f"/api/v1/runs/{run['id']}"
    assert service.get(path).json()["strategies"].keys() == {"passive"}
    for histories in ("series", "figures", "figures/road"):
        answer = service.get(f"{path}/{histories}")
        assert (answer.status_code, answer.json()["type"].rpartition(":")[2]) == (410, "road-gone")
    report = service.get(f"{path}/report.html").text
    assert "They are gone. The measured road of this run is not stored any more" in report
    with service.services.store.writing() as connection:
        expired = update(results).where(results.c.strategy == "passive").values(status="expired", summary="{}")
        connection.execute(expired)
    service.services.runs.results.memory.clear()
    assert service.get(path).status_code == 410


CSV = {"Content-Type": "text/csv"}
OPENCRG = {"Content-Type": "application/x-opencrg"}


@pytest.mark.parametrize(
    ("content", "params", "headers", "status"),
    [
        (HEAD + "0,0\n1,nan\n", {}, CSV, 422),
        ("", {}, CSV, 422),
        (HEAD, {}, {"Content-Type": "application/json"}, 415),
        (HEAD, {}, {**CSV, "Content-Encoding": "gzip"}, 415),
        ("0" * (MAX_BYTES + 1), {}, CSV, 413),
        (FILE, {"right": -0.5}, CSV, 422),
        ("$CT\n", {}, OPENCRG, 422),
        ("0" * (16 * 1024 * 1024 + 1), {}, OPENCRG, 413),
    ],
    ids=range(8),
)
def test_what_is_no_road_is_refused(
    client: httpx.Client, content: str, params: dict[str, float], headers: dict[str, str], status: int
) -> None:
    answer = client.post("/api/v1/roads", params=params, content=content, headers=headers)
    assert (answer.status_code, answer.headers["content-type"]) == (status, "application/problem+json")


@pytest.mark.parametrize("name", SAMPLES)
def test_the_samples_are_what_their_command_prints_and_have_their_bumps(name: str) -> None:
    text = (ROADS / f"{name}.csv").read_text()
    assert text == SAMPLES[name]()
    detected = read(text.encode()).bumps[0]
    bump = {"street": HUMP_OF_STREET, "gravel": POTHOLE}[name]
    assert detected.start == pytest.approx(bump.start, abs=0.5)
    assert detected.height == pytest.approx(bump.height, rel=0.2)


def grid() -> bytes:
    """A sloping road whose right half is twice as rough, as text."""
    head = (
        "$CT\n$\n$ROAD_CRG\nREFERENCE_LINE_INCREMENT = 0.1\nREFERENCE_LINE_START_S = 0.02\n$\n$KD_DEFINITION\n#:LRFI\n"
    )
    sections = "".join(f"D:long section at v = {v},m\n" for v in (-1, 0, 1))
    rough = 0.004 * np.cumsum(np.random.default_rng(1).standard_normal(600))
    rows = "".join(f"{2 * h:10.6f}{h:10.6f}{h:10.6f}\n" for h in rough)
    return f"{head}{sections}$\n$$$$\n{rows}".encode()


INDICES = ("iri", "iso_class", "roughness", "waviness", "spectrum")


def test_a_road_comes_and_goes_as_opencrg(client: httpx.Client) -> None:
    sent = send(client, grid(), **OPENCRG)
    assert sent.status_code == 201, sent.text
    road = sent.json()
    left, right = road["iri"]["tracks"]
    assert right == pytest.approx(1.75 * left, rel=1e-4), "heights there are three quarters of the way"
    assert road["iri"]["mean"] == pytest.approx((left + right) / 2)
    beside = client.post("/api/v1/roads", params={"left": 1, "right": 0}, content=grid(), headers=OPENCRG).json()
    assert beside["iri"]["tracks"] == [pytest.approx(left)] * 2
    assert road["roughness"]["low"] < road["roughness"]["value"] < road["roughness"]["high"]
    assert road["waviness"]["low"] < 2 < road["waviness"]["high"]
    for encoding in ("binary", "text"):
        answer = client.get(f"/api/v1/roads/{road['id']}", params={"format": "crg", "encoding": encoding})
        assert answer.headers["content-type"] == OPENCRG["Content-Type"]
        assert f"ridelab-road-{road['id']}.crg" in answer.headers["content-disposition"]
        assert send(client, answer.content, **OPENCRG).json()["id"] == road["id"]
    got = client.get(f"/api/v1/roads/{road['id']}").json()
    assert [got[name] for name in INDICES] == [road[name] for name in INDICES], "of the first file"


def test_a_road_of_an_older_version_has_no_indices_until_its_file_comes_again(service: Service) -> None:
    content = FILE + "140.0,56\n"
    road = send(service, content).json()
    with service.services.store.writing() as connection:
        connection.execute(update(roads).where(roads.c.id == road["id"]).values(analysis=None, checksum=UNCHECKED))
    address = f"/api/v1/roads/{road['id']}"
    got = service.get(address).json()
    assert [got[name] for name in INDICES] == [None] * 5
    assert send(service, content).json() == road
    assert service.get(address).json()["iri"] == road["iri"]


@pytest.mark.parametrize("length", [60, 180])
def test_a_road_without_a_bump_is_driven_and_has_no_metrics_of_one(service: Service, length: int) -> None:
    heights = "".join(f"{0.1 * k:.1f},{6 * np.cos(0.1 * k):.2f}\n" for k in range(10 * length + 1))
    road = send(service, HEAD + heights).json()["id"]
    scenario: dict[str, Any] = {"road": {"profile": road, "bump": {"height": 0}}}
    run = service.run(["lv", "passive"], scenario).raise_for_status().json()
    batch = computed(service, scenario=scenario, strategies=["lv"], sweep={"list": [{"vehicle.body_mass": 600}]})
    for entry in (*run["strategies"].values(), *rows_of(service, batch["id"])):
        assert {value for signal in entry["metrics"]["bump"].values() for value in signal.values()} == {None}
        assert entry["metrics"]["whole"]["body_acceleration"]["rms"] > 0
        assert (entry["arrival_speed_kmh"], entry["events"]["bump_complete"]) == (None, None)
    for histories in ("series?strategy=lv", "figures", "figures/road", "report.html"):
        service.get(f"/api/v1/runs/{run['id']}/{histories}").raise_for_status()
    question = {"scenario": scenario, "strategy": "passive", "field": "vehicle.body_mass", "range": [400, 800]}
    of_bump = service.post("/api/v1/solve", json={**question, "metric": "bump.front_deflection.peak", "limit": 0.05})
    assert (of_bump.status_code, of_bump.json()["errors"][0]["pointer"]) == (422, "/metric")
