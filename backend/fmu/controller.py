"""A scenario's suspension controller as a model: the ECU's program, or a linear law with its greatest force."""

import numpy as np

from backend.fmu.model import Model, Variable, array
from sim_core import Controller, EcuController, FloatArray, RidelabError, Scenario, Setup
from sim_core.control.cost import KILO
from sim_core.control.law import LAW_INPUTS, LinearLaw
from sim_core.ecu.calibration import Calibration
from sim_core.ecu.channels import PREVIEW, SENSORS, highest_code
from sim_core.simulate import on_dummy_road, prepare
from sim_core.strategies import strategy_named
from sim_core.strategies.lv import Lv
from sim_core.strategies.lv_hil import LvHil

_STATE = (
    ("Suspension deflection front, longer is positive", "m"),
    ("Suspension deflection rear, longer is positive", "m"),
    ("Tyre deflection front, wheel minus road", "m"),
    ("Tyre deflection rear, wheel minus road", "m"),
    ("Body velocity, up", "m/s"),
    ("Pitch rate, nose down", "rad/s"),
    ("Wheel velocity front, up", "m/s"),
    ("Wheel velocity rear, up", "m/s"),
)
_GAIN_UNITS = {"m": "N/m", "m/s": "N.s/m", "rad/s": "N.s/rad"}
_ORDER = (
    "A communication step gives the command that follows from the inputs at its beginning. Whoever steps vehicle and "
    "controller side by side applies it one communication step later; to apply it at once, step the controller first."
)
_ECU = (
    "Its program expects that a command takes effect one control step after the inputs were measured, and predicts the "
    "state for that moment where hil.compensation is predict. Noise, jitter and losses of the scenario are not inside."
)


def state(causality: str) -> list[Variable]:
    """Return the half-car's state, `state[1]` to `state[8]`."""
    texts, units = zip(*_STATE, strict=True)
    return list(array("state", "output" if causality == "output" else "input", texts, units))


def preview(steps: int) -> list[Variable]:
    """Return road heights now and at the end of each coming control step, and the braking in each."""
    if not steps:
        return []
    ends = [f"at the end of control step {i + 1} from now" for i in range(steps)]
    axles = ("front", "rear")
    now = [
        Variable(name=f"road_{axle}", causality="input", description=f"Road height under the {axle} axle now", unit="m")
        for axle in axles
    ]
    heights = [
        each
        for axle in axles
        for each in array(
            f"preview_{axle}", "input", [f"Road height under the {axle} axle {end}" for end in ends], ["m"] * steps
        )
    ]
    braking = array(
        "braking",
        "input",
        [f"Braking deceleration in control step {i + 1} from now" for i in range(steps)],
        ["m/s2"] * steps,
    )
    return [*now, *heights, *braking]


def forces() -> list[Variable]:
    """Return the commands, front and rear."""
    return [
        Variable(
            name=f"force_{axle}", causality="output", description=f"Actuator force {axle}, up on the body", unit="N"
        )
        for axle in ("front", "rear")
    ]


def period(sample_time: float) -> Variable:
    """Return the constant that says how often the command changes."""
    text = "Control step: the command changes so often, whatever the communication step is"
    return Variable(name="sample_time", causality="constant", description=text, unit="s", start=sample_time)


def controller_model(scenario: Scenario, strategy: str) -> Model:
    """Return the model of a strategy's suspension controller; of `lv` that of `lv_hil`, its MPC as an ECU's program.

    Raises:
        UnknownNameError: No such strategy.
        RidelabError: It has none that an FMU can hold, or the vehicle and weights admit none.
    """
    named = LvHil if strategy == Lv.id else strategy_named(strategy)
    run = prepare(on_dummy_road(scenario), named)
    setup = run.setup()
    if isinstance(run.controller, EcuController):
        return _program_model(run.controller, setup)
    run.controller.start(setup)
    try:
        return _law_model(run.controller, setup)
    finally:
        run.controller.end()


def _program_model(controller: EcuController, setup: Setup) -> Model:
    """Return the model of the ECU's program, float32, behind its converters.

    Raises:
        RidelabError: There is no stabilising controller.
    """
    calibration = controller.calibration(setup)
    iterations = Variable(
        name="iterations", causality="parameter", description="The solver stops after so many", whole=True,
        start=calibration.iterations, least=0,
    )  # fmt: skip
    return Model(
        kind="ecu",
        name=f"ridelab_{controller.id}",
        description=f"{controller.label}: {controller.description()}",
        variables=[_stage(), *state("input"), *preview(setup.preview_steps), *forces(), iterations,
                   period(setup.sample_time)],
        numbers=_ecu_numbers(calibration, setup),
        step=setup.sample_time,
        notes=[_ORDER, _ECU],
    )  # fmt: skip


def _ecu_numbers(calibration: Calibration, setup: Setup) -> FloatArray:
    """Return what source/program.c takes; the tables in single precision."""
    sizes = calibration.intervals, calibration.row_count, calibration.most_active
    whole = *sizes, calibration.predicts, highest_code(calibration.bits)
    single = [calibration.command_step, calibration.slack_price, calibration.inverse_slack_weight]
    rounded = np.concatenate([single, *map(np.ravel, calibration.arrays.values())]).astype(np.float32)
    full_scale = [channel.full_scale for channel in (*SENSORS, *PREVIEW)]
    own = [setup.preview_steps, setup.sample_time, calibration.command_step * KILO, *full_scale]
    return np.concatenate([own, whole, calibration.axles, rounded])


def _stage() -> Variable:
    text = "Driving stage when the command takes effect: 0 cruise, 1 brake, 2 bump"
    return Variable(name="stage", causality="input", description=text, whole=True, least=0, most=2)


def _law_model(controller: Controller, setup: Setup) -> Model:
    """Return the model of a linear controller.

    Raises:
        RidelabError: It is none, or something else decides where a limit binds.
    """
    by_stage = [controller.linear_law(stage) for stage in setup.stages]
    different = list(dict.fromkeys(by_stage))
    laws = [law for law in (different if len(different) == 1 else by_stage) if law is not None]
    reason = None
    if len(laws) < len(different) or controller.delayed:
        reason = "its forces follow no linear law; a controller of one's own needs linear_law for that"
    elif controller.dampers() is not None:
        reason = "it sets the coefficients of semi-active dampers, not forces"
    elif any(law.limits is not None for law in laws):
        reason = "a QP decides where one of its limits binds (of lv the ECU's program is exported)"
    elif type(controller).force is not Controller.force:
        reason = "its own force decides beyond the force limit; leave force out, and its law is clipped to the limit"
    if reason is not None:
        raise RidelabError(f"{controller.label} cannot be exported as an FMU: {reason}", field="strategy")
    prefixes = [""] if len(laws) == 1 else [f"{stage}_" for stage in setup.stages]
    steps = setup.preview_steps if any(law.preview_gain is not None for law in laws) else 0
    limit = Variable(
        name="force_limit", causality="parameter", description="Greatest magnitude of each force", unit="N",
        start=setup.force_limit, least=0,
    )  # fmt: skip
    gains = [each for law, prefix in zip(laws, prefixes, strict=True) for each in _gains(law, prefix)]
    return Model(
        kind="law",
        name=f"ridelab_{controller.id}",
        description=f"{controller.label}: {controller.description()}",
        variables=[*([_stage()] if len(laws) > 1 else []), *state("input"), *preview(steps), *forces(), limit, *gains,
                   period(setup.sample_time)],
        numbers=np.concatenate([[len(laws), steps, setup.sample_time], *(_preview_gain(law, steps) for law in laws)]),
        step=setup.sample_time,
        notes=[_ORDER],
    )  # fmt: skip


def _gains(law: LinearLaw, prefix: str) -> list[Variable]:
    on = [(f"on {text[0].lower()}{text[1:]}", _GAIN_UNITS[unit]) for text, unit in _STATE]
    on += [("on the previous force front", "1"), ("on the previous force rear", "1")]
    return [
        each
        for axle, row in zip(("front", "rear"), law.gain, strict=True)
        for each in array(
            f"{prefix}gain_{axle}", "parameter", [f"Gain of the {axle} force {what}" for what, _ in on],
            [unit for _, unit in on], row.tolist(),
        )
    ]  # fmt: skip


def _preview_gain(law: LinearLaw, steps: int) -> FloatArray:
    """Return what both forces take of the previewed roads' velocities, front and rear, and of the braking."""
    return np.zeros(6 * steps) if law.preview_gain is None else law.preview_gain.ravel()


assert len(_STATE) + 2 == LAW_INPUTS  # noqa: S101 - two lists of one state
