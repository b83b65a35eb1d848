"""A half-car from what a whole car's data sheet says (docs/explanation/half-car.md)."""

from math import pi, sqrt
from typing import Annotated, Self

from pydantic import ValidationError, model_validator

from sim_core.scenario.fields import Part, at, field_texts, quantity
from sim_core.scenario.vehicle import CgHeight, TyreStiffness, Vehicle
from sim_core.scenario.vehicles import one_track

AxleLoad = Annotated[float, quantity("kg", soft=(300, 1500), ge=50, le=50_000)]
AxleMass = Annotated[float, quantity("kg", soft=(40, 200), ge=10, le=10_000)]
Frequency = Annotated[float, quantity("Hz", soft=(0.8, 2.5), ge=0.2, le=20)]
DampingRatio = Annotated[float, quantity("1", soft=(0.1, 0.6), ge=0.001, le=5)]


class DataSheet(Part):
    """A whole car: what its axles weigh, how fast they swing and how well that is damped."""

    front_axle_load: AxleLoad
    rear_axle_load: AxleLoad
    front_axle_mass: AxleMass
    rear_axle_mass: AxleMass
    wheelbase: Annotated[float, quantity("m", soft=(2, 4), ge=0.4, le=20)]
    cg_height: CgHeight = 0.55
    front_frequency: Frequency
    rear_frequency: Frequency
    front_damping_ratio: DampingRatio
    rear_damping_ratio: DampingRatio
    front_tyre_stiffness: TyreStiffness
    rear_tyre_stiffness: TyreStiffness
    pitch_inertia: Annotated[float | None, quantity("kg·m^2", soft=(500, 5000), ge=20, le=1_000_000)] = None

    @model_validator(mode="after")
    def _possible(self) -> Self:
        for axle in ("front", "rear"):
            mass, together, tyre = self._wheel(axle)
            if mass <= 0:
                raise at(f"{axle}_axle_load", "An axle carries more than its own wheels")
            if together >= tyre:
                raise at(f"{axle}_frequency", "The tyre alone is softer than this frequency needs")
        try:
            self.half_car()
        except ValidationError as error:
            wrong = error.errors(include_input=False, include_url=False)[0]
            name = str(wrong["loc"][0])
            title = field_texts(Vehicle, name)["title"]
            message = f"The half-car's {title} would be beyond its limits: {wrong['msg']}"
            words = next((each for each in _DECIDES if each in name), name)
            raise at(name.replace(words, _DECIDES.get(words, words)), message) from None
        return self

    def half_car(self) -> Vehicle:
        """Return the half-car of one track.

        An axle's share m of the body swings on spring and tyre in series, k = (2π f)² m = k_s k_t/(k_s + k_t). The
        damper moves by k_t/(k_s + k_t) of what the body does, so it needs 2 ζ √(k m) (1 + k_s/k_t)².
        """
        sprung, values = dict[str, float](), {"cg_height": self.cg_height}
        for axle in ("front", "rear"):
            sprung[axle], values[f"{axle}_spring"], values[f"{axle}_damping"] = self._suspension(axle)
            values[f"{axle}_wheel_mass"] = getattr(self, f"{axle}_axle_mass")
            values[f"{axle}_tyre_stiffness"] = getattr(self, f"{axle}_tyre_stiffness")
        mass = sprung["front"] + sprung["rear"]
        to_front = self.wheelbase * sprung["rear"] / mass
        to_rear = self.wheelbase - to_front
        inertia = mass * to_front * to_rear if self.pitch_inertia is None else self.pitch_inertia
        values |= {"body_mass": mass, "pitch_inertia": inertia, "cg_to_front": to_front, "cg_to_rear": to_rear}
        return one_track(values)

    def _wheel(self, axle: str) -> tuple[float, float, float]:
        """Return one wheel's share of the body [kg], spring and tyre in series, and the tyre [N/m]."""
        names = ("axle_load", "axle_mass", "frequency", "tyre_stiffness")
        load, wheels, frequency, tyre = (getattr(self, f"{axle}_{name}") for name in names)
        mass = (load - wheels) / 2
        return mass, (2 * pi * frequency) ** 2 * mass, tyre

    def _suspension(self, axle: str) -> tuple[float, float, float]:
        """Return an axle's share of the body [kg]; spring [N/m] and damper [N s/m] of one wheel."""
        mass, together, tyre = self._wheel(axle)
        spring = together * tyre / (tyre - together)
        ratio = getattr(self, f"{axle}_damping_ratio")
        return 2 * mass, spring, 2 * ratio * sqrt(together * mass) * (1 + spring / tyre) ** 2


# By words of a half-car's field those of the sheet's field that decides it.
_DECIDES = {
    **{"body_mass": "front_axle_load", "cg_to_front": "rear_axle_load", "cg_to_rear": "front_axle_load"},
    **{"wheel_mass": "axle_mass", "spring": "frequency", "damping": "damping_ratio", "pitch_inertia": "wheelbase"},
}
