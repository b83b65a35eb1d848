"""The half-car's parameters (Table 2)."""

from typing import ClassVar

from pydantic import Field

from sim_core.scenario.fields import Part, quantity


class Vehicle(Part):
    """Half-car model: body with heave and pitch, front and rear wheel (Table 2)."""

    ADDED: ClassVar = frozenset(
        {
            "rebound_ratio",
            "bump_stop_clearance",
            "bump_stop_stiffness",
            "tyre_lift_off",
            "anti_dive",
            "anti_lift",
            "front_brake_share",
        }
    )

    body_mass: float = quantity(1270, "kg", "Body mass", "Sprung mass m_b.", soft=(300, 2500), ge=50, le=50_000)
    pitch_inertia: float = quantity(
        1536.7,
        "kg·m^2",
        "Pitch inertia",
        "Body inertia about the pitch axis I_yy.",
        soft=(400, 4000),
        ge=10,
        le=500_000,
    )
    front_wheel_mass: float = quantity(
        66.3, "kg", "Front wheel mass", "Unsprung mass m_w1.", soft=(20, 150), ge=5, le=5000
    )
    rear_wheel_mass: float = quantity(
        66.3, "kg", "Rear wheel mass", "Unsprung mass m_w2.", soft=(20, 150), ge=5, le=5000
    )
    cg_to_front: float = quantity(
        1.015, "m", "Centre of gravity to front axle", "Distance a.", soft=(0.8, 2), ge=0.2, le=10
    )
    cg_to_rear: float = quantity(
        1.895, "m", "Centre of gravity to rear axle", "Distance b.", soft=(0.8, 2.5), ge=0.2, le=10
    )
    cg_height: float = quantity(
        0.54,
        "m",
        "Height of the centre of gravity",
        "Arm of the braking force on the body h_cg (ours).",
        soft=(0.3, 1),
        ge=0,
        le=3,
    )
    front_spring: float = quantity(
        27_000, "N/m", "Front spring", "Suspension stiffness k_s1.", soft=(10_000, 60_000), ge=1000, le=5_000_000
    )
    rear_spring: float = quantity(
        30_000, "N/m", "Rear spring", "Suspension stiffness k_s2.", soft=(10_000, 60_000), ge=1000, le=5_000_000
    )
    front_damping: float = quantity(
        6000, "N·s/m", "Front damper", "Damping C_s1.", soft=(500, 10_000), ge=10, le=500_000
    )
    rear_damping: float = quantity(6000, "N·s/m", "Rear damper", "Damping C_s2.", soft=(500, 10_000), ge=10, le=500_000)
    front_tyre_stiffness: float = quantity(
        268_000,
        "N/m",
        "Front tyre stiffness",
        "Vertical stiffness k_u1.",
        soft=(100_000, 500_000),
        ge=10_000,
        le=20_000_000,
    )
    rear_tyre_stiffness: float = quantity(
        268_000,
        "N/m",
        "Rear tyre stiffness",
        "Vertical stiffness k_u2.",
        soft=(100_000, 500_000),
        ge=10_000,
        le=20_000_000,
    )
    rebound_ratio: float = quantity(
        1,
        "1",
        "Rebound over compression",
        "Of both dampers, at the same mean damping; real ones have 2 to 3. The controllers know the mean alone.",
        soft=(1, 3),
        ge=0.1,
        le=10,
    )
    bump_stop_clearance: float | None = quantity(
        None,
        "m",
        "Clearance of the stops",
        "Travel either way from rest until a stop is met; none is a car without stops.",
        soft=(0.04, 0.12),
        ge=0.005,
        le=1,
        shown="mm",
    )
    bump_stop_stiffness: float = quantity(
        200_000,
        "N/m",
        "Stiffness of the stops",
        "Added to the spring's beyond the clearance (ours).",
        soft=(50_000, 500_000),
        ge=1000,
        le=5_000_000,
    )
    tyre_lift_off: bool = Field(
        False,
        title="Tyres lift off",
        description="On, a tyre cannot pull on the road: its load is never below 0. Off, as in the paper, it can.",
    )
    anti_dive: float = quantity(
        0,
        "1",
        "Anti-dive",
        "Share of the load transfer that the front links would carry if only the front wheels braked: tan β L / h.",
        soft=(0, 1),
        ge=-1,
        le=3,
    )
    anti_lift: float = quantity(
        0,
        "1",
        "Anti-lift",
        "Share of the load transfer that the rear links would carry if only the rear wheels braked: tan β L / h.",
        soft=(0, 1),
        ge=-1,
        le=3,
    )
    front_brake_share: float = quantity(
        0.7, "1", "Front brakes' share", "Of the braking force (ours); for anti-dive.", soft=(0.5, 0.9), ge=0, le=1
    )

    @property
    def link_forces(self) -> tuple[float, float]:
        """What links lift the body by over both axles, and press the wheels by, as an actuator would [N per m/s²]."""
        transfer = self.body_mass * self.cg_height / self.wheelbase
        front, rear = self.front_brake_share * self.anti_dive, (1 - self.front_brake_share) * self.anti_lift
        return front * transfer, -rear * transfer

    @property
    def linear(self) -> bool:
        """Whether its dampers, stops and tyres are linear."""
        return self.rebound_ratio == 1 and self.bump_stop_clearance is None and not self.tyre_lift_off

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
    def static_loads(self) -> tuple[float, float]:
        """Static tyre loads, front and rear [N]: each axle's share of the body, and its wheel."""
        body = self.body_mass * GRAVITY / self.wheelbase
        return (
            body * self.cg_to_rear + self.front_wheel_mass * GRAVITY,
            body * self.cg_to_front + self.rear_wheel_mass * GRAVITY,
        )


GRAVITY = 9.80665  # standard gravity [m/s^2]
