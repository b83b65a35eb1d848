"""Recorded drives over HTTP: stored by content, shown among a run's strategies, pinned, refused."""

import json
from datetime import timedelta
from typing import Any

import httpx
import numpy as np
import pytest
from sqlalchemy import delete, update

from backend.db.tables import recordings, run_recordings
from ridelab import Ridelab
from sim_core import Scenario, simulate
from sim_core.catalogue import METRIC_SIGNALS, SIGNALS
from tests.api.conftest import Service

MISSING = "recording:" + "A" * 22
SCENARIO: dict[str, Any] = {"road": {"length": 120, "bump": {"start": 80, "height": 0.06}}}
SENT = ("time", "speed", "body_acceleration", "front_deflection")


def recorded(*keys: str, every: int = 2) -> str:
    """A passive car's drive as a file, its clock beginning 7 s before the road."""
    series = simulate(Scenario.model_validate(SCENARIO), "passive").series
    columns = [series[key][::every] + (7 if key == "time" else 0) for key in keys]
    head = ",".join(f"{key} [{SIGNALS[key].unit}]" for key in keys)
    return "\n".join([head, *(",".join(f"{value:.8g}" for value in row) for row in zip(*columns, strict=True)), ""])


def send(client: httpx.Client, content: str, **parameters: str) -> httpx.Response:
    headers = {"Content-Type": "text/csv"}
    return client.post("/api/v1/recordings", content=content, headers=headers, params=parameters)


@pytest.fixture(scope="module")
def sent(client: httpx.Client) -> dict[str, Any]:
    answer = send(client, recorded(*SENT))
    assert answer.status_code == 201, answer.text
    assert answer.headers["location"] == f"/api/v1/recordings/{answer.json()['id']}"
    return dict(answer.json())


@pytest.fixture(scope="module")
def shown(service: Service, sent: dict[str, Any]) -> dict[str, Any]:
    answer = service.run(["passive", sent["strategy"]], SCENARIO)
    assert answer.status_code == 200, answer.text
    return dict(answer.json())


def test_a_recording_is_known_by_its_content(client: httpx.Client, sent: dict[str, Any]) -> None:
    assert sent["signals"] == list(SENT)
    with Ridelab(str(client.base_url)) as ridelab:
        assert ridelab.upload_recording(b"".join(ridelab.recording_content(sent["id"])))["id"] == sent["id"]
    renamed = recorded(*SENT).replace("body_acceleration [m/s^2]", "acc z")
    columns = json.dumps({"acc z": "Body acceleration [m/s²]"})
    assert send(client, renamed, columns=columns).json()["id"] == sent["id"]
    head = client.get(f"/api/v1/recordings/{sent['id']}").json()
    assert head == {key: sent[key] for key in head}


def test_it_stands_beside_the_drive_that_it_is_of(shown: dict[str, Any], sent: dict[str, Any]) -> None:
    of_passive, of_recording = shown["strategies"]["passive"], shown["strategies"][sent["strategy"]]
    assert of_recording["recording"]["reference"] == "passive"
    assert of_recording["recording"]["likeness"] > 0.999
    assert of_recording["recording"]["missing"] == [key for key in METRIC_SIGNALS if key not in SENT]
    for window in ("rough_road", "bump", "whole"):
        for key in ("body_acceleration", "front_deflection"):
            ours, theirs = of_recording["metrics"][window][key], of_passive["metrics"][window][key]
            assert ours["rms"] == pytest.approx(theirs["rms"], rel=0.01)
            assert ours["peak"] == pytest.approx(theirs["peak"], rel=0.03)
        assert of_recording["metrics"][window]["rear_deflection"] == {"rms": None, "peak": None}
    assert of_recording["comfort"]["weighted_rms"] == pytest.approx(of_passive["comfort"]["weighted_rms"], rel=0.01)
    assert of_recording["arrival_speed_kmh"] == pytest.approx(of_passive["arrival_speed_kmh"])


def test_its_curves_are_drawn_exported_and_reported(
    client: httpx.Client, shown: dict[str, Any], sent: dict[str, Any]
) -> None:
    run, name = f"/api/v1/runs/{shown['id']}", sent["strategy"]
    series = client.get(f"{run}/series", params={"strategy": f"passive,{name}"}).json()["strategies"]
    x, passive = (np.array(series["passive"][key]) for key in ("position", "body_acceleration"))
    at, ours = (np.array(series[name][key], dtype=float) for key in ("position", "body_acceleration"))
    assert np.abs(np.interp(at, x, passive) - ours).max() < 0.02 * np.abs(passive).max()
    assert series[name]["rear_force"] == [None] * len(at)
    assert name in client.get(f"{run}/series", params={"strategy": f"passive,{name}", "format": "csv"}).text
    figure = client.get(f"{run}/figures/body_acceleration").json()
    assert [trace["meta"]["strategy"] for trace in figure["data"]] == ["passive", name]
    assert f"Recording {sent['id'][:6]}" in client.get(f"{run}/report.html").text


def test_a_link_pins_it(service: Service, shown: dict[str, Any], sent: dict[str, Any]) -> None:
    view = {"baseline": sent["strategy"], "strategies": ["passive", sent["strategy"]]}
    answer = service.post("/api/v1/links", json={"run_id": shown["id"], "view": view})
    assert answer.json()["series_pinned"] is True, answer.text
    parameters = {"strategy": sent["strategy"]}
    before = service.get(f"/api/v1/runs/{shown['id']}/series", params=parameters).json()
    store = service.services.store
    with store.writing() as connection:
        connection.execute(delete(run_recordings).where(run_recordings.c.recording_id == sent["id"]))
        connection.execute(delete(recordings).where(recordings.c.id == sent["id"]))
    after = service.get(f"/api/v1/runs/{shown['id']}/series", params=parameters).json()
    assert after == before
    assert send(service, recorded(*SENT)).json()["id"] == sent["id"]


def test_a_recording_is_held_to_requirements(service: Service, shown: dict[str, Any], sent: dict[str, Any]) -> None:
    """By name too; its change is against the strategy that drove it."""
    metric, name = "bump.body_acceleration.peak", sent["strategy"]
    requirements = [{"metric": metric, "max_change": 5, "strategies": [name]}, {"metric": metric, "max": 0.1}]
    body = {"scenario": SCENARIO, "strategies": ["passive", name], "requirements": requirements}
    answer = service.post("/api/v1/runs", json=body).json()
    assert answer["id"] == shown["id"]
    results = answer["requirement_results"]
    assert [(each["strategy"], each["result"]) for each in results] == [(name, "pass"), (name, "fail")]
    assert abs(results[0]["value"]) < 5


@pytest.mark.parametrize(
    ("query", "said"),
    [({"columns": "[]"}, "This has to be JSON"), ({"table": "[]"}, "This has to be a JSON object")],
)
def test_a_description_of_columns_is_json(client: httpx.Client, query: dict[str, str], said: str) -> None:
    """What is no table is in tests/unit/test_tables.py."""
    answer = send(client, recorded(*SENT), **query)
    assert answer.status_code == 422
    assert said in answer.json()["errors"][0]["message"]


def test_a_file_that_is_not_sure_is_asked_about_and_read_by_the_answers(
    client: httpx.Client, sent: dict[str, Any]
) -> None:
    asked = recorded(*SENT).replace("time [s]", "time").replace("body_acceleration [m/s^2]", "z")
    problem = send(client, asked).json()
    assert problem["type"].endswith("table-unsure")
    assert [question["field"] for question in problem["table"]["questions"]] == ["/columns/0/unit"]
    described = send(client, asked, dry_run="true").raise_for_status()
    assert described.json()["table"] == problem["table"]
    assert described.json()["curve"]["signals"] == ["front_deflection"]
    with Ridelab(str(client.base_url)) as ridelab:
        table = ridelab.describe_table(asked.encode())
        table["columns"][2] |= {"means": "body_acceleration", "unit": "m/s^2"}
        assert ridelab.upload_recording(asked.encode(), table=table)["id"] == sent["id"]


def test_one_that_nothing_shows_is_removed_when_it_is_old(service: Service, sent: dict[str, Any]) -> None:
    store = service.services.store
    service.run(["passive", "speed_only", sent["strategy"]], SCENARIO).raise_for_status()
    alone = send(service, recorded("time", "body_acceleration", every=20)).json()["id"]
    with store.writing() as connection:
        connection.execute(update(recordings).values(created_at=store.now() - timedelta(days=100)))
    store.retention.remove("recordings", store.now())
    for each, status in ((alone, 404), (sent["id"], 200)):
        assert service.get(f"/api/v1/recordings/{each}").status_code == status
