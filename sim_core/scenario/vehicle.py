"""The half-car's parameters (Table 2)."""

from math import inf
from typing import Annotated

from pydantic import PrivateAttr

from sim_core.scenario.damper import DamperCurve, slopes_at_rest, straight
from sim_core.scenario.fields import ADDED, Part, quantity

WheelMass = Annotated[float, quantity("kg", soft=(20, 150), ge=5, le=5000)]
CgHeight = Annotated[float, quantity("m", soft=(0.3, 1), ge=0, le=3)]
Spring = Annotated[float, quantity("N/m", soft=(10_000, 60_000), ge=1000, le=5_000_000)]
Damping = Annotated[float, quantity("N·s/m", soft=(500, 10_000), ge=10, le=500_000)]
TyreStiffness = Annotated[float, quantity("N/m", soft=(100_000, 500_000), ge=10_000, le=20_000_000)]
Clearance = Annotated[float | None, quantity("m", soft=(0.04, 0.12), ge=0.005, le=1, shown="mm")]
StopStiffness = Annotated[float, quantity("N/m", soft=(50_000, 500_000), ge=1000, le=5_000_000)]
LinkShare = Annotated[float, quantity("1", soft=(0, 1), ge=-1, le=3)]


class Vehicle(Part):
    """Half-car model: body with heave and pitch, front and rear wheel (Table 2)."""

    body_mass: Annotated[float, quantity("kg", soft=(300, 2500), ge=50, le=50_000)] = 1270
    pitch_inertia: Annotated[float, quantity("kg·m^2", soft=(400, 4000), ge=10, le=500_000)] = 1536.7
    front_wheel_mass: WheelMass = 66.3
    rear_wheel_mass: WheelMass = 66.3
    cg_to_front: Annotated[float, quantity("m", soft=(0.8, 2), ge=0.2, le=10)] = 1.015
    cg_to_rear: Annotated[float, quantity("m", soft=(0.8, 2.5), ge=0.2, le=10)] = 1.895
    cg_height: CgHeight = 0.54
    front_spring: Spring = 27_000
    rear_spring: Spring = 30_000
    front_damping: Damping = 6000
    rear_damping: Damping = 6000
    front_tyre_stiffness: TyreStiffness = 268_000
    rear_tyre_stiffness: TyreStiffness = 268_000
    rebound_ratio: Annotated[float, quantity("1", soft=(1, 3), ge=0.1, le=10), ADDED] = 1
    front_damper_curve: Annotated[DamperCurve | None, ADDED] = None
    rear_damper_curve: Annotated[DamperCurve | None, ADDED] = None
    bump_stop_clearance: Annotated[Clearance, ADDED] = None
    bump_stop_stiffness: Annotated[StopStiffness, ADDED] = 200_000
    tyre_lift_off: Annotated[bool, ADDED] = False
    anti_dive: Annotated[LinkShare, ADDED] = 0
    anti_lift: Annotated[LinkShare, ADDED] = 0
    front_brake_share: Annotated[float, quantity("1", soft=(0.5, 0.9), ge=0, le=1), ADDED] = 0.7

    _lowered: tuple[float, float] = PrivateAttr((0.0, 0.0))

    @property
    def lowered(self) -> tuple[float, float]:
        """Return how much more the body's weight compresses front and rear suspension than the believed car's [m]."""
        return self._lowered

    @property
    def stop_clearances(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Return the travel from rest to the stops in compression, front and rear, then in rebound [m].

        Infinite without stops, below 0 where the car rests on one.
        """
        clearance = inf if self.bump_stop_clearance is None else self.bump_stop_clearance
        front, rear = self._lowered
        return (clearance - front, clearance - rear), (clearance + front, clearance + rear)

    @property
    def link_forces(self) -> tuple[float, float]:
        """Return the force by which links lift the body over both axles, and press the wheels [N per m/s²]."""
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
        """Return both dampers' curves where one has any; the other's is straight in compression and in rebound."""
        curves = self.front_damper_curve, self.rear_damper_curve
        if curves == (None, None):
            return None
        compression, rebound = self.damping_factors
        linear = [straight(compression * each, rebound * each) for each in (self.front_damping, self.rear_damping)]
        return curves[0] or linear[0], curves[1] or linear[1]

    @property
    def damping_at_rest(self) -> tuple[float, float]:
        """Return the mean damping around 0 m/s, front and rear [N s/m]."""
        if self.damper_curves is None:
            return self.front_damping, self.rear_damping
        front, rear = (sum(slopes_at_rest(points)) / 2 for points in self.damper_curves)
        return front, rear

    @property
    def damping_factors(self) -> tuple[float, float]:
        """Return the damping in compression and in rebound over their mean."""
        compression = 2 / (1 + self.rebound_ratio)
        return compression, compression * self.rebound_ratio

    @property
    def wheelbase(self) -> float:
        """Return the distance between the axles L = a + b [m]."""
        return self.cg_to_front + self.cg_to_rear

    @property
    def total_mass(self) -> float:
        """Return the mass of body and both wheels [kg]."""
        return self.body_mass + self.front_wheel_mass + self.rear_wheel_mass

    @property
    def body_loads(self) -> tuple[float, float]:
        """Return the weight of the body on the front and the rear suspension [N]."""
        body = self.body_mass * GRAVITY / self.wheelbase
        return body * self.cg_to_rear, body * self.cg_to_front

    @property
    def static_loads(self) -> tuple[float, float]:
        """Return the static tyre loads, front and rear [N]: each axle's share of the body, and its wheel."""
        front, rear = self.body_loads
        return front + self.front_wheel_mass * GRAVITY, rear + self.rear_wheel_mass * GRAVITY


GRAVITY = 9.80665  # standard gravity [m/s^2]
