"""Arrays that the core's C would read or write past, or take for something else: each is refused."""

import weakref
from collections.abc import Callable
from ctypes import ArgumentError
from typing import Any

import numpy as np
import pytest

from sim_core.arrays import FloatArray
from sim_core.kernel import binding, prepared
from sim_core.kernel.library import CStruct
from sim_core.kernel.qp import QpDesign, QpMemory
from tests.unit.qp_design import qp_design
from tests.unit.still_car import still_car
from tests.unit.test_recorder import LAYOUT, recorder


def unaligned(array: FloatArray) -> FloatArray:
    """The same numbers at an address that no double has."""
    moved = np.zeros(array.nbytes + 1, dtype=np.uint8)[1:].view(np.float64).reshape(array.shape)
    moved[...] = array
    assert not moved.flags.aligned
    return moved


def read_only(array: FloatArray) -> FloatArray:
    array = array.copy()
    array.flags.writeable = False
    return array


REFUSED = (ArgumentError, TypeError, ValueError, AttributeError)
MISREAD: dict[str, Callable[[FloatArray], Any]] = {
    "big-endian": lambda array: array.astype(">f8"),
    "single": lambda array: array.astype(np.float32),
    "whole": lambda array: array.astype(np.int64),
    "complex": lambda array: array.astype(np.complex128),
    "unaligned": unaligned,
    "strided": lambda array: np.repeat(array, 2, axis=-1)[..., ::2],
    "turned": lambda array: np.asfortranarray(np.vstack([array, array]))[: len(array)],
    "a line": lambda array: array.reshape(-1),
    "a list": lambda array: array.tolist(),
    "nothing": lambda array: None,
}


@pytest.mark.parametrize("kind", MISREAD)
def test_no_array_is_misread(kind: str) -> None:
    misread = MISREAD[kind](np.eye(3))
    with pytest.raises(REFUSED):
        binding.window_sizes(misread, 1, np.zeros((4, 3)))
    with pytest.raises(REFUSED):
        qp_design(H=MISREAD[kind](np.eye(5)))


def test_nothing_is_written_where_nobody_may() -> None:
    sizes = read_only(np.ones((4, 3)))
    with pytest.raises(ArgumentError, match="writeable"):
        binding.window_sizes(np.eye(3), 1, sizes)
    assert sizes.sum() == 12


def test_what_a_call_is_prepared_with_lives_as_long() -> None:
    cost = np.full((5, 5), 2.0)
    alive = weakref.ref(cost)
    matrices = qp_design(H=cost)
    del cost
    assert alive() is not None
    assert memory(f=np.ones(5), y=np.ones(5)).residual(matrices) == pytest.approx((1 + 2 * 5) / 2)
    del matrices
    assert alive() is None


def memory(**values: FloatArray) -> QpMemory:
    """Of that QP, with these values in it."""
    made = QpMemory(qp_design(), 1.0)
    for name, value in values.items():
        getattr(made, name)[:] = value
    return made


STEPS, FINE = 6, 2


CAR: dict[str, Any] = {
    "steps": STEPS,
    "fine": FINE,
    "effects": None,
    "substeps": 3,
    "recorder": recorder(FINE, STEPS, np.array([[0.0, 4.0]])),
}
DESIGN: dict[str, Any] = {"gain": np.zeros((2, 19)), "limits": np.zeros((14, 19))}
LAW: dict[str, Any] = {
    "disturbances": np.lib.stride_tricks.as_strided(np.zeros(99), (3, STEPS, 3), (8 * (STEPS + 2), 8, 8)),
    "source": np.zeros((3, STEPS + 2)),
    "preview_norms": np.zeros((4, STEPS)),
    "force_limits": np.full(3, np.inf),
    "clips": True,
}
CALLS: dict[str, Any] = {
    "loop": np.zeros((STEPS + 1, 10)),
    "qp": None,
    "first": 0,
    "last": STEPS,
    "step": 0,
    "measured": STEPS - 1,
    "sampled": (0, STEPS),
    "state": np.zeros(8),
    "command": np.zeros(2),
}


def drive(**changed: Any) -> None:
    """A nonlinear car driven by a law, step by step and sampled, but for what is `changed`."""
    design, law, calls = (
        right | {name: changed.pop(name) for name in right if name in changed} for right in (DESIGN, LAW, CALLS)
    )
    car, loop, (first, last) = still_car(**(CAR | changed)), calls["loop"], calls["sampled"]
    follow = car.follow_law(loop, **law)
    follow(prepared.LawDesign(**design), calls["qp"], calls["first"], calls["last"])
    car.advance(calls["step"], loop)
    car.measure(calls["measured"], calls["state"], calls["command"])
    car.sample(first, last, loop)


MISUSES: dict[str, dict[str, Any]] = {
    "gain for half a state": {"gain": np.zeros((2, 4))},
    "gain of one axle": {"gain": np.zeros((1, 19))},
    "gain on one kind of preview": {"gain": np.zeros((2, 13))},
    "limits on the state alone": {"limits": np.zeros((14, 10))},
    "limits on two kinds of preview": {"gain": np.zeros((2, 12)), "limits": np.zeros((14, 12))},
    "a preview that ends before the drive": {"source": np.zeros((3, STEPS + 1))},
    "a preview from behind": {"disturbances": LAW["disturbances"][:, ::-1]},
    "a preview of fewer steps": {"disturbances": LAW["disturbances"][:, 1:]},
    "norms in fewer steps": {"preview_norms": np.zeros((4, STEPS - 1))},
    "a single step beyond the drive": {"step": STEPS},
    "a measurement of another car": {"state": np.zeros(10)},
    "a measurement of one force": {"command": np.zeros(1)},
    "no row after the last step": {"loop": np.zeros((STEPS, 10))},
    "a loop without commands": {"loop": np.zeros((STEPS + 1, 8))},
    "a first step before the drive": {"first": -1},
    "backwards": {"first": 1, "last": 0},
    "far beyond the drive": {"first": 2**31 - 1},
    "more steps than the drive": {"last": STEPS + 1, "loop": np.zeros((STEPS + 2, 10))},
    "a car of too few numbers": {"vehicle": np.ones(prepared.CAR - 1)},
    "a state of nine": {"states": 9},
    "an estimator that knows nothing": {"estimator": np.zeros(112)},
    "half an estimator": {"estimator": np.zeros(100), "estimator_input": np.zeros((STEPS, 8))},
    "a recorder of a shorter drive": {"recorder": recorder(FINE, STEPS - 1, np.array([[0.0, 4.0]]))},
    "a recorder of finer steps": {"recorder": recorder(2 * FINE, STEPS // 2, np.array([[0.0, 4.0]]))},
    "a road under one axle": {"height": np.zeros((1, STEPS * FINE + 1))},
    "heights of half the road": {"height": np.zeros((2, STEPS * FINE))},
    "braking in each control step": {"braking": np.zeros(STEPS)},
    "a linear step of the state alone": {"effects": np.zeros((10, 10))},
    "no fine step": {"fine": 0},
    "a step that takes no time": {"fine_step": 0.0},
    "a measurement beyond the drive": {"measured": STEPS},
    "a measurement before the drive": {"measured": -1},
    "samples beyond the drive": {"sampled": (1, STEPS + 1)},
    "samples before the drive": {"sampled": (-1, STEPS)},
    "samples backwards": {"sampled": (2, 1)},
    "no substep": {"substeps": 0},
    "a law of another drive": {"steps": STEPS - 1, "recorder": None},
    "another law's qp": {
        "qp": (
            qp_design(linear_term_gain=np.zeros((7, 13)), unconstrained_gain=np.zeros((7, 13))),
            QpMemory(qp_design(), 1.0),
        )
    },
}


@pytest.mark.parametrize("misuse", MISUSES)
def test_no_drive_is_let_beyond_its_arrays(misuse: str) -> None:
    """In this process, where `make mutate` sees which lines it reaches; without its check C may end it."""
    with pytest.raises(REFUSED):
        drive(**MISUSES[misuse])


ENDS = np.array([[0.0, 2.5], [2.5, 6.0]])
ROAD = np.zeros(50), binding.road_layout(-1.0, 0.1, "cosine", (1, 2.0, 0.1, 0.5, 3.0, 2.5))
DISAGREEING: dict[str, Callable[[], object]] = {
    "sizes, one axle": lambda: binding.window_sizes(np.zeros((2, 5)), 2, np.zeros((4, 4))),
    "sizes, no window": lambda: binding.window_sizes(np.zeros((3, 5)), 6, np.zeros((4, 0))),
    "sizes, windows": lambda: binding.window_sizes(np.zeros((3, 5)), 2, np.zeros((4, 5))),
    "fuzzy, a rule's width": lambda: fuzzy(rules=np.zeros((25, 2), dtype=np.intc)),
    "fuzzy, no such distance": lambda: fuzzy(distances=np.zeros((8, 4)), rules=np.array([[4, 0, 0]], dtype=np.intc)),
    "fuzzy, no such error": lambda: fuzzy(errors=np.zeros((7, 4)), rules=np.array([[0, 4, 0]], dtype=np.intc)),
    "fuzzy, no such torque": lambda: fuzzy(rules=np.array([[0, 0, 5]], dtype=np.intc)),
    "fuzzy, no torque": lambda: fuzzy(rules=np.array([[0, 0, -1]], dtype=np.intc)),
    "fuzzy, too many torques": lambda: fuzzy(torques=np.zeros((21, 9))),
    "fuzzy, too many errors": lambda: fuzzy(errors=np.zeros((7, 21))),
    "fuzzy, torques": lambda: fuzzy(torques=np.zeros((5, 1))),
    "fuzzy, one distance": lambda: fuzzy(distances=np.zeros((1, 5))),
    "fuzzy, no distance": lambda: fuzzy(distance_end=0.0),
    "roughness, none": lambda: binding.roughness(np.zeros(0), 1.0, 0.5, 0.1),
    "bumps, shape": lambda: binding.road_layout(-1.0, 0.1, "hexagon", (1, 0.0, 0.1, 0.5, 3.0, 2.5)),
    "road, heights": lambda: binding.road_heights(*ROAD, np.zeros(4), np.zeros(3)),
    "road, one sample": lambda: binding.road_heights(np.zeros(1), ROAD[1], np.zeros(4), np.zeros(4)),
    "recorder, one sample of a road": lambda: recorder(2, 4, ENDS, road=(np.zeros(1), LAYOUT)),
    "recorder, heights": lambda: recorder(2, 4, ENDS, height=np.zeros((2, 8))),
    "recorder, another drive": lambda: recorder(2, 4, ENDS, position=np.zeros((2, 8)), height=np.zeros((2, 8))),
    "recorder, endless": lambda: recorder(2, 4, ENDS, kinks=np.array([1.0, 2.0])),
    "recorder, nowhere": lambda: recorder(2, 4, ENDS, position=np.full((2, 9), np.inf)),
    "recorder, one tyre": lambda: recorder(2, 4, ENDS, tyres=np.zeros((3, 1))),
    "recorder, no step": lambda: recorder(2, 4, ENDS, first=4),
    "recorder, no fine step": lambda: recorder(0, 4, ENDS),
    "recorder, rises": lambda: recorder(2, 4, ENDS, max_chord_deviation=np.zeros(1)),
    "recorder, backwards": lambda: recorder(2, 4, ENDS[::-1].copy()),
    "recorder, before the record": lambda: recorder(2, 4, ENDS - 1.0),
    "recorder, beyond the record": lambda: recorder(2, 4, ENDS + 1.5),
    "recorder, not a number": lambda: recorder(2, 4, np.full((1, 2), np.nan)),
    "recorder, too many samples": lambda: recorder(2, 4, ENDS, weighted_samples=8),
    "recorder, a step before it": lambda: recorder(2, 4, ENDS).record(0),
    "recorder, a step beyond it": lambda: recorder(2, 4, ENDS).record(4),
    "qp, a column less": lambda: qp_design(columns=np.zeros((4, 8))),
    "qp, one limit of a deflection": lambda: qp_design(columns=np.zeros((5, 7))),
    "qp, slacks alone": lambda: qp_design(columns=np.zeros((2, 8)), H=np.eye(2), low=np.zeros(2), high=np.zeros(2)),
    "qp, too many moves": lambda: qp_design(columns=np.zeros((203, 8)), H=np.eye(203)),
    "qp, half a box": lambda: qp_design(low=np.zeros(4)),
    "qp, no slacks in the box": lambda: qp_design(high=np.zeros(3)),
    "qp, inputs": lambda: qp_design(unconstrained_gain=np.zeros((7, 18))),
    "qp, fewer values": lambda: qp_design(linear_term_gain=np.zeros((6, 19)), unconstrained_gain=np.zeros((6, 19))),
    "qp, bounds": lambda: qp_design(bounds=np.zeros(6)),
    "qp, axles": lambda: qp_design(axles=np.zeros(6, dtype=np.int8)),
    "qp, a third axle": lambda: qp_design(axles=np.full(7, 2, dtype=np.int8)),
    "qp, gram": lambda: qp_design(gram=np.zeros((7, 6))),
    "qp, another's memory": lambda: memory().residual(longer_qp()),
    "qp, other inputs": lambda: memory().solve_in_c(qp_design(), np.zeros(18)),
    "qp, other inputs to be posed": lambda: memory().pose(qp_design(), np.zeros(20)),
}


def longer_qp() -> QpDesign:
    """With a fifth deflection."""
    by_value = {"bounds": np.ones(8), "axles": np.full(8, -1, dtype=np.int8), "gram": np.zeros((8, 8))}
    tables = {"linear_term_gain": np.zeros((8, 19)), "unconstrained_gain": np.zeros((8, 19))}
    return qp_design(columns=np.zeros((5, 10)), **tables, **by_value)


def fuzzy(**changed: Any) -> CStruct:
    right: dict[str, Any] = {
        "errors": np.zeros((7, 5)),
        "error_end": 30.0,
        "distances": np.zeros((8, 5)),
        "distance_end": 80.0,
        "rules": np.zeros((25, 3), dtype=np.intc),
        "torques": np.zeros((5, 9)),
        "interpolates": True,
    }
    return binding.fuzzy_rules(**(right | changed))


@pytest.mark.parametrize("misuse", DISAGREEING)
def test_arrays_fit_each_other(misuse: str) -> None:
    with pytest.raises(ValueError, match=r"\w"):
        DISAGREEING[misuse]()


def test_what_fits_is_taken() -> None:
    """The right arguments of the misuses above."""
    assert binding.torque_share(fuzzy(), 30.0, 80.0) == 0
    drive()
    recorder(2, 4, ENDS).record(3)
    binding.window_sizes(np.zeros((3, 5)), 2, np.zeros((4, 4)))
    drive(qp=(qp_design(), memory()))
    assert still_car(steps=6).sample(2, 2, np.zeros((7, 10))).shape[1] == 0  # of no step
    memory().pose(qp_design(), np.zeros(19))
    assert memory().solve_in_c(qp_design(), np.zeros(19)) is not None
    assert QpMemory(longer_qp(), 1.0).residual(longer_qp()) == 0
