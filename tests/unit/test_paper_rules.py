"""The paper's numbers as we hold them, and the rules of a verdict: rules are pinned, verdicts are not."""

import json
from math import inf, nan
from pathlib import Path

import numpy as np
import pytest

from backend.paper import answers, claims
from backend.paper.absolutes import distance, printed
from backend.paper.attribution import FACTORS, VARIANTS, shares
from backend.paper.claims import FIGURES, Verdict, judge, scenario_for, verdict
from backend.paper.interpretations import (
    DEFAULT,
    FAVOURABLE,
    INTERPRETATIONS,
    NEAREST,
    OPEN_QUESTIONS,
    interpretation_of,
)
from backend.paper.tables import ABSOLUTES, TABLES, cells
from sim_core import Road, Scenario, simulate
from sim_core.catalogue import PAPER_SIGNALS
from sim_core.errors import UnknownNameError
from sim_core.scenario.dotted import field
from sim_core.scenario.presets import preset

COPY = json.loads((Path(__file__).parents[1] / "data" / "paper_tables.json").read_text())
NAMED = {"lv_hil": "hil"}


def test_the_absolutes_are_the_printed_ones() -> None:
    for (window, statistic), strategies in ABSOLUTES.items():
        copy = COPY["absolute"][f"{window}_{statistic}"]
        ours = {NAMED.get(name, name): dict(zip(PAPER_SIGNALS, row, strict=True)) for name, row in strategies.items()}
        assert ours == copy


def test_the_changes_are_the_printed_ones() -> None:
    ours = {
        f"table_{table.number} {table.window}_{table.statistic} {NAMED.get(one, one)} vs {against}": list(changes)
        for table in TABLES
        for one, against, changes in table.columns
    }
    assert ours == COPY["printed_changes"]


def test_the_misprints_are_those_that_do_not_follow_from_the_absolutes() -> None:
    """Printed changes are rounded to a tenth or a hundredth, and absolutes too: 0.1 points cover both."""
    marked = {
        f"table_{cell.table} {cell.window}_{cell.statistic} {NAMED.get(cell.strategy, cell.strategy)} "
        f"vs {cell.against} {cell.signal}": {"printed": cell.printed, "follows": cell.follows}
        for cell in cells()
        if cell.follows is not None
    }
    assert marked == COPY["misprint"]
    for cell in cells():
        follows = 100 * (cell.value / cell.base - 1)
        assert follows == pytest.approx(cell.claim, abs=0.1 if cell.strategy != "lv_hil" else 0.15), cell


@pytest.mark.parametrize(
    ("claim", "ours", "expected"),
    [
        (-25.0, -25.0, Verdict.REACHED),
        (-25.0, -60.0, Verdict.REACHED),
        (-25.0, -24.999, Verdict.SMALLER),
        (-25.0, 0.0, Verdict.CONTRADICTS),
        (8.45, 3.0, Verdict.SMALLER),
        (8.45, -9.0, Verdict.CONTRADICTS),
        (8.45, nan, Verdict.CONTRADICTS),
        (8.45, inf, Verdict.REACHED),
    ],
)
def test_the_rule(claim: float, ours: float, expected: Verdict) -> None:
    assert verdict(claim, ours, hil=False) is expected


def test_hardware_in_the_loop_is_within_8_percent_of_the_simulation_whatever_is_printed() -> None:
    reached, contradicts = ([verdict(claim, ours, hil=True) for claim in (1.6, -50)] for ours in (-8.0, -8.01))
    assert reached == [Verdict.REACHED] * 2
    assert contradicts == [Verdict.CONTRADICTS] * 2


def values_of(factor: dict[str, float], spread: float = 0.0) -> claims.Values:
    """Every strategy's figures: a common one times the strategy's factor, over 20 roads."""
    noise = np.random.default_rng(1).standard_normal(20)
    return {
        name: {figure: [factor.get(name, 1.0) * (10 + spread * float(each)) for each in noise] for figure in FIGURES}
        for name in claims.STRATEGIES
    }


def test_cells_are_judged_against_what_follows_where_it_is_misprinted() -> None:
    """Table 8 prints -44.0 where -62.6 follows: -50 % reaches the printed change, but not the paper's own absolutes."""
    judged = judge(values_of({"lv": 0.5}))
    verdicts = {
        (item.cell.table, item.cell.strategy, item.cell.against, item.cell.signal): item.verdict for item in judged
    }
    assert verdicts[8, "lv", "speed_only", "rear_tyre_load"] is Verdict.SMALLER
    assert verdicts[8, "lv", "speed_only", "body_acceleration"] is Verdict.REACHED
    assert sum(claims.count(judged).values()) == len(judged)


def test_a_verdict_is_certain_where_its_whole_interval_gets_it() -> None:
    """Paired values that differ by a factor have no spread of their ratio; one that scatters has."""
    assert all(item.certain for item in judge(values_of({"lv": 0.5}, spread=1.0)))
    noise = np.random.default_rng(2).standard_normal(20)
    values = {name: dict(each) for name, each in values_of({}).items()}
    for figure in FIGURES:
        values["lv"][figure] = [float(10 * (1 - 0.313) + each) for each in noise]
    item = next(each for each in judge(values) if each.cell.claim == -31.3)
    assert item.change.low < -31.3 < item.change.high
    assert not item.certain


def test_every_reading_changes_fields_that_exist_and_the_first_choice_is_ours() -> None:
    default = Scenario().model_dump(mode="json")
    for reading in OPEN_QUESTIONS.values():
        assert len({choice.id for choice in reading.choices}) == len(reading.choices) > 1
        for choice in reading.choices:
            for name, value in choice.changes.items():
                field(name).checked(value)
            ours = scenario_for({reading.id: choice.id}, 1).model_dump(mode="json")
            changes_no_run = choice.id == reading.default or reading.id in claims.WITHOUT_RUNS
            assert (ours == default) == changes_no_run, (reading.id, choice.id)
            assert (choice.intervals is None) == (choice.id == reading.default or reading.id != claims.WINDOW)
    for unknown in ({"colour": "red"}, {"preview": "red"}):
        with pytest.raises(UnknownNameError):
            scenario_for(unknown, 1)


def test_the_named_sets() -> None:
    scenario = scenario_for(FAVOURABLE.choices, 1)
    assert scenario.vehicle.cg_height == 0
    assert (scenario.mpc.force_limit, scenario.mpc.sample_time, scenario.mpc.deflection_limit) == (20_000, 0.005, 0.1)
    assert scenario_for(DEFAULT.choices, 1) == Scenario()
    assert scenario_for(NEAREST.choices, 1) == preset("paper_nearest")
    assert [interpretation_of(item.choices) for item in INTERPRETATIONS.values()] == list(INTERPRETATIONS)
    assert interpretation_of(FAVOURABLE.choices | {"force_limit": "10"}) is None


def test_load_transfer_bounds_the_front_tyre_under_every_controller() -> None:
    """On a smooth road load transfer is all there is: no controller gets the front tyre 3 % below speed control."""
    scenario = Scenario(road=Road(roughness=0))
    rms = {
        name: simulate(scenario, name).metrics["rough_road"]["front_tyre_load"]["rms"]
        for name in ("speed_only", "lv", "lqr")
    }
    assert rms["speed_only"] > 200
    for name in ("lv", "lqr"):
        assert rms[name] == pytest.approx(rms["speed_only"], rel=0.03), name


def test_shares_add_up_and_are_right_where_factors_multiply() -> None:
    """Where factors multiply, a factor's share is that of its logarithm, in any order: a known answer."""
    factors = {"speed": 0.5, "preview": 0.8, "switching": 1.25}

    def value(name: str) -> float:
        parts = name.split("-")
        if parts[0] != "mpc" or parts[2] == "wheelbase" or parts[3] == "comfort":
            return 1.0
        on = {"speed": parts[1] == "planned", "preview": parts[2] == "lookahead", "switching": parts[3] == "switched"}
        return float(np.prod([factors[each] if on[each] else 1 for each in FACTORS]))

    values = {variant.id: {figure: [value(variant.id)] * 3 for figure in FIGURES} for variant in VARIANTS}
    for item in shares(values):
        assert item.total_change == pytest.approx(-50.0)
        assert item.speed == pytest.approx(100.0)
        assert item.preview == pytest.approx(100 * np.log(0.8) / np.log(0.5))
        assert item.speed + item.preview + item.switching == pytest.approx(100)


def test_a_count_is_split_and_agreement_counts_what_we_simulate() -> None:
    """LV at half of all others, in the ECU too: ours is 0 % between those two, -50 % or +100 % elsewhere."""
    judged = judge(values_of({"lv": 0.5, "lv_hil": 0.5}))
    simulated, in_ecu = claims.split(judged)
    assert (len(simulated), len(in_ecu)) == (40, 8)
    assert {item.cell.strategy for item in in_ecu} == {"lv_hil"}
    assert {item.verdict for item in in_ecu} == {Verdict.REACHED}
    # Near 0 %: -7.54, +8.45 and -2.77; near -50 %: -47.9, -43.6 and -44.7, but not -39.9; none is just that.
    agreement = answers.agreement(judged)
    assert (agreement.cells, agreement.within, agreement.in_interval) == (40, 6, 0)


def test_a_distance_is_a_factor_either_way() -> None:
    """Half and twice what is printed are as far; of factors 2, 2 and 8 the median is 2, the geometric mean 2^(5/3)."""
    first, second, third = FIGURES[:3]
    ours = {
        "passive": {first: printed("passive", first) / 2, second: printed("passive", second) * 2},
        "lv": {third: printed("lv", third) * 8},
    }
    away = distance(ours)
    assert away.values == 3
    assert (away.median, away.mean) == pytest.approx((2, 2 ** (5 / 3)))
