"""`python -m sim_core`, and the margins' rule."""

import json
from pathlib import Path

import pytest

from sim_core.__main__ import main
from sim_core.scenario import Road, Scenario
from sim_core.simulate import simulate
from sim_core.strategies import STRATEGIES
from sim_core.study.margins import PAPER_MARGINS, Means, change, margins


def test_table_of_the_paper_preset(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 0
    printed = capsys.readouterr().out
    for strategy in STRATEGIES.values():
        assert strategy.label in printed
    peak = simulate(Scenario(), "passive").metrics["bump"]["body_acceleration"]["peak"]
    assert f"{peak:.4g}" in printed


def test_scenario_file_and_errors(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "scenario.json"
    file.write_text(json.dumps({"road": {"roughness": 0, "length": 112}}), encoding="utf-8")
    assert main(["run", "--scenario", str(file), "--baseline", "lv"]) == 0
    assert "changes against LV control" in capsys.readouterr().out
    file.write_text('{"road": {"length": -1}}', encoding="utf-8")
    assert main(["run", "--scenario", str(file)]) == 2
    assert "road.length" in capsys.readouterr().err
    assert main(["run", "--preset", "moon"]) == 2
    assert main(["run", "--baseline", "moon"]) == 2
    assert main(["run", "--scenario", str(tmp_path / "none.json")]) == 2
    assert main(["margins", "--seeds", "0"]) == 2


def test_options_count_before_and_after_the_command(capsys: pytest.CaptureFixture[str]) -> None:
    printed = []
    for arguments in (["--preset", "pothole"], ["--preset", "pothole", "run"], ["run", "--preset", "pothole"]):
        assert main(arguments) == 0
        printed.append(capsys.readouterr().out.split("travel time")[0])  # what follows has timings
    assert "preset pothole" in printed[0]
    assert printed[0] == printed[1] == printed[2]


def test_margins_command_says_which_cells_are_reached(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["margins", "--seeds", "1", "--preview", "none"]) == 0
    printed = capsys.readouterr().out
    assert "of 8 cells reached" in printed
    assert "points" in printed  # without preview some are not, and it says by how much


def test_margin_rule() -> None:
    cells = list(PAPER_MARGINS)
    lv = dict.fromkeys(cells, 1.0)
    lqr = dict.fromkeys(cells, 1.2)
    means: Means = {"lv": lv, "lqr": lqr}
    reached = {(cell.window, cell.signal): cell.reached for cell in margins(means)}
    assert reached["rough_road", "body_acceleration"]  # 20 >= 12.3
    assert not reached["rough_road", "pitch_acceleration"]  # 20 < 23.9
    assert reached["bump", "body_acceleration"]  # 20 >= 19.9
    assert not reached["bump", "front_tyre_load"]  # 20 < 24
    assert change(1.0, 0.0) != change(1.0, 0.0)  # NaN: nothing to compare with


def test_margins_are_the_papers_its_misprint_mended() -> None:
    tables = Path(__file__).parents[1] / "data" / "paper_tables.json"
    paper = json.loads(tables.read_text(encoding="utf-8"))
    rough, bump = (paper["printed_changes"][f"table_{name} lqr vs lv"] for name in ("9 rough_road_rms", "10 bump_peak"))
    mended = paper["misprint"]["table_9 rough_road_rms lqr vs lv body_acceleration"]
    assert mended["printed"] == rough[0]
    assert list(PAPER_MARGINS.values()) == [mended["follows"], *rough[1:], *bump]


def test_a_road_that_ends_on_the_bump_is_told() -> None:
    on_it = Scenario(road=Road(length=105))
    assert simulate(on_it, "passive").events["bump_complete"] is False
    assert simulate(Scenario(), "passive").events["bump_complete"] is True


@pytest.mark.parametrize(("command", "name"), [("fields", "scenario.md"), ("errata", "errata.md")])
def test_a_reference_page_is_what_the_command_prints(
    command: str, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([command]) == 0
    page = Path(__file__).parents[2] / "docs" / name
    assert page.read_text(encoding="utf-8") == capsys.readouterr().out
