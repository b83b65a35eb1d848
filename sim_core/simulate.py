"""simulate(scenario, strategy): speed plan, road, controller and car step by step, and the metrics of the recording."""

from sim_core.blas import single_threaded
from sim_core.control.controller import Controller
from sim_core.errors import RidelabError
from sim_core.loop.excitation import excite, step_sizes
from sim_core.loop.run import Run, requested_preview
from sim_core.metrics.evaluate import evaluate
from sim_core.result import StrategyResult
from sim_core.scenario import Bump, Road, Scenario
from sim_core.speed.profile import make_speed_profile
from sim_core.speed.stages import segments, spans
from sim_core.strategies import controller_for, speed_plan_on

_DUMMY_ROAD = Road(length=30, bump=Bump(start=20))


@single_threaded
def simulate(scenario: Scenario, strategy: str | type[Controller] | Controller) -> StrategyResult:
    """Drive one strategy over the scenario's road.

    Args:
        scenario: What to drive.
        strategy: The id of one of `STRATEGIES`, a controller's class, or an object of it.

    Raises:
        UnknownNameError: No such strategy.
        TooExpensiveError: Its QPs take more than one run's may.
        RidelabError: The vehicle and weights admit no stabilising controller, or the controller does not give what it
            has to, or an argument is of another type.

    Example:
        >>> from sim_core import Scenario, simulate
        >>> result = simulate(Scenario(), "passive")
        >>> round(result.metrics["bump"]["body_acceleration"]["peak"], 1)  # [m/s^2]
        6.2
        >>> result.series["body_acceleration"].shape == result.series["time"].shape
        True
    """
    return evaluate(prepare(scenario, strategy))


def on_dummy_road(scenario: Scenario) -> Scenario:
    """Return the scenario on a short road, of which a controller depends on nothing but what is copied here.

    A Kalman filter depends on the roughness; every controller on how the axles meet the road.
    """
    read = {name: getattr(scenario.road, name) for name in ("roughness", "rear_axle")}
    return scenario.model_copy(update={"road": _DUMMY_ROAD.model_copy(update=read)})


def prepare(scenario: Scenario, strategy: str | type[Controller] | Controller) -> Run:
    """Return the run that `simulate` drives: its controller, its speed plan, and the road under its axles.

    Raises:
        UnknownNameError: No such strategy.
        RidelabError: An argument is of another type, or the controller asks for no preview that there is.
    """
    if not isinstance(scenario, Scenario):
        raise RidelabError(
            "A scenario is a sim_core.Scenario: Scenario.model_validate makes one of plain values, "
            "sim_core.scenario.presets.preset of a preset's name"
        )
    controller = controller_for(strategy, scenario)
    preview, preview_steps = requested_preview(controller)
    plan = speed_plan_on(type(controller), scenario)
    speed_profile = make_speed_profile(scenario, plan)
    steps, stages = step_sizes(scenario, controller, plan), spans(scenario, plan, speed_profile)
    excitation = excite(scenario.road, scenario.rear_axle_offset, speed_profile, steps.control, steps.fine)
    return Run(
        scenario=scenario,
        controller=controller,
        preview=preview,
        preview_steps=preview_steps,
        plan=plan,
        speed_profile=speed_profile,
        steps=steps,
        excitation=excitation,
        stages=stages,
        segments=segments(stages, excitation.grid.position),
    )
