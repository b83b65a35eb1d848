"""The half-car's parameters (Table 2)."""

from sim_core.scenario.fields import Part, quantity


class Vehicle(Part):
    """Half-car model: body with heave and pitch, front and rear wheel (Table 2)."""

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
