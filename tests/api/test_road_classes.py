"""Roads that have no class of ISO 8608, over HTTP: null, and a caution with the reason."""

import httpx
import numpy as np
import pytest


@pytest.mark.parametrize(
    ("length", "said"),
    [
        (100, "the road's spectrum is not a straight line, so its roughness is uncertain by a factor of"),
        (30, "the road is short (30 m) or its spectrum is not a straight line"),
    ],
)
def test_a_road_of_two_sine_waves_has_a_caution_in_place_of_a_class(
    client: httpx.Client, length: int, said: str
) -> None:
    x = np.arange(0, length + 0.1, 0.25)
    heights = 10 * np.sin(2 * np.pi * x / 5) + 4 * np.sin(2 * np.pi * x / 2)
    rows = [f"{a:.2f},{h:.3f}" for a, h in zip(x, heights, strict=True)]
    content = "\n".join(["distance [m],height [mm]", *rows])
    road = client.post("/api/v1/roads", content=content, headers={"Content-Type": "text/csv"}).json()
    got = client.get(f"/api/v1/roads/{road['id']}").json()
    assert (road["iso_class"], got["iso_class"], got["cautions"]) == (None, None, road["cautions"])
    (caution,) = road["cautions"]
    assert (caution["kind"], caution["field"], caution["strategy"]) == ("spectrum", "road.profile", None)
    assert caution["text"].startswith(f"No ISO 8608 class: {said}")
    assert caution["text"].endswith(f"By its IRI of {road['iri']['mean']:.3g} m/km it is a very rough road.")
