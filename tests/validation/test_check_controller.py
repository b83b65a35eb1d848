"""What is wrong with a custom controller: `check_controller` says it in a sentence, and a run refuses it."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import sim_core
from sim_core import (
    Controller,
    DampingController,
    EcuController,
    LinearLaw,
    PredictiveController,
    Seen,
    SemiActiveDampers,
    check_controller,
    option,
    scenario_field,
    simulate,
)
from sim_core.errors import RidelabError
from sim_core.strategies import STRATEGIES
from tests import wording
from tests.validation.controllers import SHORT, make_class

CALLS = iter(range(10**9))


def fine(**members: Any) -> type[Controller]:
    """A class without a fault but for these members, of this file."""
    return make_class(__module__=__name__, **members)


def gives(force: Any) -> type[Controller]:
    return fine(force=lambda _self, _seen: force)


def predicts(base: type[Controller], **members: Any) -> type[Controller]:
    return make_class(base, weights=lambda *_: (1, 1, 1), **members)


def named(name: str, value: Any) -> type[Controller]:
    """An option of a name that Controller uses itself."""
    return fine(**{name: value, "__annotations__": {name: float}})


def writes(_self: Controller, seen: Seen) -> Any:
    seen.state[0] = 0.0


def raises(_self: Controller, _seen: Seen) -> Any:
    raise KeyError("front")


def remembering() -> Controller:
    controller: Any = fine(force=lambda self, _seen: (self.calls.append(0) or len(self.calls) % 100, 0.0))()
    controller.calls = []
    return controller  # type: ignore[no-any-return]


class Bare(Controller):
    id = "Bare one"
    number: float = option(-1.0, ge=0)
    other: float = scenario_field("hook.skyhok_damping")


def follows(law: LinearLaw) -> type[Controller]:
    return fine(force=Controller.force, linear_law=lambda _self, _stage: law)


FAULTS: dict[str, Any] = {
    "a force of three numbers": gives((0.0, 0.0, 0.0)),
    "a force of words": gives(("1", "2")),
    "an imaginary force": gives(np.array([1j, 0j])),
    "a table for a force": gives({"front": 0.0, "rear": 0.0}),
    "a ragged force": gives(((0.0, 0.0), 0.0)),
    "a force that is not finite": gives((float("nan"), 0.0)),
    "nothing for a force": gives(None),
    "changes what it sees": fine(force=writes),
    "an error": fine(force=raises),
    "runs differ": fine(force=lambda _self, _seen: (next(CALLS) % 100, 0.0)),
    "runs of an object differ": fine(force=lambda _self, _seen: (next(CALLS) % 100, 0.0))(),
    "an object remembers": remembering(),
    "a force without actuators": fine(force=lambda _self, _seen: (100.0, 0.0), actuated=False),
    "an array for a law": follows(np.zeros((2, 10))),  # type: ignore[arg-type]
    "three columns of preview": follows(LinearLaw(gain=np.zeros((2, 10)), preview_gain=np.zeros((2, 3)))),
    "start takes nothing": fine(start=lambda _self: None),
    "a number for an id": fine(id=3),
    "an id of ours": fine(id="lqr"),
    "a number for a label": fine(label=3),
    "an option called label": named("label", option(1.0)),
    "an option called force": named("force", option(1.0)),
    "an option called _own_values": named("_own_values", option(1.0)),
    "half a step of preview": fine(prediction_horizon=2.5),
    "fewer than no steps of preview": fine(prediction_horizon=-1),
    "a horizon without preview": fine(prediction_horizon=9),
    "preview without a horizon": fine(preview="lookahead"),
    "no such preview": fine(preview="ahead"),
    "preview is set in start": fine(start=lambda self, _: setattr(self, "preview", "wheelbase")),
    "no such speed plan": fine(speed_plan="fast"),
    "a property for a speed plan": fine(speed_plan=property(lambda _: "constant")),
    "an option for delayed": fine(delayed=option(default=False)),
    "dampers without actuators": fine(actuated=False, dampers=lambda _: SemiActiveDampers(least=0, most=1)),
    "no such field": fine(gain=scenario_field("hook.skyhok_damping")),
    "bare": Bare,
    "no force": make_class(Controller, force=Controller.force),
    "no damping": make_class(DampingController),
    "no weights": make_class(PredictiveController),
    "no weights for an ECU": make_class(EcuController),
    "no prediction": predicts(PredictiveController, prediction_horizon=0),
    "no control": predicts(PredictiveController, control_horizon=0),
    "no prediction by an ECU": predicts(EcuController, prediction_horizon=0),
    "a number for a controller": 5,
    "no such strategy": "skyhok",
}


def refused(work: Callable[[], object]) -> list[str | None]:
    """The field and the message of its refusal, or the kind of another error; nothing where there is none."""
    try:
        work()
    except RidelabError as error:
        return [error.field, str(error)]
    except Exception as error:  # noqa: BLE001  # whatever a controller raises
        return [type(error).__name__]
    return []


def movable(sentence: str) -> str:
    """Without what of a place changes with this file and its folder."""
    return re.sub(r"line \d+", "line N", sentence.replace(str(Path(__file__).parent), "FOLDER"))


@pytest.mark.parametrize("fault", FAULTS)
def test_the_check_says_what_is_wrong_and_a_run_refuses_it(fault: str) -> None:
    """With the line of the file where there is one; a run cannot tell what only two of them show."""
    sentences: list[str] = []
    check = refused(lambda: sentences.extend(check_controller(FAULTS[fault], SHORT)))
    run = refused(lambda: simulate(SHORT, FAULTS[fault]))
    wording.check("controllers", fault, {"check": list(map(movable, sentences)) or check, "run": run})


@pytest.mark.parametrize("right", [fine(), fine(preview="wheelbase", prediction_horizon=9), "skyhook"])
def test_what_is_right_is_not_found_fault_with(right: Any) -> None:
    assert check_controller(right, SHORT) == []


def test_a_class_that_is_in_no_file_is_checked_like_others() -> None:
    """As one typed in a notebook or at a prompt is."""
    names: dict[str, Any] = {"__name__": "nowhere", "Controller": Controller}
    exec("class Law(Controller):\n 'Law.'\n id = label = 'law'\n def force(self, seen):\n  return 1 / 0", names)  # noqa: S102
    assert check_controller(names["Law"]) == ["ZeroDivisionError: division by zero"]


class Damps(Controller):
    """Damps the body."""

    id, label = "damps", "Damps"
    damping: float = option(2000.0, ge=0, le=20_000)


def assigned() -> Controller:
    controller = Damps()
    controller.damping = -1.0
    return controller


LV, GAIN = STRATEGIES["lv"], np.zeros((2, 10))
REFUSED: dict[str, Callable[[], object]] = {
    "a gain of four states": lambda: LinearLaw(gain=np.zeros((2, 4))),
    "limits of eleven columns": lambda: LinearLaw(gain=GAIN, limits=np.zeros((3, 11))),
    "limits of other steps": lambda: LinearLaw(gain=GAIN, preview_gain=np.zeros((2, 3)), limits=np.zeros((1, 16))),
    "least damping below zero": lambda: SemiActiveDampers(least=-1.0, most=10.0),
    "least damping above the most": lambda: SemiActiveDampers(least=20.0, most=10.0),
    "damping that is no number": lambda: SemiActiveDampers(least=float("nan"), most=10.0),
    "an option below its range": lambda: Damps(damping=-1.0),
    "an option above its range": lambda: Damps(damping=20_001.0),
    "a word for an option": lambda: Damps(damping="2000"),
    "no such option": lambda: Damps(dampnig=1.0),
    "an option assigned below its range": lambda: simulate(SHORT, assigned()),
    "no such preview of LV": lambda: LV(preview="word"),
    "no prediction of LV": lambda: LV(prediction_horizon=0),
    "a word for LV's weights": lambda: LV(stage_weights="word"),
    "a word for a scenario": lambda: simulate("paper", "passive"),  # type: ignore[arg-type]
    "a table for a scenario": lambda: simulate({}, "passive"),  # type: ignore[arg-type]
    "a class for a scenario": lambda: simulate(sim_core.Scenario, "passive"),  # type: ignore[arg-type]
}


@pytest.mark.parametrize("asked", REFUSED)
def test_laws_options_and_scenarios_that_do_not_fit_are_refused_at_their_field(asked: str) -> None:
    wording.check("controllers", asked, refused(REFUSED[asked]))


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
