"""A service on a machine without a C compiler: what builds a program says so, all else works."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from backend.ecu.build import NO_COMPILER, NO_CROSS_COMPILER
from backend.settings import Settings
from tests.api.conftest import Service, serve
from tests.client.cli import Cli
from tests.servers.compilers import Bare

SMALL: dict[str, Any] = {
    "road": {"length": 20, "bump": {"start": 10, "width": 3, "height": 0.05}},
    "speed": {"initial_speed_kmh": 50, "target_speed_kmh": 50},
    "mpc": {"prediction_horizon": 6, "control_horizon": 3},
}
SCENARIO = SMALL


def serve_on(machine: Bare, data: Path) -> Iterator[Service]:
    """Whatever builds and drives is a process of its own, with that machine's environment."""
    with pytest.MonkeyPatch.context() as patch:
        for name, value in machine.environment.items():
            patch.setenv(name, value)
        yield from serve(Settings(data_dir=data, workers=1, batch_workers=1))


@pytest.fixture(scope="module")
def bare(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    machine = Bare(tmp_path_factory.mktemp("machine"))
    yield from serve_on(machine, tmp_path_factory.mktemp("data"))


@pytest.fixture
def command(bare: Service, capfdbinary: pytest.CaptureFixture[bytes], monkeypatch: pytest.MonkeyPatch) -> Cli:
    monkeypatch.setenv("RIDELAB_SERVER", str(bare.client.base_url))
    return Cli(capfdbinary)


def test_a_run_needs_none(bare: Service) -> None:
    run = bare.run(["lv_hil", "passive"], SMALL).json()
    assert {name: each["status"] for name, each in run["strategies"].items()} == {"lv_hil": "ok", "passive": "ok"}


@pytest.mark.parametrize(
    ("path", "arguments", "sentence"),
    [
        ("/report", ("controller", "--report"), NO_CROSS_COMPILER),
        ("/realtime", ("hil",), NO_COMPILER),
    ],
    ids=["report", "clock"],
)
def test_what_is_measured_is_refused_at_once(
    bare: Service, command: Cli, scenario: Path, path: str, arguments: tuple[str, ...], sentence: str
) -> None:
    """Nobody is asked to wait: the client would, and then ask again for nothing."""
    answer = bare.client.post(f"/api/v1/controller{path}", json={"scenario": SMALL})
    problem = answer.json()
    assert (answer.status_code, problem["type"]) == (503, "urn:problem-type:ridelab:ecu-unavailable")
    assert problem["detail"] == f"{sentence}."
    assert "retry-after" not in answer.headers
    name, *options = arguments
    assert not command(name, scenario, *options, code=3)
    assert f"{sentence}. (request " in command.error
