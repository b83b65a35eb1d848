"""Unknown names: which may be repeated, and where a validation error is in the body that was sent."""

from typing import Annotated, Literal

import pytest
from pydantic import BaseModel, Field

from backend.http.validation import locate_in_body
from backend.unknown_names import pointer
from sim_core.errors import UnknownNameError
from sim_core.scenario import Scenario, dotted


class Circle(BaseModel):
    kind: Literal["circle"]
    radius: float


class Square(BaseModel):
    kind: Literal["square"]
    edges: Annotated[list[float], Field(alias="sides")]


class Drawing(BaseModel):
    first: Annotated[Circle | Square, Field(discriminator="kind")] | None = None
    others: list[Circle | Square] = []
    pair: tuple[Circle, Square] | None = None
    named: dict[str, Square] = {}


@pytest.mark.parametrize(
    ("path", "shown", "names"),
    [
        ([], [], ["first", "others", "pair", "named"]),
        (["first", "square"], ["first"], ["kind", "sides"]),
        (["others", 3, "Circle"], ["others", 3], ["kind", "radius"]),
        (["pair", 1], ["pair", 1], ["kind", "sides"]),
        (["named", "it"], ["named", "it"], ["kind", "sides"]),
    ],
)
def test_the_place_is_the_bodys_own_and_names_are_those_in_json(
    path: list[str | int], shown: list[str | int], names: list[str]
) -> None:
    assert locate_in_body(Drawing, path) == (shown, names)


def test_a_json_pointer_is_escaped() -> None:
    assert pointer(["a/b", "c~d", 0]) == "/a~1b/c~0d/0"


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
