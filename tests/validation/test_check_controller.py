"""`check_controller` says in a sentence what is wrong with a controller of one's own."""

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sim_core import Bump, Controller, Road, Scenario, Seen, Setup, check_controller, option, scenario_field, simulate
from sim_core.errors import ForceError, RidelabError

SHORT = Scenario(road=Road(length=60, bump=Bump(start=30)))


class Faulty(Controller):
    """Does something wrong."""

    id = "faulty"
    label = "Faulty"
    fault: str = option("none")
    gain: float = scenario_field("hook.skyhook_damping")
    calls = 0

    def start(self, setup: Setup) -> None:
        if self.fault != "keeps state":
            self.memory = [0.0]

    def force(self, seen: Seen) -> Any:
        Faulty.calls += 1
        self.memory[0] += 1.0
        if self.fault == "writes":
            seen.state[0] = 0.0
        if self.fault == "raises":
            raise KeyError("front")
        forces: dict[str, Any] = {
            "three numbers": (0.0, 0.0, 0.0),
            "words": ("1", "2"),
            "imaginary": np.array([1j, 0j]),
            "a table": {"front": 0.0, "rear": 0.0},
            "ragged": ((0.0, 0.0), 0.0),
            "not finite": (float("nan"), 0.0),
            "nothing": None,
            "keeps state": (self.memory[0] % 100, 0.0),
            "not repeatable": (Faulty.calls % 100, 0.0),
        }
        return forces.get(self.fault, (0.0, 0.0))


def test_a_forces_error_survives_the_way_from_a_worker() -> None:
    error = ForceError("It gave None", line=7)
    sent = pickle.loads(pickle.dumps(error))  # noqa: S301 - our own, as between processes
    assert (sent.message, sent.line) == ("It gave None", 7)


@pytest.mark.parametrize(
    ("fault", "said"),
    [
        ("three numbers", "two numbers, front and rear; in step 0 it gave an array of the shape (3,)"),
        ("words", "it gave an object of type tuple that does not hold real numbers"),
        ("imaginary", "it gave an object of type ndarray that does not hold real numbers"),
        ("a table", "it gave an object of type dict that does not hold real numbers"),
        ("ragged", "it gave an object of type tuple that does not hold real numbers"),
        ("nothing", "it gave None"),
        ("not finite", "not finite"),
        ("writes", "changes what it was given"),
        ("raises", "KeyError: "),
        ("keeps state", "start has to forget"),
        ("not repeatable", "A second run of the same object differs"),
    ],
)
def test_the_check_says_what_is_wrong(fault: str, said: str) -> None:
    controller = Faulty(fault=fault)
    controller.memory = [0.0]
    (sentence,) = check_controller(controller, SHORT)
    assert said in sentence
    own_rules = fault in ("keeps state", "not repeatable")
    assert own_rules or f"{Path(__file__).name}, line " in sentence


def test_the_check_reads_the_declaration() -> None:
    class Bare(Controller):
        id = "Bare one"
        number: float = option(-1.0, ge=0)
        other: float = scenario_field("hook.skyhok_damping")

    sentences = "\n".join(check_controller(Bare))
    for said in ("id begins", "label is empty", "no docstring", "neither force nor linear_law", "skyhok"):
        assert said in sentences
    assert "\nnumber: Input should be greater than or equal to 0\n" in sentences


@pytest.mark.parametrize(
    "name", ["label", "id", "report", "description", "options", "force", "actuated", "_own_values"]
)
def test_the_check_says_that_an_option_has_a_name_that_is_taken(name: str) -> None:
    members = {"__doc__": "Gives no force.", "id": "fine", "force": lambda _self, _seen: (0.0, 0.0), name: option(1.0)}
    said = f"{name}: this name is used by Controller itself; rename the option"
    assert check_controller(type("Wrong", (Controller,), {**members, "__annotations__": {name: float}})) == [said]


@pytest.mark.parametrize(
    ("members", "said"),
    [
        ({"id": 3}, "id begins with a small letter and has small letters, digits and underscores only"),
        ({"id": "lqr"}, "id is that of a strategy of Ridelab's; taken are lv, lv_hil, lqr, "),
        ({"label": 3}, "label is no text"),
        ({"prediction_horizon": 2.5}, "prediction_horizon is a whole number, 0 or more"),
        ({"force": lambda _self, _seen: (100.0, 0.0), "actuated": False}, "no actuators, and gives a force"),
        (
            {"force": Controller.force, "linear_law": lambda _self, _stage: np.zeros((2, 10))},
            "a LinearLaw or None",
        ),
        ({"start": lambda _self: None}, "TypeError: "),
    ],
    ids=lambda value: "-".join(value) if isinstance(value, dict) else "",
)
def test_the_check_says_what_is_wrong_with_a_class(members: dict[str, Any], said: str) -> None:
    good = {"id": "fine", "label": "Fine", "__doc__": "Gives no force.", "force": lambda _self, _seen: (0.0, 0.0)}
    assert check_controller(type("Fine", (Controller,), good), SHORT) == []
    (sentence,) = check_controller(type("Wrong", (Controller,), good | members), SHORT)
    assert said in sentence


def test_the_check_takes_an_id_and_refuses_what_is_no_controller() -> None:
    assert check_controller("skyhook") == []
    with pytest.raises(RidelabError, match="skyhook"):
        check_controller("skyhok")
    nothing: Any = 5
    assert "derived from sim_core.Controller" in check_controller(nothing)[0]
    with pytest.raises(RidelabError, match=r"derived from sim_core\.Controller"):
        simulate(SHORT, nothing)


@pytest.mark.parametrize(
    ("law", "said"),
    [
        ("[0.0]", "Law: force gives two numbers, front and rear; in step 0 it gave an array of the shape (1,)"),
        ("1 / 0", "ZeroDivisionError: division by zero"),
    ],
)
def test_a_class_that_is_in_no_file_is_checked_like_others(law: str, said: str) -> None:
    """As one typed in a notebook or at a prompt is."""
    names: dict[str, Any] = {"__name__": "nowhere", "Controller": Controller}
    source = f"class Law(Controller):\n 'Law.'\n id, label = 'law', 'Law'\n def force(self, seen):\n  return {law}\n"
    exec(source, names)  # noqa: S102  # what a notebook does
    assert check_controller(names["Law"]) == [said]
