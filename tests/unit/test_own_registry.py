"""What there is of one's own: a file that takes too long is tried again, ever less often."""

import os
from contextlib import closing
from pathlib import Path
from typing import Any, NoReturn

import pytest

from backend.custom_controllers import host as host_module
from backend.custom_controllers import registry
from backend.custom_controllers.host import Host, SlowFileError
from sim_core import controller_files
from sim_core.controller_files import ControllerFileError
from tests.servers.process import ROOT


class Slow:
    """In a host's place: its file never ends."""

    def __init__(self, source: str) -> None:
        pass

    def call(self, *_: Any, limit: float) -> NoReturn:
        raise SlowFileError("slow.py: it did not end")

    def close(self) -> None:
        pass


class Clock:
    """In the place of `time`."""

    now = 0.0

    def monotonic(self) -> float:
        return self.now


def test_the_pause_before_another_try_doubles(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("_sources", "_of", "_controllers"):
        monkeypatch.setattr(registry, name, type(getattr(registry, name))())
    monkeypatch.setattr(controller_files, "_find", controller_files.load_all)
    monkeypatch.setattr(registry, "Host", Slow)
    clock = Clock()
    monkeypatch.setattr(registry, "time", clock)
    (tmp_path / "slow.py").touch()
    monkeypatch.setenv(controller_files.VARIABLE, str(tmp_path))
    registry.refresh(20.0)
    stand_in = registry._controllers["slow"]
    for pause in (60.0, 120.0, 240.0):
        clock.now += pause - 1
        assert not registry.retry_due()
        clock.now += 1
        assert registry.retry_due()
        registry.try_again(20.0)
        assert registry._controllers["slow"] is stand_in, "what ends the same way makes nothing anew"
    (tmp_path / "slow.py").write_text("pass")
    assert registry.stale()
    registry.refresh(20.0)
    clock.now += 60
    assert registry.retry_due(), "a saved file begins with the first pause again"


def test_it_has_what_a_package_names_by_an_entry_point(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "their_laws.py").write_text((ROOT / "examples" / "controllers" / "pid.py").read_text())
    (tmp_path / "their_laws-1.dist-info").mkdir()
    names = tmp_path / "their_laws-1.dist-info" / "entry_points.txt"
    names.write_text(f"[{controller_files.GROUP}]\nlaws = their_laws\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    with closing(Host("entry point laws")) as host:
        assert host.call(os.path.basename, "/a/b", limit=60) == "b"


def test_a_process_that_does_not_start_is_not_said_to_be_a_law_that_does_not_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(host_module, "STARTING", 0.0)
    with (
        closing(Host("mine.py")) as host,
        pytest.raises(ControllerFileError, match=r"mine\.py: its process did not start within 0 s"),
    ):
        host.call(os.path.basename, "/a/b", limit=60)
