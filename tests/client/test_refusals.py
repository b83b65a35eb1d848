"""What commands refuse, and what they say: the option or the field, and what helps."""

from pathlib import Path

import httpx
import pytest

from backend.batches.robustness import UNCERTAINTIES
from tests.client.cli import Cli
from tests.client.conftest import Prepared


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("tune --objective paper:a,b,c", "--objective paper:Q1,Q2,Q3 takes three numbers"),
        ("tune --limit travel_time", "--limit takes METRIC=MOST"),
        ("tune --seeds 4-1", "--seeds takes whole numbers and spans of them"),
        ("solve --field road.bump.height=0.1:0.2:3 --limit travel_time=4 -s lv", "a range is LOW:HIGH"),
        ("solve --field road.bump.height=0.1:0.2 --limit travel_time=4", "--strategy names the one that drives: lv, "),
        ("solve --field road.bump.height=0.1:0.2 --limit 4 -s lv", "--limit takes METRIC=MOST"),
        ("instant paper -s lv", "Give --position or --time"),
        ("frequency --stage jump", "--stage is one of cruise, brake, bump"),
        (
            "robustness --exact " + ",".join(each.field for each in UNCERTAINTIES),
            "Nothing is uncertain: every field is",
        ),
        ("robustness --exact road.bump.height", "--exact: road.bump.height is not varied"),
        ("robustness --baseline groundhook", "--baseline: groundhook is not among the strategies"),
        ("road nofile.csv", "nofile.csv: neither a file nor a measured road's id"),
        ("run --set vehicle=vann", "vehicle: vann is neither a file nor a vehicle (small_car, sedan,"),
        ("run --set vehicle=scenario.json", "scenario.json: this file has no member vehicle"),
        ("vehicle --out a.json", "--out needs a VEHICLE or --sheet FILE"),
        ("vehicle --sheet scenario.json", "front_axle_load: Field required"),
        ("paper --reading preview", "--reading takes READING=CHOICE"),
        ("paper --reading preview=none --reading preview=none", "--reading: one is given twice"),
        ("paper --report /nowhere/paper.html", "--report: there is no folder /nowhere"),
        ("paper --seeds few", "--seeds takes N or A-B"),
        ("paper --seeds 9-1", "--seeds: 9-1 has no road; A-B takes the smaller seed first"),
        (
            "solve --field road.bump.height=0.1:0.2 --limit travel_time=9 -s lv,lqr",
            "takes one strategy, and lv,lqr are",
        ),
        ("instant paper -s lv,lqr --time 1", "--strategy: this command takes one strategy, and lv,lqr are several"),
        ("fmu -s lv,lqr", "--strategy: this command takes one strategy, and lv,lqr are several"),
    ],
)
@pytest.mark.usefixtures("scenario")
def test_what_cannot_be_used_is_named(cli: Cli, words: str, said: str) -> None:
    assert cli(*words.split(), code=2) == ""
    assert said in cli.error


def test_a_service_that_asks_for_a_token_leads_to_where_it_is_given(cli: Cli, prepared: Prepared) -> None:
    refusal = {
        "type": "urn:problem-type:ridelab:token-required",
        "status": 401,
        "detail": "With a token.",
        "errors": [],
    }
    prepared.answers["GET /batches"] = httpx.Response(401, json=refusal)
    assert cli("jobs", "list", code=2) == ""
    assert "ridelab --token-file FILE COMMAND, or the variable RIDELAB_TOKEN" in cli.error


def test_too_few_roads_for_the_paper_are_said_as_roads(cli: Cli, prepared: Prepared) -> None:
    wrong = {"parameter": "seeds", "pointer": "", "message": "Input should be greater than or equal to 20"}
    prepared.answers["GET /paper"] = httpx.Response(422, json={"status": 422, "detail": "Wrong.", "errors": [wrong]})
    assert cli("paper", "--seeds", "1-10", code=2) == ""
    assert cli.error == "--seeds: 1-10 are 10 roads. Input should be greater than or equal to 20\n"


def test_a_recording_whose_columns_are_not_understood_leads_to_the_option(
    cli: Cli, prepared: Prepared, tmp_path: Path
) -> None:
    file = tmp_path / "drive.csv"
    file.write_text("t,acc\n0,1\n")
    problem = {"status": 422, "detail": "x", "errors": [{"pointer": "", "message": "Line 1: No column is a signal."}]}
    prepared.answers["POST /recordings"] = httpx.Response(422, json=problem)
    hint = f"--column says what a column of {file} is: 'acc_z=body_acceleration [g]'\n"
    compare = ("compare", "paper", file, "-s", "passive")
    cli(*compare, code=2)
    assert cli.error == f"Line 1: No column is a signal.\n{hint}"
    cli(*compare, "--column", "acc=body_acceleration [g]", code=2)
    assert cli.error == "Line 1: No column is a signal.\n"
