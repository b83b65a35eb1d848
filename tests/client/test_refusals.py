"""What commands refuse, and what they say: the option or the field, and what helps."""

import shlex
from pathlib import Path

import httpx
import pytest

from backend.batches.robustness import UNCERTAINTIES
from tests.client.cli import Cli
from tests.client.conftest import Prepared

PEAK = "bump.body_acceleration.peak"
NO_NUMBER = "12 kg is not understood: it takes m, mm, cm, km, in, ft or µm"
EACH_ITS_UNIT = "2 and 120cm: give each number its unit"
REFUSED = {  # words before -> words, and what is said of them
    "run --set": {
        "road.bump.height=NaN": "road.bump.height: NaN is not a finite number",
        "'road.bump.height=12 kg'": f"road.bump.height: {NO_NUMBER}",
        "road.bump.height=12": "road.bump.height: 12 m is not within -1 to 1 m; perhaps 12cm",
        "vehicle.body_mass=1.2": "vehicle.body_mass: 1.2 kg is not within 50 to 50000 kg; perhaps 1.2t",
        "road.bump.count=0": "road.bump.count: 0 is not within 1 to 200",
        "height=0.1": "height: there is no such name; perhaps road.bump.height",
        "vehicle.tyre_lift_off=2": "vehicle.tyre_lift_off: 2 is not understood: it takes true or false, on or off",
        "road.bump.height": "--set takes FIELD=VALUE, and road.bump.height is no such pair",
        "vehicle=vann": "vehicle: vann is neither a file nor a vehicle (small_car, sedan,",
    },
    "sweep --grid": {
        "vehicle.tyre_lift_off=0:1:2": "vehicle.tyre_lift_off: 0:1:2 is not understood: it takes true or",
        "road.bump.height=0:1:1": "road.bump.height: LOW:HIGH:COUNT",
        "road.bump.height=0.05:0.15:0.01": "0.05:0.15:0.01 is neither LOW:HIGH:COUNT, such as",
        "mpc.stage_weights.cruise=[8,NaN,1]": "NaN is no number",
        "road.seed=1 --grid road.seed=2": "road.seed: given twice to --grid",
        "road.bump.height=0.05,60mm": "road.bump.height: 0.05 and 60mm: give each number its unit, or none",
        "road.seed=1 -o x.xls": "--out: The file's format has to be json, csv or parquet",
        "road.seed=1 --out none/x.csv": "--out: there is no folder none",
    },
    "sweep --samples 2 --latin-hypercube": {
        "road.bump.width=2:120cm": f"road.bump.width: {EACH_ITS_UNIT}",
        "road.bump.height=1": "a range is LOW:HIGH",
    },
    "solve --field road.bump.height=0.1:0.2": {
        "--limit travel_time=4": "--strategy names the one that drives: lv, ",
    },
    "robustness": {
        f"--exact {','.join(each.field for each in UNCERTAINTIES)}": "Nothing is uncertain: every field is",
        "--exact road.bump.height": "--exact: road.bump.height is not varied",
        "--baseline groundhook": "--baseline: groundhook is not among the strategies",
    },
    "paper": {
        "--reading preview": "--reading takes READING=CHOICE",
        "--reading preview=none --reading preview=none": "--reading: one is given twice",
        "--report /nowhere/paper.html": "--report: there is no folder /nowhere",
        "--seeds few": "--seeds takes N or A-B",
        "--seeds 9-1": "--seeds: 9-1 has no road; A-B takes the smaller seed first",
    },
    "run --require": {
        f"{PEAK}=3": "--require takes METRIC<LIMIT or METRIC>LIMIT",
        f"'{PEAK}<3 kg'": f"{PEAK}: 3 kg is not understood",
        "bump.peek<3m": "bump.peek: there is no such name",
        f"{PEAK}>-20%": f"{PEAK}: a change has an upper limit",
    },
    "": {
        "run --junit x.xml": "--junit writes what becomes of requirements",
        "run --strategy lv --baseline passive": "--baseline: one of the strategies that run, lv",
        "sweep": "one of --grid, --latin-hypercube and --list",
        "sweep --latin-hypercube road.seed=1:2": "--samples belong together",
        "export paper --out -": "--format: The file's format has to be",
        "export paper --format csv --json --out -": "--json: the file itself would go",
        "compare - -": "Only one of A and B",
        "tune --objective paper:a,b,c": "--objective paper:Q1,Q2,Q3 takes three numbers",
        "tune --seeds 4-1": "--seeds takes whole numbers and spans of them",
        "instant paper -s lv": "Give --position or --time",
        "instant paper -s lv,lqr --time 1": "--strategy: this command takes one strategy, and lv,lqr are several",
        "frequency --stage jump": "--stage is one of cruise, brake, bump",
        "road nofile.csv": "nofile.csv: neither a file nor a measured road's id",
        "vehicle --sheet scenario.json": "front_axle_load: Field required",
    },
}


@pytest.mark.parametrize(
    ("words", "said"), [(f"{before} {words}", said) for before, each in REFUSED.items() for words, said in each.items()]
)
@pytest.mark.usefixtures("scenario")
def test_what_cannot_be_used_is_named(cli: Cli, words: str, said: str) -> None:
    assert cli(*shlex.split(words), code=2) == ""
    assert said in cli.error


def test_a_service_that_asks_for_a_token_leads_to_where_it_is_given(cli: Cli, prepared: Prepared) -> None:
    kind = "urn:problem-type:ridelab:token-required"
    refusal = {"type": kind, "status": 401, "detail": "With a token.", "errors": []}
    prepared.answers["GET /batches"] = httpx.Response(401, json=refusal)
    assert cli("jobs", "list", code=2) == ""
    assert "ridelab --token-file FILE COMMAND" in cli.error


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
