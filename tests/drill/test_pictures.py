"""The pictures in docs/images show the page of today: its words are those that `make screenshots` wrote beside them."""

import json
from collections.abc import Callable

import pytest

from tests.browser.dashboard import Dashboard
from tests.browser.moving_picture import FILE as MOVING_PICTURE
from tests.browser.screenshots import LAPTOP, PICTURES, WORDS, Picture, words
from tests.browser.server import Server

LIGHT = [picture for picture in PICTURES if picture.size == LAPTOP and picture.scheme == "light"]


@pytest.fixture(scope="module", autouse=True)
def reproduced(server: Server, reproduction: Callable[[str], None]) -> None:
    reproduction(f"sqlite:///{server.database}")


@pytest.mark.parametrize("picture", LIGHT, ids=lambda picture: picture.name)
def test_a_picture_has_the_words_of_the_page(picture: Picture, dashboard: Dashboard, server: Server) -> None:
    dashboard.page.set_viewport_size({"width": picture.size[0], "height": picture.size[1]})
    dashboard.page.goto(picture.address(server))
    picture.ready(dashboard)
    before, now = set(json.loads(WORDS.read_text("utf-8"))[picture.name]), set(words(dashboard))
    came, went = sorted(now - before), sorted(before - now)
    assert (came, went) == ([], []), f"{picture.name}.png is older than these words: make screenshots takes it anew"


def test_the_moving_picture_is_small_and_moves() -> None:
    """`make screenshots` takes it; a README is opened over slow lines too."""
    content = MOVING_PICTURE.read_bytes()
    assert len(content) < 1_000_000
    assert content[:4] + content[8:16] == b"RIFFWEBPVP8X"
    assert content.count(b"ANMF") > 12
