"""Custom controllers for tests, and the short road that they are driven over."""

from typing import Any

from sim_core import Bump, Controller, Road, Scenario

SHORT = Scenario(road=Road(length=60, bump=Bump(start=30)))


def no_force(_self: Controller, _seen: object) -> tuple[float, float]:
    """Give none."""
    return 0.0, 0.0


def make_class(base: type[Controller] = Controller, **members: Any) -> type[Controller]:
    """Return a class that gives no force and has no fault, but for its `members`."""
    good = {"__doc__": "Is a test's.", "id": "fine", "label": "Fine"}
    return type("Fine", (base,), good | ({"force": no_force} if base is Controller else {}) | members)
