"""Vehicles with their sources: half-cars of one track, made from published data of whole cars.

A whole car's masses and inertia are halved, springs, dampers and tyres are one wheel's, as in the preset
`half_car_consistent`. Numbers are the sources', derived ones to five digits.
"""

from dataclasses import dataclass
from math import hypot

from sim_core.scenario.vehicle import Vehicle

Pair = tuple[float, float]
_ALLEN = (
    "M. Althoff, CommonRoad: Vehicle Models, version 2019b, table of the multi-body model's vehicle parameters "
    "(github.com/dawsonc/commonroad-vehicle-models, documentation/vehicleModels_commonRoad.tex)",
    "Its source is R. W. Allen et al., Vehicle Dynamic Stability and Rollover, DOT HS 807 956, 1992, table E-5",
)
_CHRONO = (
    "Project Chrono, model Jeep Cherokee 1997 (github.com/projectchrono/chrono, src/chrono_models/vehicle/jeep: "
    "Cherokee_Chassis, _SolidAxleFront, _SolidAxleRear, _Wheel, _TMeasyTire and _Vehicle.cpp)",
    "Its source is M. K. Salaani et al., Vehicle dynamics modeling for the National Advanced Driving Simulator of a "
    "1997 Jeep Cherokee, SAE 1999-01-0121; its tyre is Chrono's estimate",
)
_HALVED = "Masses and inertia are half the whole car's, an axle's mass half its two wheels'"


@dataclass(frozen=True, slots=True, kw_only=True)
class VehiclePreset:
    """A vehicle with a name, where its numbers are from, and how those follow that no source has."""

    id: str
    label: str
    description: str
    vehicle: Vehicle
    sources: tuple[str, ...]
    derived: tuple[str, ...] = (_HALVED,)


def one_track(
    *,
    body_mass: float,
    pitch_inertia: float,
    cg_height: float,
    cg_to_axles: Pair,
    axle_masses: Pair,
    springs: Pair,
    damping: Pair,
    tyres: Pair,
    rebound_ratio: float = 1,
) -> Vehicle:
    """Half of a whole car: its left or right track. Pairs are of the front and of the rear axle.

    Args:
        body_mass: Sprung mass of the whole car [kg].
        pitch_inertia: Of the whole body about its pitch axis [kg m^2].
        cg_height: Of the body's centre of gravity above the road [m].
        cg_to_axles: From the centre of gravity to both axles [m].
        axle_masses: Unsprung masses, of both wheels [kg].
        springs: Of one wheel [N/m].
        damping: Of one wheel [N s/m].
        tyres: Stiffness of one [N/m].
        rebound_ratio: Damping in rebound over that in compression.
    """
    half = {"body_mass": body_mass / 2, "pitch_inertia": pitch_inertia / 2}
    values = {**half, "cg_height": cg_height, "rebound_ratio": rebound_ratio}
    for name, (front, rear) in {
        "cg_to_{}": cg_to_axles,
        "{}_wheel_mass": (axle_masses[0] / 2, axle_masses[1] / 2),
        "{}_spring": springs,
        "{}_damping": damping,
        "{}_tyre_stiffness": tyres,
    }.items():
        values |= {name.format("front"): front, name.format("rear"): rear}
    return Vehicle.model_validate({name: _rounded(value) for name, value in values.items()})


def loaded(vehicle: Vehicle, mass: float, behind_front_axle: float, length: float) -> Vehicle:
    """The vehicle with a load that is spread evenly along its body, at the height of the body's centre of gravity.

    Centre of gravity and pitch inertia are those of both bodies together (parallel axis theorem).

    Args:
        vehicle: Without it.
        mass: Of the load [kg].
        behind_front_axle: Where its middle is [m].
        length: Over which it is spread [m].
    """
    total = vehicle.body_mass + mass
    to_front = (vehicle.body_mass * vehicle.cg_to_front + mass * behind_front_axle) / total
    distance = behind_front_axle - vehicle.cg_to_front
    inertia = vehicle.pitch_inertia + vehicle.body_mass * mass / total * distance**2 + mass * length**2 / 12
    changes = {
        "body_mass": total,
        "pitch_inertia": inertia,
        "cg_to_front": to_front,
        "cg_to_rear": vehicle.wheelbase - to_front,
    }
    return vehicle.model_copy(update={name: _rounded(value) for name, value in changes.items()})


def _rounded(value: float) -> float:
    return float(f"{value:.5g}")


def _shock(compression: float, rebound: float, lower: tuple[float, ...], upper: tuple[float, ...]) -> float:
    """Mean damping at the wheel [N s/m] of one of Chrono's shock absorbers over v = 0.3 m/s.

    Its forces are c v/(1 + 3 v) in compression and c v/(1 + v) in rebound; the squared cosine of its lean (lower and
    upper end [m]) brings them to the wheel.
    """
    mean = (compression / (1 + 3 * _SHOCK_SPEED) + rebound / (1 + _SHOCK_SPEED)) / 2
    rise = upper[2] - lower[2]
    length = hypot(*(high - low for low, high in zip(lower, upper, strict=True)))
    return float(mean * (rise / length) ** 2)


_SHOCK_SPEED = 0.3  # at which a degressive damper is made linear [m/s]
_VAN = one_track(
    body_mass=1316,
    pitch_inertia=2204,
    cg_height=0.804,
    cg_to_axles=(1.150, 1.321),
    axle_masses=(81.14, 81.14),
    springs=(33_570, 39_120),
    damping=(2405, 2769),
    tyres=(212_600, 212_600),
)
_SPIN = 2 * (20.0 + 11.38 + 13.78)  # both spindles, wheels and tyres of the Cherokee's axle [kg]

VEHICLES: dict[str, VehiclePreset] = {
    preset.id: preset
    for preset in (
        VehiclePreset(
            id="small_car",
            label="Small car",
            description="Ford Escort of the 1980s, 1225 kg as measured.",
            vehicle=one_track(
                body_mass=1094,
                pitch_inertia=1342,
                cg_height=0.594,
                cg_to_axles=(0.883, 1.508),
                axle_masses=(65.67, 65.67),
                springs=(21_890, 21_890),
                damping=(1459, 1459),
                tyres=(189_700, 189_700),
            ),
            sources=_ALLEN,
        ),
        VehiclePreset(
            id="sedan",
            label="Sedan",
            description="BMW 320i of the early 1980s, 1093 kg as measured.",
            vehicle=one_track(
                body_mass=965,
                pitch_inertia=1565,
                cg_height=0.613,
                cg_to_axles=(1.156, 1.422),
                axle_masses=(63.79, 63.79),
                springs=(24_450, 19_630),
                damping=(1786, 1649),
                tyres=(158_200, 158_200),
            ),
            sources=_ALLEN,
        ),
        VehiclePreset(
            id="suv",
            label="SUV",
            description="Jeep Cherokee of 1997, 2034 kg as modelled, with solid axles.",
            vehicle=one_track(
                body_mass=1663,
                pitch_inertia=2498,
                cg_height=0.213 + 15 * 0.0254 / 2 + 0.225 * 0.75,
                cg_to_axles=(1.147, 2.578 - 1.147),
                axle_masses=(96.797 + 2 * 10.0 + 2.7216 + _SPIN, 70.035 + _SPIN),
                springs=(25_000, 25_000),
                damping=(
                    _shock(4528.05, 9704.56, (-0.087376, 0.45212, 0.029972), (-0.1143, 0.58801, 0.464312)),
                    _shock(3821.14, 8189.49, (-0.09906, 0.507238, -0.093218), (-0.0889, 0.29337, 0.280162)),
                ),
                tyres=(850 * 9.81 / (0.16 * 0.225 * 0.75), 850 * 9.81 / (0.16 * 0.225 * 0.75)),
                rebound_ratio=9704.56 / (1 + _SHOCK_SPEED) / (4528.05 / (1 + 3 * _SHOCK_SPEED)),
            ),
            sources=_CHRONO,
            derived=(
                _HALVED,
                "An axle's mass is that of its tube, spindles, wheels and tyres, in front with knuckles and tie rod",
                "Damping is the mean of compression and rebound at 0.3 m/s, at the lean of the shock absorber; the "
                "rebound ratio is that of both there",
                "Tyre stiffness is the load of index 102 over 16 % of the section's height, as Chrono estimates it",
                "The body's centre of gravity is 0.213 m above the wheels' centres, which are an unloaded radius high",
            ),
        ),
        VehiclePreset(
            id="van",
            label="Van, empty",
            description="VW Vanagon of the 1980s, 1478 kg as measured.",
            vehicle=_VAN,
            sources=_ALLEN,
        ),
        VehiclePreset(
            id="van_loaded",
            label="Van, loaded",
            description="The same van with 887 kg on board: 2365 kg, as the panel van with its full load.",
            vehicle=loaded(_VAN, 887 / 2, _VAN.wheelbase / 2, 2.0),
            sources=(
                *_ALLEN,
                "Kerb weight 1365 kg and load 1000 kg: kfz-tech.de, VW Bus/Transporter 4 (Typ 2 T3)",
                "Half the weight on each axle, empty or loaded: pick-up-trucks.de, VW T3 Pick-up",
            ),
            derived=(
                _HALVED,
                "The load's middle is half-way between the axles; that it is 2 m long and as high as the body's centre "
                "of gravity is ours",
                "Centre of gravity and pitch inertia of body and load together by the parallel axis theorem",
            ),
        ),
    )
}
