"""Units as people write them, and the core's one table, which the client and the page have copies of."""

import os
from pathlib import Path

import pytest

from ridelab.units import quantity, switch
from sim_core.scenario import dotted
from sim_core.units import UNITS, factor
from tests import wording

ROOT = Path(__file__).parents[2]
COPIES = ("frontend/src/units/units.gen.json", "client/ridelab/units.gen.json")


@pytest.mark.parametrize("asked", wording.asked_in("units"), ids=str)
def test_a_number_with_a_unit_is_converted_or_refused_with_the_units_there_are(asked: list[str]) -> None:
    """So is a switch, in the words that people have for it."""
    text, unit = asked
    try:
        said: float | str = switch(text) if unit == "switch" else quantity(text, unit)
    except ValueError as error:
        said = str(error)
    wording.check("units", asked, said)


@pytest.mark.parametrize(
    ("written", "unit", "expected"),
    [("cm", "m", 0.01), ("KG m2", "kg·m^2", 1), ("km/h", "m/s", 1 / 3.6), ("deg/s", "rad/s", 0.0174532925199)],
)
def test_a_unit_is_so_many_of_another(written: str, unit: str, expected: float) -> None:
    assert factor(written, unit) == pytest.approx(expected, rel=1e-12)
    with pytest.raises(ValueError, match="furlongs is not understood"):
        factor("furlongs", unit)


@pytest.mark.parametrize("words", [("true", "on", "yes", "1"), ("false", "off", "no", "0")])
def test_a_switch_is_read_as_people_write_it(words: tuple[str, ...]) -> None:
    written = {spelling for word in words for spelling in (word, word.capitalize(), word.upper(), f" {word} ")}
    assert {switch(text) for text in written} == {words[0] == "true"}


def test_every_fields_unit_is_known() -> None:
    known = {unit for units in UNITS.values() for unit in units}
    assert {field.unit for field in dotted.fields().values()} <= known | {"1/N^2"}


@pytest.mark.parametrize("copy", COPIES)
def test_the_clients_and_the_pages_table_is_the_cores(copy: str) -> None:
    """UPDATE_DOCS=1 writes it."""
    file, text = ROOT / copy, (ROOT / "sim_core/units.json").read_text(encoding="utf-8")
    if os.environ.get("UPDATE_DOCS"):
        file.write_text(text, encoding="utf-8")
    assert file.read_text(encoding="utf-8") == text
