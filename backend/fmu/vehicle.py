"""The half-car of a scenario as a model: road heights, braking and forces in, signals out."""

from typing import Any

import numpy as np

from backend.fmu.controller import state
from backend.fmu.model import Model, Variable
from sim_core.scenario import Scenario, Vehicle
from sim_core.vehicle.make import curves, substeps

_FINER = 18  # than the steps of our own runs: what Runge-Kutta leaves out is then below 1e-10
_OUTPUTS = (
    ("body_acceleration", "Body acceleration, up", "m/s2"),
    ("pitch_acceleration", "Pitch acceleration, nose down", "rad/s2"),
    ("tyre_load_front", "Dynamic tyre load front, pressed harder is positive", "N"),
    ("tyre_load_rear", "Dynamic tyre load rear, pressed harder is positive", "N"),
    ("deflection_front", "Suspension deflection front, longer is positive", "m"),
    ("deflection_rear", "Suspension deflection rear, longer is positive", "m"),
    ("actuator_force_front", "Force of the front actuator, behind its command where it lags", "N"),
    ("actuator_force_rear", "Force of the rear actuator, behind its command where it lags", "N"),
    ("pitch_rate", "Pitch rate, nose down", "rad/s"),
)
_INPUTS = (
    ("road_front", "Road height under the front axle at the end of the step", "m"),
    ("road_rear", "Road height under the rear axle at the end of the step", "m"),
    ("force_front", "Command to the front actuator, up on the body", "N"),
    ("force_rear", "Command to the rear actuator, up on the body", "N"),
    ("braking", "Braking deceleration", "m/s2"),
)
_ROAD = (
    "In a communication step the road goes straight from the height that the step before had to the one that is set. "
    "Who sets the heights of the step's end has no delay; who sets those of its beginning, as most tools do, is one "
    "communication step late. 1 ms or less follows a bump well. Commands should be within the actuators' limits."
)
_DAMPERS = (
    "A damper has a curve, so both are constants here: front_damping, rear_damping and rebound_ratio change nothing."
)


def vehicle_model(scenario: Scenario) -> Model:
    """Return the model of the car that the scenario drives, its mismatch and its actuators' lag included."""
    vehicle, actuator = scenario.real_vehicle, scenario.actuator
    inputs = [Variable(name=name, causality="input", description=text, unit=unit) for name, text, unit in _INPUTS]
    outputs = [Variable(name=name, causality="output", description=text, unit=unit) for name, text, unit in _OUTPUTS]
    internal = 1 / (_FINER * substeps(vehicle, actuator, None, 1.0))
    own = [
        _parameter(
            "actuator_bandwidth", "Bandwidth of the actuators; 0 are ideal ones", "Hz", actuator.bandwidth or 0.0
        ),
        _parameter("internal_step", "Longest step of the integration", "s", internal),
    ]
    properties = Vehicle.model_json_schema()["properties"]
    fields = [
        _field(name, getattr(vehicle, name), schema)
        for name, schema in properties.items()
        if not name.endswith("damper_curve")
    ]
    return Model(
        kind="vehicle",
        name="ridelab_vehicle",
        description="Half-car with its suspension, tyres and actuators",
        variables=[*inputs, *state("output"), *outputs, *fields, *own],
        numbers=np.array([*vehicle.lowered, *curves(vehicle)]),
        step=1e-3,
        notes=[_ROAD] if vehicle.damper_curves is None else [_ROAD, _DAMPERS],
    )


def _parameter(name: str, text: str, unit: str, start: float) -> Variable:
    return Variable(name=name, causality="parameter", description=text, unit=unit, start=start, least=0)


def _field(name: str, value: float | None, schema: dict[str, Any]) -> Variable:
    """Return the parameter of a vehicle's field; None is 0."""
    text = f"{schema['title']}: {schema['description']}"
    if schema.get("type") == "boolean":
        return Variable(name=name, causality="parameter", description=text, whole=True, start=float(value or 0), most=1)
    unit = schema.get("unit", "1").replace("·", ".").replace("^", "")
    least = schema.get("minimum", 0)
    return Variable(
        name=name,
        causality="parameter",
        description=text,
        unit=unit,
        start=float(value or 0),
        least=min(least, 0) if value is None else least,
        most=schema.get("maximum"),
    )
