"""`ridelab tune` against the real service: what it prints is what the service answers."""

import json
import re
from pathlib import Path

import httpx
import pytest

from ridelab import Ridelab
from tests.api.cli import Cli

SCENARIO = {"road": {"length": 62, "bump": {"start": 45}}, "speed": {"detection_distance": 40}}
ROADS = ("--seeds", "1-2", "--fresh", "11,12-13")
SHORT = ("--strategy", "lqr", "--trials", "8", "--population", "4", *ROADS)


def test_the_best_weights_are_printed_and_written(cli: Cli, scenario: Path, tmp_path: Path) -> None:
    out = tmp_path / "tuned.json"
    objectives = ("--objective", "peaks@whole:1,2,1", "--objective", "bump.front_tyre_load.peak")
    limited = ("--limit", "comfort.actuator_peak_power=50000")
    printed = cli("tune", scenario, *SHORT, *objectives, *limited, "-o", out)
    tuning_id = re.search(r"^tuning ([\w-]{22}): done, 8 of 8 done, 0 failed$", cli.error, re.MULTILINE)
    assert tuning_id is not None, cli.error
    answer = json.loads(cli("tune", "--resume", tuning_id[1], "--json"))
    assert answer["objectives"][0]["q"] == [1, 2, 1]
    assert (answer["seeds"], answer["fresh_seeds"]) == ([1, 2], [11, 12, 13])
    assert "training roads 1-2, validation roads 11-13" in printed
    assert cli("tune", "--resume", tuning_id[1]) == printed, "shown again, nothing is computed"
    assert json.loads(out.read_text())["lqr"]["weights"] == answer["knee"]["weights"]["lqr.weights"]


def test_more_trials_and_none_that_keeps_the_limits(cli: Cli, scenario: Path) -> None:
    impossible = ("--limit", "comfort.actuator_peak_power=-1")
    answer = json.loads(cli("tune", scenario, *SHORT, *impossible, "--json", code=1))
    assert (answer["state"], answer["trials"]["feasible"]) == ("done", 0)
    printed = cli("tune", "--resume", answer["id"], "--trials", "12", code=1)
    assert "12 trials on roads 1-2, 0 within the limits" in printed
    assert "best" not in printed


def test_a_detached_one_goes_on_without_the_command(cli: Cli, scenario: Path, client: httpx.Client) -> None:
    printed = cli("tune", scenario, *SHORT, "--seed", "3", "--detach")
    tuning_id = printed.strip()
    assert f"ridelab tune --resume {tuning_id} --server" in cli.error
    with Ridelab(str(client.base_url)) as ridelab:
        tuning = ridelab.get_tuning(tuning_id)
        counts: list[int] = []
        tuning.wait(lambda each: counts.append(each.done))
        assert (tuning.state, tuning.done, tuning.failed, tuning.total) == ("done", 8, 0, 8)
        assert counts == sorted(counts)
        assert len(tuning.trials()) == 8
        assert tuning.trials()[0] == tuning.paper
        assert tuning.best[0] in tuning.front
        assert (tuning.knee, tuning.feasible) == (None, 8)
        assert tuning.comparison is not None
        assert repr(tuning) == f"Tuning({tuning_id}: done, 8 done, 0 failed of 8)"
        assert tuning.resume(12).wait().done == 12
        same = {"scenario": SCENARIO, "strategy": "lqr", "trials": 2}
        assert ridelab.tune(same, idempotency_key="tune-once").id == ridelab.tune(same, idempotency_key="tune-once").id
        assert ridelab.estimate_tuning(same)["generations"] == 1


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--strategy", "passive"], "strategy: Input should be 'lv', 'suspension_only' or 'lqr'"),
        (["--objective", "paper:a,b,c"], "--objective paper:Q1,Q2,Q3 takes three numbers"),
        (["--limit", "travel_time"], "--limit takes METRIC=MOST"),
        (["--search", "lqr.weight=1:2"], "search.lqr.weight: Unknown weight lqr.weight, perhaps lqr.weights.2"),
        (["--seeds", "4-1"], "--seeds takes whole numbers and spans of them"),
        (["--resume", "x" * 22], "There is no tuning of this id."),
    ],
)
def test_what_cannot_be_used_is_named(cli: Cli, arguments: list[str], said: str) -> None:
    assert cli("tune", *arguments, code=2) == ""
    assert cli.error.startswith(said), cli.error
