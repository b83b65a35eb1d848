"""A database of 899e0802 opens with all they have, and jobs that its service was killed in are finished."""

import json
import zlib
from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urljoin

import httpx
import numpy as np
import pytest

from backend import digest
from backend.links.models import Link
from backend.store import Store
from backend.store.job import FINAL
from sim_core import Scenario, __version__, load_controllers, simulate
from sim_core.catalogue import SIGNALS
from tests.api.streams import events_of, read_events
from tests.data import release
from tests.faults.conftest import Process, starter
from tests.servers.batches import computed
from tests.servers.postgres import Postgres
from tests.servers.process import wait_until
from tests.validation.strategies import some

# Of today's core, not of the one that computed the numbers; a summary's are computed when it is asked for.
RECOMPUTED = {"current_core_version", "nominal", "stability"}
OF_BATCHES = {"notes", "sweep"}  # the sweep has an address of its own now, the notes are gone
SAMPLES = {"series", "distance", "height"}  # which are shown is for each version to choose: pinned ones are held below


@dataclass(frozen=True, kw_only=True)
class Opened:
    """The service of today that opened that database and has finished what was unfinished."""

    client: httpx.Client
    url: str


# That both databases keep every row is shown in tests/api/test_store.py.
@pytest.fixture(scope="module", params=some(1, ["sqlite", "postgresql"]))
def opened(request: pytest.FixtureRequest) -> Iterator[Opened]:
    if request.param == "sqlite":
        service: Process = request.getfixturevalue("service")
        yield Opened(client=service.client, url=f"sqlite:///{request.getfixturevalue('database')}")
        return
    postgres: Postgres = request.getfixturevalue("postgres")
    folder: Path = request.getfixturevalue("tmp_path_factory").mktemp("release")
    url = postgres.new_database()
    with closing(Store(url)) as store:
        release.restore(store)
    release.write_controllers(folder)
    for start in starter(folder):
        started = start(RIDELAB_DATABASE_URL=url, RIDELAB_CONTROLLERS=str(folder))
        started.finish()
        yield Opened(client=started.client, url=url)


def differences(before: Any, now: Any, path: str = "") -> list[str]:
    """Where `now` has another value than `before`, members of today's core apart; it may have new ones.

    A strategy's failure that was stored before failures had kinds is computed again: it fails alike, or ran.
    """
    if isinstance(before, dict) and before.get("status") == "failed" and "compute_ms" in before:
        alike = {"ok": __version__, "failed": before.get("reason")}
        said = now.get({"ok": "core_version", "failed": "reason"}[now["status"]], __version__)
        return [] if said == alike[now["status"]] else [f"{path}: {before!r} is {now!r}"]
    if isinstance(before, dict) and isinstance(now, dict):
        gone = RECOMPUTED | (OF_BATCHES if before.keys() >= OF_BATCHES else set())
        each: list[tuple[str, Any, Any]] = [(name, before[name], now.get(name)) for name in before.keys() - gone]
    elif isinstance(before, list) and isinstance(now, list) and len(before) == len(now):
        each = [(str(index), old, new) for index, (old, new) in enumerate(zip(before, now, strict=True))]
    else:
        return [] if before == now else [f"{path}: {before!r} is {now!r}"]
    return [difference for name, old, new in each for difference in differences(old, new, f"{path}/{name}")]


def test_everything_is_answered_as_before(opened: Opened) -> None:
    for path, before in release.content()["answers"].items():
        if path.endswith("/events"):
            assert not differences(events_of(before), read_events(opened.client, f"/api/v1{path}")), path
        else:
            now = opened.client.get(f"/api/v1{path}").raise_for_status().json()
            if path.partition("?")[0].endswith("/summary"):  # it names the core of its nominal values, as the next test
                now["core_version"] = before.get("core_version")
            if "points=" in path:
                before, now = ({name: each[name] for name in each.keys() - SAMPLES} for each in (before, now))
            if path.startswith("/links/"):
                before = {**before, "url": urljoin(str(opened.client.base_url), before["url"])}  # whole since 0.5.0
            assert not differences(before, now), path
            if path.startswith("/batches/") and before.keys() >= OF_BATCHES:
                assert opened.client.get(f"/api/v1{path}/sweep").json() == before["sweep"]


def test_results_that_may_be_wrong_are_answered(opened: Opened) -> None:
    for path in release.content()["stale"]:
        opened.client.get(f"/api/v1{path}").raise_for_status()


def test_a_new_request_gets_no_result_that_a_controllers_plain_preview_made_wrong(
    opened: Opened, tmp_path: Path
) -> None:
    """Core 0.4.0 had one result for all gains of the sensors; now each run and each point of a sweep is computed."""
    stored = [each for path, each in release.content()["stale"].items() if "/runs/" in path]
    release.write_controllers(tmp_path)
    figure, gains, metrics = "bump.body_acceleration.peak", list[float](), list[float]()
    for run in stored:
        (kind,) = (each["ahead"] for file in tmp_path.glob("*.py") if "ahead" in (each := load_controllers(file)))
        asked = {"scenario": run["scenario"], "strategies": ["passive", "ahead"]}
        now = opened.client.post("/api/v1/runs", json=asked).raise_for_status().json()
        assert (now["core_version"], now["id"] == run["id"]) == (__version__, False)
        expected = simulate(Scenario.model_validate(run["scenario"]), kind)
        assert now["strategies"]["ahead"]["metrics"] == expected.summary()["metrics"]
        gains.append(run["scenario"]["mismatch"]["preview_gain"])
        metrics.append(expected.metrics["bump"]["body_acceleration"]["peak"])
    before = [run["strategies"]["ahead"]["metrics"] for run in stored]
    assert all(each == before[0] for each in before)
    assert len(set(metrics)) == len(stored) > 1
    sweep = {"grid": {"mismatch.preview_gain": gains}}
    batch = computed(opened.client, scenario=stored[0]["scenario"], strategies=["ahead"], sweep=sweep)
    table = opened.client.get(f"/api/v1/batches/{batch['id']}/table", params={"figures": figure}).json()
    assert table["columns"][figure] == metrics


def test_a_failure_that_was_the_machines_is_computed_again(opened: Opened) -> None:
    """The FMU could not be loaded; the results beside it stay what they are, and each says which core computed it."""
    for path, before in release.content()["machine_faults"].items():
        now = opened.client.get(f"/api/v1{path}").raise_for_status().json()
        if "rows" in before:
            assert {row["status"] for row in before["rows"]} == {"failed"}
            job = f"/api/v1{path.removesuffix('/results')}"
            wait_until(lambda job=job: opened.client.get(job).json()["done"] == 2, "it is computed")  # type: ignore[misc]  # a default binds it
            rows = opened.client.get(f"/api/v1{path}").json()["rows"]
            assert {(row["status"], row["core_version"]) for row in rows} == {("ok", __version__)}
            continue
        then, now = before.get("run") or before, now.get("run") or now
        assert (then["strategies"]["theirs"]["status"], now["strategies"]["theirs"]["status"]) == ("failed", "ok")
        assert now["strategies"]["theirs"].get("core_version", now["core_version"]) == __version__
        assert now["core_version"] == then["core_version"]
        (caution,) = [each for each in now["comparison"]["cautions"] if each["kind"] == "core_version"]
        assert caution["strategy"] == "theirs"
        assert f"was computed by core {__version__}, the other strategies by core " in caution["text"]
        assert caution in now["cautions"]
        assert not differences(then["strategies"]["passive"], now["strategies"]["passive"])
        assert now["strategies"]["theirs"]["source"]["file"] == "theirs.fmu"
        assert opened.client.get(f"/api/v1/runs/{then['id']}").json()["strategies"] == now["strategies"]


def test_a_summary_says_which_core_computes_its_nominal_values(opened: Opened) -> None:
    answers = release.content()["answers"]
    paths = [path for path in answers if path.partition("?")[0].endswith("/summary")]
    assert paths
    for path in paths:
        assert opened.client.get(f"/api/v1{path}").json()["core_version"] == __version__
        assert opened.client.get(f"/api/v1{path.rpartition('/')[0]}").json()["core_version"] == release.VERSION


def pinned_samples(content: bytes) -> dict[str, Any]:
    """By signal its pinned samples."""
    _, head, packed = content.split(b"\n", 2)
    signals = json.loads(head)["units"]
    by_byte = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(len(signals), 4, -1)
    return {key: each.T.copy().view("<f4")[:, 0] for key, each in zip(signals, by_byte, strict=True)}


def test_time_histories_are_those_that_were_pinned(opened: Opened) -> None:
    pinned = {row["result_key"]: row["content"] for row in release.rows("pinned_series")}
    strategies = {row["key"]: row["strategy"] for row in release.rows("results") if row["key"] in pinned}
    first = {row["result_key"]: row["run_id"] for row in reversed(release.rows("run_results"))}
    assert pinned.keys() == strategies.keys()
    assert pinned
    for key, strategy in strategies.items():
        path = f"/api/v1/runs/{first[key]}/series?strategy={strategy}"
        series = opened.client.get(path).raise_for_status().json()["series"]
        then = pinned_samples(release.bytes_of(pinned[key]))
        for signal, values in then.items():
            np.testing.assert_array_equal(np.array(series[signal], dtype=np.float32), np.array(values, np.float32))
        fewer = opened.client.get(f"{path}&points=100").json()["series"]
        assert set(fewer["body_acceleration"]) < set(series["body_acceleration"])
        header = opened.client.get(f"{path}&format=csv").text.splitlines()[0]
        assert header.startswith(f"time [{SIGNALS['time'].unit}]")
        assert opened.client.get(f"/api/v1/runs/{first[key]}/figures/speed").json()["data"]


def test_a_run_that_had_expired_is_computed_again(opened: Opened) -> None:
    expired: dict[str, Any] = release.content()["expired"]
    ours = [before for before in expired.values() if "mine" not in before["strategies"] and "roads" not in before]
    same = all(digest.run_id(Scenario.model_validate(run["scenario"]), run["strategies"]) == run["id"] for run in ours)
    for path, before in expired.items():
        answer = opened.client.get(f"/api/v1{path}")
        if "mine" in before["strategies"] and not same:
            assert answer.status_code == 410, "another core cannot say whether its file is the one it was"
            continue
        now = answer.raise_for_status().json()
        assert not differences(before["scenario"], now["scenario"])
        assert (now["id"], now["core_version"]) == (before["id"], __version__)
        assert list(now["strategies"]) == list(before["strategies"])
        assert {each["status"] for each in now["strategies"].values()} == {"ok"}, path
        assert opened.client.get(f"/api/v1{path}").json() == now


def test_a_link_has_the_scenario_in_the_current_schema(opened: Opened) -> None:
    versions = {row["id"]: row["schema_version"] for table in ("runs", "jobs") for row in release.rows(table)}
    for stored in release.rows("links"):
        answer = opened.client.get(f"/api/v1/links/{stored['slug']}")
        Link.model_validate_json(answer.content)
        link = answer.json()
        assert link["schema_version"] == versions[stored["run_id"] or stored["job_id"]]
        assert link["current_core_version"] == __version__
        assert Scenario.model_validate(link["scenario"]).model_dump(mode="json") == link["scenario"]
        assert (link["run"] or link["batch"])["scenario"] == link["scenario"]


def test_an_unfinished_batch_is_finished(opened: Opened) -> None:
    job = release.unfinished("batches")
    events = read_events(opened.client, f"/api/v1/batches/{job['id']}/events")
    assert [event["id"] for event in events] == list(range(1, len(events) + 1))
    assert (events[-1]["state"], events[-1]["done"], events[-1]["failed"]) == ("done", job["total"], 0)
    rows = opened.client.get(f"/api/v1/batches/{job['id']}/results").json()["rows"]
    done = {
        row["position"]: row["result_key"]
        for row in release.rows("job_runs")
        if row["job_id"] == job["id"] and row["status"] == "ok"
    }
    summaries = {row["key"]: json.loads(row["summary"]) for row in release.rows("results")}
    assert 0 < len(done) < job["total"] == len(rows)
    for row in rows:
        assert (row["status"], row["road.seed"]) == ("ok", 100 + row["run"])
        assert row["core_version"] == (release.VERSION if row["run"] in done else __version__)
        if row["run"] in done:
            assert row["metrics"] == summaries[done[row["run"]]]["metrics"]


def test_an_unfinished_tuning_goes_on_to_its_end(opened: Opened) -> None:
    """Its numbers are not mixed with those of today's core: it begins again."""
    job = release.unfinished("tunings")
    events = read_events(opened.client, f"/api/v1/tunings/{job['id']}/events")
    before = [row["kind"] for row in release.rows("job_events") if row["job_id"] == job["id"]]
    expected = before if __version__ == release.VERSION else [*before, "restart"]
    assert [event["event"] for event in events[: len(expected)]] == expected
    tuning = opened.client.get(f"/api/v1/tunings/{job['id']}").json()
    assert (tuning["state"], tuning["core_version"], tuning["trials"]["done"]) == ("done", __version__, job["total"])
    assert [each["trials"] for each in tuning["history"]] == [*range(10, job["total"], 10), job["total"]]
    assert tuning["comparison"]["points"]


def test_an_unfinished_job_of_the_paper_page_holds_up_nothing(opened: Opened) -> None:
    """Nobody waits for its rows any more: it ends, and whoever opens the page gets a job of today's core."""
    job = release.unfinished("reproductions")
    with closing(Store(opened.url)) as store:
        wait_until(lambda: (now := store.jobs.load(job["id"])) is None or now.state in FINAL, "it ends")
        page = opened.client.get("/api/v1/paper?seeds=20&first_seed=500&partial=true")
        assert page.raise_for_status().json()["core_version"] == __version__
        new = [each for each in store.jobs.unfinished() if each.kind == "reproduction"]
        assert len(new) == 1 or __version__ == release.VERSION
        for each in new:
            store.jobs.cancel(each.id)  # its rows would take a minute
