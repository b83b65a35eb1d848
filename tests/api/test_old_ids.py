"""Ids given out by earlier versions, on the command line."""

from dataclasses import replace
from pathlib import Path
from typing import Any

from backend.store import StoredLink
from tests.api.cli import Cli
from tests.api.conftest import Service


def test_an_old_id_that_begins_with_a_sign_is_an_id(
    cli: Cli, service: Service, run: dict[str, Any], tmp_path: Path
) -> None:
    """New ones begin with a letter or a digit; those given out before stand in papers and scripts."""
    plain, long = "-s0h-wlxdeCgHw4J2eqW3g", "--0Zt9MhQy5rUqf5n_Xk7A"  # the letters of options, in a cluster and long
    service.client.get(f"/api/v1/runs/{run['id']}").raise_for_status()  # computed again where its results were removed
    store, stored_run = service.app.state.store, service.app.state.store.runs.load(run["id"])
    for old in (plain, long):
        store.runs.save(replace(stored_run, id=old))
    slug = "-" + "k" * 21
    store.links.save(StoredLink(slug=slug, kind="run", target=plain, view={}), {})
    for name in (plain, long, slug):
        out = tmp_path / "out.csv"
        cli("export", "--strategy", "lv", name, "--signals", "speed", "--points", "50", "--out", out)
        assert out.read_text().startswith("time [s],position [m],speed [m/s]")
        out.unlink()
        assert name in cli("open", name, "--print")
        assert "Equal within the tolerance" in cli("compare", name, run["id"], "-s", "lv")
        assert "Equal within the tolerance" in cli("compare", run["id"], "-s", "lv", name)
        assert "1 runs, 1 points" in cli("sweep", name, "--grid", "road.seed=1", "--dry-run")
        assert cli("run", name, "--json", "-s", "lv").startswith("{")
    cli("tune", "--resume", plain, code=2)
    assert "There is no tuning of this id." in cli.error
    cli("export", "--no-such-option-atall", "--out", "x.csv", code=2)
    assert "No such option" in cli.error
