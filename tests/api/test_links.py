"""Share links: what was shared opens again as it was, whatever becomes of the service; the view comes back as sent."""

import re
from datetime import UTC, datetime, timedelta
from typing import Any

import httpx
import pytest
from sqlalchemy import select, update

from backend.db.columns import UNCHECKED
from backend.db.tables import links, results, run_results, runs
from backend.links.models import CreatedLink, Link
from backend.runs import exports, pins
from backend.store import Store
from sim_core import __version__
from sim_core.scenario import SCHEMA_VERSION
from tests.servers.batches import computed

VIEW = {
    "strategies": ["passive", "lv"],
    "hidden": ["passive"],
    "baseline": "lv",
    "axis": "time",
    "zoom": [1.25, 7],
    "cursor": 3.5,
}


def share(client: httpx.Client, run_id: str, **view: Any) -> Any:
    answer = client.post("/api/v1/links", json={"run_id": run_id, **({"view": view} if view else {})})
    assert answer.status_code == 201, answer.text
    return answer.json()


def opened(client: httpx.Client, slug: str) -> dict[str, Any]:
    answer = client.get(f"/api/v1/links/{slug}")
    assert answer.status_code == 200, answer.text
    content: dict[str, Any] = answer.json()
    Link.model_validate_json(answer.content)
    return content


def keys(store: Store, run_id: str) -> list[str]:
    with store.reading() as connection:
        return list(
            connection.execute(select(run_results.c.result_key).where(run_results.c.run_id == run_id)).scalars()
        )


def of_another_core(store: Store, run_id: str) -> None:
    """Make a run and its results those of another core version, as after an upgrade."""
    with store.writing() as connection:
        older = {"core_version": "0.0.8", "checksum": UNCHECKED}
        connection.execute(update(results).where(results.c.key.in_(keys(store, run_id))).values(**older))
        connection.execute(update(runs).where(runs.c.id == run_id).values(**older))


def histories(client: httpx.Client, run_id: str) -> dict[str, bytes]:
    """Everything that shows a run's time histories."""
    contents = {}
    for query in (
        "series?strategy=lv,passive",
        "series?strategy=lv&points=300&encoding=base64",
        "series?strategy=passive&format=csv&signals=speed",
        "series?strategy=lv,passive&format=csv&points=500",
        "figures",
        "figures/speed?x=time",
    ):
        answer = client.get(f"/api/v1/runs/{run_id}/{query}")
        assert answer.status_code == 200, (query, answer.text)
        contents[query] = answer.content
    return contents


def test_a_link_opens_the_run_in_the_view_it_was_shared_in(client: httpx.Client, fresh: dict[str, Any]) -> None:
    answer = client.post("/api/v1/links", json={"run_id": fresh["id"], "view": VIEW})
    assert answer.status_code == 201
    made = answer.json()
    CreatedLink.model_validate(made)
    assert re.fullmatch("[A-Za-z0-9_-]{22}", made["slug"])
    assert answer.headers["location"] == f"/api/v1/links/{made['slug']}"
    link = opened(client, made["slug"])
    run = client.get(f"/api/v1/runs/{fresh['id']}", params={"baseline": "lv", "compare": "lv"}).json()
    created, computed_at = (datetime.fromisoformat(link.pop(name)) for name in ("created_at", "computed_at"))
    assert computed_at <= created
    assert abs(datetime.now(UTC) - created) < timedelta(minutes=10)
    shared = {"slug": made["slug"], "url": f"{client.base_url}/s/{made['slug']}", "series_pinned": True}
    assert {name: made[name] for name in shared} == shared
    versions = {"core_version": __version__, "current_core_version": __version__, "schema_version": SCHEMA_VERSION}
    content = {"kind": "run", "scenario": run["scenario"], "view": VIEW, "run": run, "batch": None, "damaged_at": None}
    assert link == {**shared, **versions, **content}
    elsewhere = client.get(f"/api/v1/links/{made['slug']}", headers={"Host": "lab.example.com"}).json()["url"]
    assert elsewhere == f"http://lab.example.com/s/{made['slug']}", "its address is as the service was asked for it"


def test_a_view_comes_back_as_it_was_sent(client: httpx.Client, run: dict[str, Any]) -> None:
    instant = {"strategy": "lv", "position": 31.5}
    views: list[dict[str, Any]] = [{}, {"zoom": None, "strategies": []}, {"zoom": [-0.0, 1e300], "instant": instant}]
    for view in views:
        assert opened(client, share(client, run["id"], **view)["slug"])["view"] == view


def test_pinned_histories_are_the_computed_ones_to_the_byte(
    client: httpx.Client, fresh: dict[str, Any], worker_calls: list[tuple[Any, ...]]
) -> None:
    computed = histories(client, fresh["id"])
    share(client, fresh["id"])
    worker_calls.clear()
    assert histories(client, fresh["id"]) == computed
    assert {call[0] for call in worker_calls} == {exports.render_pinned, pins.opened}, "none was computed again"


def test_what_it_is_compared_with_is_kept_as_well(service: Any, fresh: dict[str, Any], road: dict[str, Any]) -> None:
    """The pinned runs' histories outlive an upgrade of the core, and their results are a link's for the retention."""
    other = service.run(["lv", "passive"], {"road": {**road, "bump": {**road["bump"], "height": 0.031}}}).json()
    pin = {"name": "lower bump", "run": other["id"]}
    view = {"baseline": "lv", "pins": [pin], "reference": other["id"], "differences": True}
    assert opened(service, share(service, fresh["id"], **view)["slug"])["view"] == view
    of_another_core(service.services.store, other["id"])
    assert histories(service, other["id"]), "each of them answers, as for a link of its own"
    with service.services.store.reading() as connection:
        linked = set(connection.execute(select(links.c.run_id)).scalars())
    assert {fresh["id"], other["id"]} <= linked


def test_what_was_not_pinned_before_an_upgrade_keeps_its_metrics(service: Any, fresh: dict[str, Any]) -> None:
    of_another_core(service.services.store, fresh["id"])
    link = share(service, fresh["id"])
    assert link["series_pinned"] is False
    answer = opened(service, link["slug"])
    assert answer["series_pinned"] is False
    assert answer["run"]["strategies"]["lv"]["metrics"] == fresh["strategies"]["lv"]["metrics"]
    for path in ("series?strategy=lv", "figures"):
        refused = service.get(f"/api/v1/runs/{fresh['id']}/{path}")
        assert refused.status_code == 410
        assert "no link pinned them" in refused.json()["detail"]


def test_a_run_pinned_in_part_gives_that_part(service: Any, fresh: dict[str, Any]) -> None:
    """Another run's link pinned the passive car, which this run has too."""
    other = service.run(["passive"], fresh["scenario"]).json()
    share(service, other["id"])
    of_another_core(service.services.store, fresh["id"])
    series = service.get(f"/api/v1/runs/{fresh['id']}/series?points=40").json()
    assert series["strategy"] == "passive"
    assert service.get(f"/api/v1/runs/{fresh['id']}/series?strategy=lv").status_code == 422
    figure = service.get(f"/api/v1/runs/{fresh['id']}/figures/speed").json()
    assert [trace["meta"]["strategy"] for trace in figure["data"]] == ["passive"]
    assert share(service, fresh["id"])["series_pinned"] is False


def expire(store: Store, run_id: str) -> None:
    """Remove the results of the run that no link needs, as retention does with what is old."""
    with store.writing() as connection:
        old = datetime.now(UTC) - timedelta(days=40)
        connection.execute(update(results).where(results.c.key.in_(keys(store, run_id))).values(created_at=old))
    store.retention.remove("results", datetime.now(UTC) - timedelta(days=30))


def test_a_run_that_expires_while_it_is_shared_is_kept_all_the_same(
    service: Any, fresh: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Retention comes after the run was read and before its link is there."""
    store: Store = service.services.store
    save, saves = store.links.save, list[bool]()

    def late(*arguments: Any) -> bool:
        if not saves:
            expire(store, fresh["id"])
        saves.append(save(*arguments))
        return saves[-1]

    monkeypatch.setattr(store.links, "save", late)
    slug = share(service, fresh["id"])["slug"]
    assert saves == [False, True]
    expire(store, fresh["id"])
    stored = store.runs.load(fresh["id"])
    assert stored is not None
    assert not stored.expired, "a link shows it"
    assert opened(service, slug)["run"] == service.get(f"/api/v1/runs/{fresh['id']}").json()


def test_a_link_says_when_it_changed(service: Any, fresh: dict[str, Any]) -> None:
    address = f"/api/v1/links/{share(service, fresh['id'])['slug']}"
    answer = service.get(address)
    assert answer.headers["cache-control"] == "public, no-cache"
    tag = answer.headers["etag"]
    unchanged = service.get(address, headers={"If-None-Match": tag})
    assert (unchanged.status_code, unchanged.content, unchanged.headers["etag"]) == (304, b"", tag)
    of_another_core(service.services.store, fresh["id"])
    changed = service.get(address, headers={"If-None-Match": tag})
    assert changed.status_code == 200
    assert changed.headers["etag"] != tag


def test_a_run_stored_by_a_newer_version_is_refused_for_now(service: Any, fresh: dict[str, Any]) -> None:
    link = share(service, fresh["id"])
    with service.services.store.writing() as connection:
        newer = {"schema_version": SCHEMA_VERSION + 1, "checksum": UNCHECKED}
        connection.execute(update(runs).where(runs.c.id == fresh["id"]).values(**newer))
    for path in (f"runs/{fresh['id']}", f"runs/{fresh['id']}/figures", f"links/{link['slug']}"):
        answer = service.get(f"/api/v1/{path}")
        assert answer.status_code == 503
        assert answer.json()["type"].endswith("newer-schema")
        assert "retry-after" in answer.headers


def test_a_batch_can_be_shared(client: httpx.Client, road: dict[str, Any]) -> None:
    sweep = {"grid": {"road.bump.height": [0.01, 0.02]}}
    batch = computed(client, scenario={"road": road}, strategies=["passive"], sweep=sweep)
    view = {"x": "road.bump.height", "y": "bump.body_acceleration.peak", "baseline": "passive", "threshold": "none"}
    answer = client.post("/api/v1/links", json={"batch_id": batch["id"], "view": view}).raise_for_status()
    assert answer.json()["series_pinned"] is False
    link = opened(client, answer.json()["slug"])
    assert (link["kind"], link["run"], link["view"], link["scenario"]) == ("batch", None, view, batch["scenario"])
    assert [link["batch"][name] for name in ("id", "total", "fields")] == [batch["id"], 2, batch["fields"]]
