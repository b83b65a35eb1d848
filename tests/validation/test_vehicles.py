"""Vehicles against their sources and against the textbook; a data sheet against the modes of what it makes."""

import numpy as np
import pytest
from pydantic import ValidationError

from sim_core import Scenario, Vehicle, characteristics, simulate
from sim_core.scenario.data_sheet import DataSheet
from sim_core.scenario.vehicle import GRAVITY
from sim_core.scenario.vehicles import VEHICLES
from sim_core.vehicle.half_car import half_car
from tests import wording

POUND, FOOT = 4.4482216152605, 0.3048  # [N, m]

# The three cars a second time, in the units they were measured in: parameters_vehicle1 to 3.py of CommonRoad's vehicle
# models. Sprung mass, pitch inertia, an axle's mass [slug, slug ft²], a, b, height [ft], springs [lb/ft], dampers
# [lb s/ft], tyre [lb/ft].
MEASURED = {
    "small_car": (75, 990, 4.5, 2.9, 4.95, 1.95, 1500, 1500, 100, 100, 13_000),
    "sedan": (66.17221, 1154.888, 4.371153, 3.793293, 4.667707, 2.01355, 1675, 1345, 122.3966, 112.9981, 10_842.89),
    "van": (90.21635, 1625.825, 5.56015, 3.775563, 4.334437, 2.639405, 2300, 2680, 164.8335, 189.7866, 14_565.6),
}


@pytest.mark.parametrize("name", MEASURED)
def test_measured_cars_are_half_of_what_was_measured(name: str) -> None:
    """To 0.1 %: the printed table has four digits, and its springs were converted with g = 9.81 m/s²."""
    mass, inertia, axle, to_front, to_rear, height, *per_wheel = MEASURED[name]
    slug, per_foot = POUND / FOOT, POUND / FOOT
    car = VEHICLES[name].vehicle
    assert car.body_mass == pytest.approx(mass * slug / 2, rel=1e-3)
    assert car.pitch_inertia == pytest.approx(inertia * slug * FOOT**2 / 2, rel=1e-3)
    assert (car.front_wheel_mass, car.rear_wheel_mass) == pytest.approx((axle * slug / 2,) * 2, rel=1e-3)
    assert (car.cg_to_front, car.cg_to_rear, car.cg_height) == pytest.approx(
        (to_front * FOOT, to_rear * FOOT, height * FOOT), rel=2e-3
    )
    springs_dampers_tyre = (
        car.front_spring,
        car.rear_spring,
        car.front_damping,
        car.rear_damping,
        car.front_tyre_stiffness,
    )
    assert springs_dampers_tyre == pytest.approx([value * per_foot for value in per_wheel], rel=1e-3)
    assert car.rear_tyre_stiffness == car.front_tyre_stiffness


def test_the_suvs_springs_carry_what_their_preload_says() -> None:
    """Chrono's preloads, 4527 N in front and 3629 N behind, are the body's weight on each spring."""
    car = VEHICLES["suv"].vehicle
    weight = car.body_mass * 9.81 / car.wheelbase
    assert (weight * car.cg_to_rear, weight * car.cg_to_front) == pytest.approx((4527, 3629), rel=1e-3)
    assert 2 * car.total_mass == pytest.approx(1663 + 209.84 + 160.36, abs=0.1)
    assert car.rear_tyre_stiffness == car.front_tyre_stiffness


def test_the_loaded_van_is_the_empty_one_with_a_load_2_m_long_between_its_axles() -> None:
    empty, full, load = VEHICLES["van"].vehicle, VEHICLES["van_loaded"].vehicle, 887 / 2
    mass, middle = empty.body_mass + load, empty.wheelbase / 2
    to_front = (empty.body_mass * empty.cg_to_front + load * middle) / mass
    own = empty.pitch_inertia + empty.body_mass * (empty.cg_to_front - to_front) ** 2
    inertia = own + load * (middle - to_front) ** 2 + load * 2**2 / 12
    changes = {"body_mass": mass, "pitch_inertia": inertia, "cg_to_front": to_front}
    changes["cg_to_rear"] = empty.wheelbase - to_front
    assert full == empty.model_copy(update={name: float(f"{value:.5g}") for name, value in changes.items()})


@pytest.mark.parametrize("name", VEHICLES)
def test_every_vehicle_says_where_it_is_from_and_drives(name: str) -> None:
    preset = VEHICLES[name]
    assert preset.sources
    assert preset.derived
    for strategy in ("lv", "lqr", "passive"):
        result = simulate(Scenario(vehicle=preset.vehicle), strategy)
        assert result.events["qp_failures"] == 0
        assert 0 < result.metrics["whole"]["body_acceleration"]["rms"] < 5


SHEET = DataSheet(
    front_axle_load=760,
    rear_axle_load=640,
    front_axle_mass=70,
    rear_axle_mass=60,
    wheelbase=2.6,
    front_frequency=1.2,
    rear_frequency=1.4,
    front_damping_ratio=0.25,
    rear_damping_ratio=0.3,
    front_tyre_stiffness=200_000,
    rear_tyre_stiffness=210_000,
)


@pytest.mark.parametrize("wheels", [{}, {"front_axle_mass": 10.0, "rear_axle_mass": 10.0}])
@pytest.mark.parametrize(("ratio", "off"), [(0.1, 0.002), (0.2, 0.008), (0.3, 0.02), (0.4, 0.035)])
def test_a_half_car_has_the_frequencies_and_the_damping_of_its_data_sheet(
    wheels: dict[str, float], ratio: float, off: float
) -> None:
    """With the dynamic index 1 the axles move independently, so the two slow modes are the sheet's.

    The ratios are those of light damping: what docs/explanation/half-car.md says they are off by.
    """
    dampers = {"front_damping_ratio": ratio, "rear_damping_ratio": ratio}
    car = SHEET.model_copy(update={**wheels, **dampers}).half_car()
    assert car.pitch_inertia == pytest.approx(car.body_mass * car.cg_to_front * car.cg_to_rear, rel=1e-4)
    undamped = car.model_copy(update={"front_damping": 1e-9, "rear_damping": 1e-9})
    np.testing.assert_allclose(np.abs(slow_modes(undamped)) / (2 * np.pi), [1.2, 1.4], rtol=1e-3)
    modes = slow_modes(car)
    np.testing.assert_allclose(-modes.real / np.abs(modes), [ratio, ratio], rtol=off)


def slow_modes(car: Vehicle) -> np.ndarray:
    """The body's two complex modes [rad/s], the slower first."""
    values = np.linalg.eigvals(half_car(car).A)
    return np.array(sorted((value for value in values if 0 < value.imag < 20), key=abs))


def test_a_data_sheet_keeps_masses_and_axle_loads() -> None:
    car = SHEET.half_car()
    assert 2 * car.total_mass == pytest.approx(1400)
    assert np.array(car.static_loads) * 2 / 9.80665 == pytest.approx([760, 640], rel=1e-4)
    assert SHEET.model_copy(update={"pitch_inertia": 1500.0}).half_car().pitch_inertia == 750


@pytest.mark.parametrize("change", wording.asked_in("data_sheets"), ids=str)
def test_what_no_car_has_names_the_field_of_the_sheet(change: dict[str, float]) -> None:
    with pytest.raises(ValidationError) as refused:
        DataSheet.model_validate({**SHEET.model_dump(), **change})
    wording.check("data_sheets", change, wording.errors_in(refused.value))


def test_characteristics_are_what_a_data_sheet_asks_for() -> None:
    """The reverse of `DataSheet.half_car`; a wheel's are those of a quarter-car whose body stands still.

    To 1e-4: a half-car made from a sheet has five digits.
    """
    car = SHEET.half_car()
    of_car = characteristics(car)
    for axle in ("front", "rear"):
        share = (getattr(SHEET, f"{axle}_axle_load") - getattr(SHEET, f"{axle}_axle_mass")) / 2
        spring, damper, tyre = (getattr(car, f"{axle}_{name}") for name in ("spring", "damping", "tyre_stiffness"))
        assert getattr(of_car.natural_frequencies, f"{axle}_body") == pytest.approx(
            getattr(SHEET, f"{axle}_frequency"), rel=1e-4
        )
        assert getattr(of_car.damping_ratios, f"{axle}_body") == pytest.approx(
            getattr(SHEET, f"{axle}_damping_ratio"), rel=1e-4
        )
        assert getattr(of_car.static_sag, axle) * spring == pytest.approx(share * GRAVITY, rel=1e-4)
        mass = getattr(car, f"{axle}_wheel_mass")
        pole = np.linalg.eigvals([[0, 1], [-(spring + tyre) / mass, -damper / mass]])[0]
        assert getattr(of_car.natural_frequencies, f"{axle}_wheel") == pytest.approx(abs(pole) / (2 * np.pi))
        assert getattr(of_car.damping_ratios, f"{axle}_wheel") == pytest.approx(-pole.real / abs(pole))
