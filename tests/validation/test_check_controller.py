"""What is wrong with a custom controller: `check_controller` says it in a sentence, and a run refuses it."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import sim_core
from sim_core import Controller, LinearLaw, Seen, check_controller, option, scenario_field, simulate
from sim_core.errors import RidelabError
from sim_core.strategies import STRATEGIES
from tests.validation.controllers import SHORT, make_class

CALLS = iter(range(10**9))
FORCES: dict[str, tuple[Any, str]] = {
    "three numbers": ((0.0, 0.0, 0.0), "in step 0 it gave an array of the shape (3,)"),
    "words": (("1", "2"), "of type tuple that does not hold real numbers"),
    "imaginary": (np.array([1j, 0j]), "of type ndarray that does not hold real numbers"),
    "a table": ({"front": 0.0, "rear": 0.0}, "of type dict that does not hold real numbers"),
    "ragged": (((0.0, 0.0), 0.0), "of type tuple that does not hold real numbers"),
    "not finite": ((float("nan"), 0.0), "not finite"),
    "nothing": (None, "it gave None"),
}


@pytest.mark.parametrize("fault", FORCES)
def test_a_force_is_two_real_numbers(fault: str) -> None:
    """Else the sentence says what it was, and in which line of which file."""
    given, said = FORCES[fault]

    def force(_self: Controller, _seen: Seen) -> Any:
        return given

    (sentence,) = check_controller(make_class(force=force, __module__=__name__), SHORT)
    assert said in sentence
    assert f"{Path(__file__).name}, line " in sentence


def writes(_self: Controller, seen: Seen) -> Any:
    """Change what is seen."""
    seen.state[0] = 0.0


def raises(_self: Controller, _seen: Seen) -> Any:
    """Have an error."""
    raise KeyError("front")


TAKEN = "this name is used by Controller itself; rename the option"
MEMBERS: list[tuple[dict[str, Any], str]] = [
    ({"force": writes}, "changes what it was given"),
    ({"force": raises}, "KeyError: "),
    ({"force": lambda _self, _seen: (next(CALLS) % 100, 0.0)}, "Two runs of new objects differ"),
    ({"force": lambda _self, _seen: (100.0, 0.0), "actuated": False}, "no actuators, and gives a force"),
    ({"force": Controller.force, "linear_law": lambda _self, _stage: np.zeros((2, 10))}, "a LinearLaw or None"),
    ({"start": lambda _self: None}, "TypeError: "),
    ({"id": 3}, "id begins with a small letter"),
    ({"id": "lqr"}, "id is that of a strategy of Ridelab's"),
    ({"label": 3}, "label is no text"),
    ({"label": option(1.0), "__annotations__": {"label": float}}, TAKEN),
    ({"force": option(1.0), "__annotations__": {"force": float}}, TAKEN),
    ({"_own_values": option(1.0), "__annotations__": {"_own_values": float}}, TAKEN),
    ({"prediction_horizon": 2.5}, "prediction_horizon is a whole number"),
]


@pytest.mark.parametrize(("members", "said"), MEMBERS, ids=lambda value: value if isinstance(value, str) else "")
def test_the_check_says_what_is_wrong_with_a_class(members: dict[str, Any], said: str) -> None:
    assert check_controller(make_class(), SHORT) == []
    (sentence,) = check_controller(make_class(**members), SHORT)
    assert said in sentence


@pytest.mark.parametrize(
    ("force", "said"),
    [
        (lambda self, _seen: (self.calls.append(0) or len(self.calls) % 100, 0.0), "start has to forget"),
        (lambda _self, _seen: (next(CALLS) % 100, 0.0), "A second run of the same object differs"),
    ],
)
def test_the_check_drives_an_object_twice(force: Any, said: str) -> None:
    controller: Any = make_class(force=force)()
    controller.calls = []
    (sentence,) = check_controller(controller, SHORT)
    assert said in sentence


def test_the_check_reads_the_declaration() -> None:
    class Bare(Controller):
        id = "Bare one"
        number: float = option(-1.0, ge=0)
        other: float = scenario_field("hook.skyhok_damping")

    sentences = "\n".join(check_controller(Bare))
    for said in ("id begins", "label is empty", "no docstring", "neither force nor linear_law", "skyhok", "\nnumber: "):
        assert said in sentences


def test_what_is_no_controller_is_refused() -> None:
    assert check_controller("skyhook") == []
    with pytest.raises(RidelabError, match="skyhook"):
        check_controller("skyhok")
    nothing: Any = 5
    scenarios: list[Any] = ["paper", {}, sim_core.Scenario]
    assert len(check_controller(nothing)) == 1
    with pytest.raises(RidelabError, match=r"derived from sim_core\.Controller"):
        simulate(SHORT, nothing)
    for scenario in scenarios:
        with pytest.raises(RidelabError, match=r"sim_core\.Scenario"):
            simulate(scenario, "passive")


def test_a_class_that_is_in_no_file_is_checked_like_others() -> None:
    """As one typed in a notebook or at a prompt is."""
    names: dict[str, Any] = {"__name__": "nowhere", "Controller": Controller}
    exec("class Law(Controller):\n 'Law.'\n id = label = 'law'\n def force(self, seen):\n  return 1 / 0", names)  # noqa: S102
    assert check_controller(names["Law"]) == ["ZeroDivisionError: division by zero"]


DAMPERS = {"actuated": False, "dampers": lambda _: sim_core.SemiActiveDampers(least=0, most=1)}
PREDICTIVE, ECU = sim_core.PredictiveController, sim_core.EcuController
REFUSED: list[tuple[type[Controller], dict[str, Any], str]] = [
    (Controller, {"force": Controller.force}, "has to define force"),
    (sim_core.DampingController, {}, "has to define damping"),
    (PREDICTIVE, {}, "has to define weights"),
    (ECU, {}, "has to define weights"),
    (
        PREDICTIVE,
        {"weights": lambda *_: (1, 1, 1), "prediction_horizon": 0},
        "a prediction_horizon and a control_horizon of 1",
    ),
    (
        PREDICTIVE,
        {"weights": lambda *_: (1, 1, 1), "control_horizon": 0},
        "a prediction_horizon and a control_horizon of 1",
    ),
    (
        ECU,
        {"weights": lambda *_: (1, 1, 1), "prediction_horizon": 0},
        "a prediction_horizon and a control_horizon of 1",
    ),
    (Controller, {"preview": "ahead"}, "preview is one of none, wheelbase, lookahead, obstacle"),
    (Controller, {"prediction_horizon": -1}, "prediction_horizon is a whole number"),
    (Controller, {"prediction_horizon": 9}, "sets prediction_horizon and not preview"),
    (Controller, {"preview": "lookahead"}, "sets preview and not prediction_horizon"),
    (Controller, {"start": lambda self, _: setattr(self, "preview", "wheelbase")}, "are set before start"),
    (Controller, {"speed_plan": "fast"}, "speed_plan is planned or constant"),
    (Controller, {"speed_plan": property(lambda _: "constant")}, "set speed_plan on the class"),
    (Controller, {"delayed": option(default=False)}, "set delayed on the class"),
    (Controller, DAMPERS, "must have actuated = True"),
    (Controller, {"gain": scenario_field("hook.skyhok_damping")}, "hook.skyhook_damping"),
    (Controller, {"law": LinearLaw(gain=np.zeros((2, 10)), preview_gain=np.zeros((2, 3)))}, "three columns"),
]


@pytest.mark.parametrize(("base", "members", "said"), REFUSED)
def test_a_class_that_cannot_be_driven_is_refused(base: type[Controller], members: dict[str, Any], said: str) -> None:
    if "law" in members:
        members = members | {"linear_law": lambda self, _: self.law}
    with pytest.raises(RidelabError, match=re.escape(said)):
        simulate(SHORT, make_class(base, **members))


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: LinearLaw(gain=np.zeros((2, 4))), "shape"),
        (lambda: LinearLaw(gain=np.zeros((2, 10)), limits=np.zeros((3, 11))), "shape"),
        (
            lambda: LinearLaw(gain=np.zeros((2, 10)), preview_gain=np.zeros((2, 3)), limits=np.zeros((1, 16))),
            "as many control steps",
        ),
        (lambda: sim_core.SemiActiveDampers(least=-1.0, most=10.0), "damping"),
        (lambda: sim_core.SemiActiveDampers(least=20.0, most=10.0), "damping"),
        (lambda: sim_core.SemiActiveDampers(least=float("nan"), most=10.0), "damping"),
    ],
)
def test_laws_and_dampers_that_do_not_fit_are_refused(make: Any, said: str) -> None:
    with pytest.raises(RidelabError, match=said):
        make()


class Damps(Controller):
    """Damps the body."""

    id, label = "damps", "Damps"
    damping: float = option(2000.0, ge=0, le=20_000)


def test_a_value_is_refused_at_its_field() -> None:
    lv = STRATEGIES["lv"]
    for kind, values, field in (
        (Damps, {"damping": -1.0}, "own.damps.damping"),
        (Damps, {"damping": 20_001.0}, "own.damps.damping"),
        (Damps, {"damping": "2000"}, "own.damps.damping"),
        (lv, {"preview": "word"}, "mpc.preview"),
        (lv, {"prediction_horizon": 0}, "mpc.prediction_horizon"),
        (lv, {"stage_weights": "word"}, "mpc.stage_weights"),
    ):
        with pytest.raises(RidelabError) as refused:
            kind(**values)
        assert refused.value.field == field
    with pytest.raises(RidelabError, match="damping"):
        Damps(dampnig=1.0)
    assigned = Damps()
    assigned.damping = -1.0
    with pytest.raises(RidelabError, match="damping"):
        simulate(SHORT, assigned)
    assert lv(preview="none").for_scenario(SHORT).preview == "none"


@pytest.mark.parametrize(
    "members", [{}, {"preview": "lookahead", "prediction_horizon": 0}, {"preview": "none", "prediction_horizon": 9}]
)
def test_preview_is_there_for_those_who_ask_for_it_alone(members: dict[str, Any]) -> None:
    looking: dict[str, Any] = {"force": lambda _self, seen: seen.preview[0]}
    expecting: dict[str, Any] = {"force": lambda _self, seen: seen.disturbances[:2, 0]}
    (said,) = check_controller(make_class(**looking, **members), SHORT)
    assert "seen.preview" in said
    assert "prediction_horizon" in said
    if not members.get("prediction_horizon"):
        with pytest.raises(RidelabError, match=r"seen\.disturbances"):
            simulate(SHORT, make_class(**expecting, **members))
    asking = make_class(**looking, preview="wheelbase", prediction_horizon=9)
    assert check_controller(asking, SHORT) == []
