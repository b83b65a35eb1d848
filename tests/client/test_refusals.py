"""What commands refuse, and what they say: the option or the field, and what helps."""

import shlex

import httpx
import pytest

from tests import wording
from tests.client.cli import Cli
from tests.client.conftest import Prepared


@pytest.mark.parametrize("words", wording.asked_in("refusals"))
@pytest.mark.usefixtures("scenario")
def test_what_cannot_be_used_is_named(cli: Cli, words: str) -> None:
    assert cli(*shlex.split(words), code=2) == ""
    wording.check("refusals", words, cli.error)


def test_a_service_that_asks_for_a_token_leads_to_where_it_is_given(cli: Cli, prepared: Prepared) -> None:
    kind = "urn:problem-type:ridelab:token-required"
    refusal = {"type": kind, "status": 401, "detail": "With a token.", "errors": []}
    prepared.answers["GET /batches"] = httpx.Response(401, json=refusal)
    assert cli("jobs", "list", code=2) == ""
    assert "ridelab --token-file FILE COMMAND" in cli.error


def test_too_few_roads_for_the_paper_are_said_as_roads(cli: Cli, prepared: Prepared) -> None:
    wrong = {"parameter": "seeds", "pointer": "", "message": "Input should be greater than or equal to 20"}
    prepared.answers["GET /paper"] = httpx.Response(422, json={"status": 422, "detail": "Wrong.", "errors": [wrong]})
    assert cli("paper", "--seeds", "1-10", code=2) == ""
    assert cli.error == "--seeds: 1-10 are 10 roads. Input should be greater than or equal to 20\n"
