"""The points of a sweep: which they are, and which names and values it takes."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from backend.batches.points import Sweep, SweepError, points
from sim_core.scenario import Scenario, dotted


def test_a_latin_hypercube_is_spread_over_its_ranges_and_the_same_for_a_seed() -> None:
    ranges: dict[str, list[float]] = {
        "road.bump.height": [0.02, 0.1],
        "mpc.prediction_horizon": [22, 26],
        "mpc.stage_weights.bump.2": [1, 9],
    }
    cube = {"latin_hypercube": {"ranges": ranges, "samples": 20, "seed": 5}}
    sweep, base = Sweep.model_validate(cube), Scenario().model_dump(mode="json")
    drawn = points(sweep, base)
    assert sweep.fields == list(ranges)
    assert points(sweep, base, 7, 5) == drawn[7:12]
    for name, (low, high) in ranges.items():
        values = [dotted.value(dotted.with_changes(base, point), name) for point in drawn]
        assert all(low <= value <= high for value in values)
        if name != "mpc.prediction_horizon":
            width = (high - low) / 20
            assert sorted(int((value - low) / width) for value in values) == list(range(20)), "one in each stratum"
        else:
            assert set(values) == {22, 23, 24, 25, 26}


def test_fields_of_a_sweep_are_dotted_or_nested() -> None:
    def sweep_of(sweep: dict[str, Any]) -> Any:
        return Sweep.model_validate(sweep)

    height, cube = {"road": {"bump": {"height": [0.05, 0.1]}}}, {"samples": 3, "seed": 0}
    flat = {"road.bump.height": [0.05, 0.1]}
    link = {"linked": {"road": {"bump.height": ["road.bump.width"]}}}
    assert sweep_of({"grid": height, **link}).model_dump(exclude_none=True) == {
        "grid": flat,
        "linked": {"road.bump.height": ["road.bump.width"]},
    }
    assert sweep_of({"latin_hypercube": {"ranges": height, **cube}}) == sweep_of(
        {"latin_hypercube": {"ranges": flat, **cube}}
    )
    curve = [[-0.1, -300], [0.1, 500]]
    point = {"vehicle": {"front_damper_curve": curve}, "road.seed": 2}
    assert sweep_of({"list": [point]}).points == [{"vehicle.front_damper_curve": curve, "road.seed": 2}]
    with pytest.raises(SweepError) as refused:
        points(sweep_of({"list": [{"road": {"sed": 1}}]}), Scenario().model_dump(mode="json"))
    assert [path for path, _ in refused.value.errors] == [["list", 0, "road.sed"]]


def test_the_first_fifty_errors_are_enough_and_a_piece_of_a_list_is_checked_alone() -> None:
    base = Scenario().model_dump(mode="json")
    unknown = Sweep.model_validate({"list": [{f"name{index}": 1} for index in range(60)]})
    with pytest.raises(SweepError) as refused:
        points(unknown, base, 0, 1)
    assert [path[1] for path, _ in refused.value.errors] == list(range(50))
    seeds = Sweep.model_validate({"list": [{"road.seed": seed} for seed in (1, 2, -1)]})
    assert points(seeds, base, 0, 2) == [{"road.seed": 1}, {"road.seed": 2}]
    with pytest.raises(SweepError) as refused:
        points(seeds, base, 2, 5)
    assert [path for path, _ in refused.value.errors] == [["list", 2, "road.seed"]]


@given(st.data())
def test_any_field_can_be_swept_and_what_it_takes_is_what_a_scenario_takes(data: st.DataObject) -> None:
    base = Scenario().model_dump(mode="json")
    name = data.draw(st.sampled_from(list(dotted.fields())))
    value = data.draw(
        st.one_of(st.floats(0, 60), st.integers(0, 60), st.sampled_from(["none", "osqp", "flat"]), st.none())
    )
    sweep = Sweep.model_validate({"grid": {name: [value]}})
    integer = dotted.field(name).kind == "integer"
    whole = integer and isinstance(value, float) and value.is_integer()
    expected = round(value) if whole and isinstance(value, float) else value  # 3.0 is taken for a whole number
    try:
        Scenario.model_validate(dotted.with_changes(base, {name: expected}))
        refused = False
    except ValidationError as error:  # fields that contradict each other are no matter of the sweep
        refused = any(item["type"] != "inconsistent" for item in error.errors())
    if refused:
        with pytest.raises(SweepError):
            points(sweep, base)
    else:
        (point,) = points(sweep, base)
        assert dotted.value(dotted.with_changes(base, point), name) == expected
