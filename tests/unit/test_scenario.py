"""The scenario: strict about names, types and numbers, and its schema says everything a form needs."""

import tomllib
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from sim_core.errors import UnknownNameError
from sim_core.scenario import Scenario, dotted, fields
from sim_core.scenario.data_sheet import DataSheet
from sim_core.scenario.presets import PRESETS
from sim_core.simulate import simulate
from tests import wording


@pytest.mark.parametrize("parts", wording.asked_in("scenarios"), ids=str)
def test_what_no_scenario_has_is_refused_at_its_field(parts: dict[str, Any]) -> None:
    """By place, field where several do not fit together, and message."""
    with pytest.raises(ValidationError) as refused:
        Scenario.model_validate(parts)
    wording.check("scenarios", parts, wording.errors_in(refused.value))
    assert "input_value" not in str(refused.value)


@pytest.mark.parametrize(
    ("own", "is_taken"),
    [
        ({f"law_{i}": {"gain": 1} for i in range(64)}, True),
        ({f"law_{i}": {"gain": 1} for i in range(65)}, False),
        ({"law": {f"gain_{i}": 1.5 for i in range(64)}}, True),
        ({"law": {f"gain_{i}": 1.5 for i in range(65)}}, False),
        ({"law": {"name": 200 * "a"}}, True),
    ],
)
def test_options_of_own_controllers_are_few_and_short(own: dict[str, Any], *, is_taken: bool) -> None:
    if is_taken:
        assert Scenario.model_validate({"own": own}).own.controllers == own
    else:
        with pytest.raises(ValidationError):
            Scenario.model_validate({"own": own})


def test_omitted_parts_take_the_papers_values_and_round_trip() -> None:
    scenario = Scenario.model_validate({"road": {"bump": {"height": 0.12}}})
    assert scenario.road.bump.width == 4
    assert list(scenario.mpc.stage_weights.bump) == [1, 1, 6]
    again = Scenario.model_validate_json(scenario.model_dump_json())
    assert again == scenario
    assert hash(again) == hash(scenario)


def test_every_number_in_the_schema_has_a_title_a_unit_limits_and_a_soft_range_within_them() -> None:
    definitions = Scenario.model_json_schema()["$defs"]
    seen = 0
    for definition in definitions.values():
        for name, field in definition.get("properties", {}).items():
            assert field.get("title") or "$ref" in field, name
            choices = field.get("anyOf", [field])
            number = next((choice for choice in choices if choice.get("type") in ("number", "integer")), None)
            if number is None:
                continue
            seen += 1
            low = number.get("minimum", number.get("exclusiveMinimum"))
            soft_low, soft_high = field["soft_range"]
            assert field["unit"], name
            assert low <= soft_low < soft_high <= number["maximum"], name
            assert field["description"].endswith("."), name
            default = field["default"]
            assert default is None or low <= default <= number["maximum"], name
            assert not default or soft_low <= default <= soft_high, f"{name}: a slider shows its default"
    assert seen > 40


def test_every_text_of_a_field_is_of_one_that_there_is() -> None:
    texts = tomllib.loads(Path(fields.__file__).with_suffix(".toml").read_text(encoding="utf-8"))
    schemas = [Scenario.model_json_schema(), DataSheet.model_json_schema()]
    parts = {schema["title"]: schema for each in schemas for schema in (each, *each.get("$defs", {}).values())}
    assert texts.keys() <= parts.keys()
    for part, named in texts.items():
        assert named.keys() - {"*"} <= parts[part]["properties"].keys(), part
        assert all(
            text.keys() <= {"title", "description", "note", "search_words", "read_by"} for text in named.values()
        ), part


def test_the_schema_describes_each_part_and_the_scenario_in_a_line() -> None:
    """The scenario's docstring has an example too, which no reader of the API has a use for."""
    schema = Scenario.model_json_schema()
    assert all(part["description"] for part in schema["$defs"].values())
    assert schema["description"].startswith("Everything a run depends on")
    assert "\n" not in schema["description"]


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("road.roughness", 1e-6),
        ("mismatch.preview_noise", 1e-4),
        ("estimation.kind", "kalman"),
        ("hil.noise", 0.001),
        ("hil.jitter", 0.001),
        ("hil.packet_loss", 0.01),
    ],
)
def test_a_smooth_road_is_random_with_noise_jitter_or_losses(path: str, value: Any) -> None:
    smooth = Scenario.model_validate({"road": {"roughness": 0}})
    assert not smooth.is_random
    assert Scenario.model_validate(dotted.with_changes(smooth.model_dump(mode="json"), {path: value})).is_random


@pytest.mark.parametrize("strategy", ["suspension_only", "lv"])
def test_no_limit_binds_in_the_nearest_reading_of_the_paper(strategy: str) -> None:
    result = simulate(PRESETS["paper_nearest"].scenario, strategy)
    assert result.events["limited_steps"] == 0
    assert result.stages[-2].end_position == 104, "both axles leave the bump together"


def test_a_name_that_is_unknown_may_have_meant_those_below_the_part_it_begins_with() -> None:
    assert {name.rpartition(".")[0] for name in dotted.offered("mpc.stage_weights.cruise.9")} == {
        "mpc.stage_weights.cruise"
    }
    assert {name.partition(".")[0] for name in dotted.offered("brake.strength")} == {"brake"}
    assert dotted.offered("brakes.lag") == list(dotted.fields())


def test_a_name_that_is_unknown_changes_nothing() -> None:
    plain = Scenario().model_dump(mode="json")
    changes = {"vehicle": {**plain["vehicle"], "body_mass": 700.0}, "mpc.stage_weights.cruise.0": 4.0}
    changed = Scenario.model_validate(dotted.with_changes(plain, changes))
    assert (changed.vehicle.body_mass, changed.mpc.stage_weights.cruise) == (700.0, (4.0, 1.0, 1.0))
    for name in ("road.bumb.height", "road.lenght", "road.length.x", "mpc.stage_weights.cruise.3"):
        with pytest.raises(UnknownNameError, match="Unknown field; there are "):
            dotted.with_changes(plain, {name: 1.0})
