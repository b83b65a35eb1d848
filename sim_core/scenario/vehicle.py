"""The half-car's parameters (Table 2)."""

from math import inf
from typing import Annotated

from pydantic import PrivateAttr

from sim_core.scenario.damper import DamperCurve, slopes_at_rest, straight
from sim_core.scenario.fields import ADDED, Part, field, quantity

WheelMass = Annotated[float, quantity("kg", soft=(20, 150), ge=5, le=5000)]
CgHeight = Annotated[float, quantity("m", soft=(0.3, 1), ge=0, le=3)]
Spring = Annotated[float, quantity("N/m", soft=(10_000, 60_000), ge=1000, le=5_000_000)]
Damping = Annotated[float, quantity("N·s/m", soft=(500, 10_000), ge=10, le=500_000)]
TyreStiffness = Annotated[float, quantity("N/m", soft=(100_000, 500_000), ge=10_000, le=20_000_000)]
Clearance = Annotated[float | None, quantity("m", soft=(0.04, 0.12), ge=0.005, le=1, shown="mm")]
StopStiffness = Annotated[float, quantity("N/m", soft=(50_000, 500_000), ge=1000, le=5_000_000)]
ONE_TRACK, ONE_WHEEL = "one track of two", "one wheel"  # not the whole car's, not both wheels'
LinkShare = Annotated[float, quantity("1", soft=(0, 1), ge=-1, le=3)]


class Vehicle(Part):
    """Half-car model: body with heave and pitch, front and rear wheel (Table 2)."""

    body_mass: Annotated[float, quantity("kg", soft=(300, 2500), ge=50, le=50_000)] = field(
        1270, "Body mass", "Sprung mass m_b of one track, half of the whole car's.", note=ONE_TRACK
    )
    pitch_inertia: Annotated[float, quantity("kg·m^2", soft=(400, 4000), ge=10, le=500_000)] = field(
        1536.7, "Pitch inertia", "Body inertia about the pitch axis I_yy, half of the whole car's.", note=ONE_TRACK
    )
    front_wheel_mass: WheelMass = field(
        66.3, "Front wheel mass", "Unsprung mass m_w1 of one wheel, half of the axle's.", note=ONE_WHEEL
    )
    rear_wheel_mass: WheelMass = field(
        66.3, "Rear wheel mass", "Unsprung mass m_w2 of one wheel, half of the axle's.", note=ONE_WHEEL
    )
    cg_to_front: Annotated[float, quantity("m", soft=(0.8, 2), ge=0.2, le=10)] = field(
        1.015, "Centre of gravity to front axle", "Distance a."
    )
    cg_to_rear: Annotated[float, quantity("m", soft=(0.8, 2.5), ge=0.2, le=10)] = field(
        1.895, "Centre of gravity to rear axle", "Distance b."
    )
    cg_height: CgHeight = field(
        0.54, "Height of the centre of gravity", "Arm of the braking force on the body h_cg (ours)."
    )
    front_spring: Spring = field(
        27_000, "Front spring", "Suspension stiffness k_s1 of one wheel, half of the axle's.", note=ONE_WHEEL
    )
    rear_spring: Spring = field(
        30_000, "Rear spring", "Suspension stiffness k_s2 of one wheel, half of the axle's.", note=ONE_WHEEL
    )
    front_damping: Damping = field(
        6000, "Front damper", "Damping C_s1 of one wheel, half of the axle's.", note=ONE_WHEEL
    )
    rear_damping: Damping = field(6000, "Rear damper", "Damping C_s2 of one wheel, half of the axle's.", note=ONE_WHEEL)
    front_tyre_stiffness: TyreStiffness = field(
        268_000, "Front tyre stiffness", "Vertical stiffness k_u1 of one tyre.", note=ONE_WHEEL
    )
    rear_tyre_stiffness: TyreStiffness = field(
        268_000, "Rear tyre stiffness", "Vertical stiffness k_u2 of one tyre.", note=ONE_WHEEL
    )
    rebound_ratio: Annotated[float, quantity("1", soft=(1, 3), ge=0.1, le=10), ADDED] = field(
        1,
        "Rebound over compression",
        "Of both dampers, at the same mean damping; real ones have 2 to 3. The controllers know the mean alone.",
    )
    front_damper_curve: Annotated[DamperCurve | None, ADDED] = field(
        None,
        "Front damper curve",
        "A few points [velocity m/s, force N], rebound positive, that the car is driven with in place of the front "
        "damper and its rebound ratio; the controllers know the front damper alone. None is no curve.",
    )
    rear_damper_curve: Annotated[DamperCurve | None, ADDED] = field(
        None, "Rear damper curve", "The same of the rear damper."
    )
    bump_stop_clearance: Annotated[Clearance, ADDED] = field(
        None,
        "Clearance of the stops",
        "Travel either way from rest until a stop is met. A load, or softer springs, of the real car alone (mismatch) "
        "use up some of it in compression; none is a car without stops.",
    )
    bump_stop_stiffness: Annotated[StopStiffness, ADDED] = field(
        200_000, "Stiffness of the stops", "Added to the spring's beyond the clearance (ours)."
    )
    tyre_lift_off: Annotated[bool, ADDED] = field(
        False,
        "Tyres lift off",
        "On, a tyre cannot pull on the road: its load is never below 0. Off, as in the paper, it can.",
    )
    anti_dive: Annotated[LinkShare, ADDED] = field(
        0,
        "Anti-dive",
        "Share of the load transfer that the front links would carry if only the front wheels braked: tan β L / h.",
    )
    anti_lift: Annotated[LinkShare, ADDED] = field(
        0,
        "Anti-lift",
        "Share of the load transfer that the rear links would carry if only the rear wheels braked: tan β L / h.",
    )
    front_brake_share: Annotated[float, quantity("1", soft=(0.5, 0.9), ge=0, le=1), ADDED] = field(
        0.7, "Front brakes' share", "Of the braking force (ours); for anti-dive."
    )

    _lowered: tuple[float, float] = PrivateAttr((0.0, 0.0))

    @property
    def lowered(self) -> tuple[float, float]:
        """How much further than that of the believed car its body's weight compresses front and rear suspension [m]."""
        return self._lowered

    @property
    def stop_clearances(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Travel from rest to the stops in compression, front and rear, then in rebound [m].

        Infinite without stops, below 0 where the car rests on one.
        """
        clearance = inf if self.bump_stop_clearance is None else self.bump_stop_clearance
        front, rear = self._lowered
        return (clearance - front, clearance - rear), (clearance + front, clearance + rear)

    @property
    def link_forces(self) -> tuple[float, float]:
        """What links lift the body by over both axles, and press the wheels by, as an actuator would [N per m/s²]."""
        transfer = self.body_mass * self.cg_height / self.wheelbase
        front, rear = self.front_brake_share * self.anti_dive, (1 - self.front_brake_share) * self.anti_lift
        return front * transfer, -rear * transfer

    @property
    def linear(self) -> bool:
        """Check whether its dampers, stops and tyres are linear."""
        equal = self.rebound_ratio == 1 and self.damper_curves is None
        return equal and self.bump_stop_clearance is None and not self.tyre_lift_off

    @property
    def damper_curves(self) -> tuple[DamperCurve, DamperCurve] | None:
        """Both dampers' curves where one has any; the other's is straight in compression and in rebound."""
        curves = self.front_damper_curve, self.rear_damper_curve
        if curves == (None, None):
            return None
        compression, rebound = self.damping_factors
        linear = [straight(compression * each, rebound * each) for each in (self.front_damping, self.rear_damping)]
        return curves[0] or linear[0], curves[1] or linear[1]

    @property
    def damping_at_rest(self) -> tuple[float, float]:
        """Mean damping around 0 m/s, front and rear [N s/m]."""
        if self.damper_curves is None:
            return self.front_damping, self.rear_damping
        front, rear = (sum(slopes_at_rest(points)) / 2 for points in self.damper_curves)
        return front, rear

    @property
    def damping_factors(self) -> tuple[float, float]:
        """Damping in compression and in rebound over their mean."""
        compression = 2 / (1 + self.rebound_ratio)
        return compression, compression * self.rebound_ratio

    @property
    def wheelbase(self) -> float:
        """Distance between the axles L = a + b [m]."""
        return self.cg_to_front + self.cg_to_rear

    @property
    def total_mass(self) -> float:
        """Body and both wheels [kg]."""
        return self.body_mass + self.front_wheel_mass + self.rear_wheel_mass

    @property
    def body_loads(self) -> tuple[float, float]:
        """Weight of the body on the front and the rear suspension [N]."""
        body = self.body_mass * GRAVITY / self.wheelbase
        return body * self.cg_to_rear, body * self.cg_to_front

    @property
    def static_loads(self) -> tuple[float, float]:
        """Static tyre loads, front and rear [N]: each axle's share of the body, and its wheel."""
        front, rear = self.body_loads
        return front + self.front_wheel_mass * GRAVITY, rear + self.rear_wheel_mass * GRAVITY


GRAVITY = 9.80665  # standard gravity [m/s^2]
