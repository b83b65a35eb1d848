"""Surveyed profiles as CSV: what is read, and what is refused at which line."""

import numpy as np
import pytest

from backend.roads.export import as_csv
from backend.roads.survey import read
from sim_core.scenario.measured import MeasuredRoad
from sim_core.tables.errors import TableError
from tests import wording

HEAD = "distance [m],height [mm]\n"
ROWS = [f"{0.1 * index:.1f},{10 * np.sin(index):.3f}" for index in range(200)]


def file(*, head: str = HEAD, rows: list[str] | None = None) -> bytes:
    return (head + "\n".join(ROWS if rows is None else rows) + "\n").encode()


def test_units_separators_and_the_first_distance_are_the_headers_matter() -> None:
    """One road in metres, in millimetres, with semicolons and decimal commas, behind a BOM, from 500 m on."""
    plain = read(file())
    metres = [f"{row.split(',')[0]},{float(row.split(',')[1]) / 1000:.6f}" for row in ROWS]
    comma = [row.replace(",", ";").replace(".", ",") for row in ROWS]
    feet = [f"{float(row.split(',')[0]) / 0.3048:.9f}\t{row.split(',')[1]}" for row in ROWS]
    later = [f"{500 + float(row.split(',')[0]):.1f},{row.split(',')[1]}" for row in ROWS]
    swapped = [",".join(reversed(row.split(","))) for row in ROWS]
    for other in (
        file(head="x [m], z [m]\n", rows=metres),
        file(head="Distance (m);Height (mm)\n", rows=comma),
        file(head="distance [ft]\theight [mm]\n", rows=feet),
        b"\xef\xbb\xbf# surveyed today\r\n\r\n" + file().replace(b"\n", b"\r\n"),
        file(rows=later),
        file(head="height [mm],distance [m]\n", rows=swapped),
        file(head='"distance [m]", "height [mm]"\n'),
        file(head='"Distance" [m];"Height" (mm)\n', rows=comma),
    ):
        assert read(other).road == plain.road
    assert plain.road.length == 19.9
    assert "The first distance, 500 m, is x = 0" in read(file(rows=later)).warnings


def test_two_tracks_are_their_mean() -> None:
    left_right = [
        f"{0.1 * index:.1f},{10 * np.sin(index) + 4:.3f},{10 * np.sin(index) - 4:.3f}" for index in range(200)
    ]
    both = read(file(head="distance [m],left [mm],right [mm]\n", rows=left_right))
    np.testing.assert_allclose(both.road.heights(), read(file()).road.heights(), atol=3e-6)
    assert both.warnings[0] == "The mean of left and right track is taken"


def test_what_was_done_is_said() -> None:
    said = read(file()).warnings
    assert said[0] == "200 heights became 1991, one every 10 mm, straight lines in between"
    assert said[1].startswith("A straight line was taken off: ")
    assert said[2] == "Heights were averaged over 100 mm, as a tyre's contact does"
    assert len(said) == 3
    coarse = read(file(rows=["0,0", "0.5,3", "1,0", "3.5,1000", "6,2000"]))
    assert "Heights are up to 2.5 m apart: waves shorter than 5 m are missing" in coarse.warnings
    hilly = read(file(head="distance [m],height [m]\n", rows=["0,0", "3,6", "6,0"]))
    assert any(line.endswith("beside the straight line; is the unit right?") for line in hilly.warnings)
    assert hilly.warnings[-1] == "IRI, roughness and waviness count its bumps too"


@pytest.mark.parametrize(("samples", "scale"), [(1_991, 1.0), pytest.param(300_001, 500.0, marks=pytest.mark.thorough)])
def test_an_exported_road_is_read_as_the_same_road(samples: int, scale: float) -> None:
    """The longest and highest one too: its file can be sent."""
    road = MeasuredRoad.of(-scale * (1 + 0.1 * np.random.default_rng(1).standard_normal(samples)))
    content = as_csv(road)
    again = read(b"\xef\xbb\xbf" + content.replace(b"\n", b"\r\n"))
    assert again.road == road
    assert again.warnings == ["This is an exported road: its heights are taken as they are"]


def test_an_exported_road_that_was_changed_is_a_new_measurement() -> None:
    road = read(file()).road
    content = as_csv(road)
    for changed in (content.replace(b"\n0.00,", b"\n0.00,9"), content.replace(b"distance [m]", b"distance [ft]")):
        again = read(changed)
        assert again.road != road
        assert again.warnings[0] == "This exported road was changed: it is read as a new measurement"
        assert "Heights were averaged over 100 mm, as a tyre's contact does" in again.warnings


@pytest.mark.parametrize("content", wording.asked_in("surveys"))
def test_what_is_no_road_is_refused(content: str) -> None:
    with pytest.raises(TableError) as refused:
        read(content.encode())
    wording.check("surveys", content, str(refused.value))
