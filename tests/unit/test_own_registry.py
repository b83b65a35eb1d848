"""Custom controllers that there are: a file that takes too long is tried again."""

import os
from contextlib import closing
from pathlib import Path
from typing import Any, NoReturn

import pytest

from backend.custom_controllers import controller_process, registry
from backend.custom_controllers.controller_process import ControllerProcess, SlowFileError
from sim_core import controller_files
from sim_core.controller_files import ControllerFileError
from tests.servers.process import ROOT


class Slow:
    """In the place of a process: its file never ends."""

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


def test_what_may_have_passed_is_tried_again_after_a_pause(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("_sources", "_of", "_controllers"):
        monkeypatch.setattr(registry, name, type(getattr(registry, name))())
    monkeypatch.setattr(controller_files, "_find", controller_files.load_all)
    monkeypatch.setattr(registry, "ControllerProcess", Slow)
    clock = Clock()
    monkeypatch.setattr(registry, "time", clock)
    (tmp_path / "slow.py").touch()
    monkeypatch.setenv(controller_files.VARIABLE, str(tmp_path))
    assert registry.due() == "changed"
    registry.refresh(20.0)
    proxy_class = registry._controllers["slow"]
    for _ in range(2):
        clock.now += registry.TRY_AGAIN - 1
        assert registry.due() is None
        clock.now += 1
        assert registry.due() == "retry"
        registry.refresh(20.0)
        assert registry._controllers["slow"] is proxy_class, "what ends the same way makes nothing anew"
    (tmp_path / "slow.py").write_text("pass")
    assert registry.due() == "changed"


def test_it_has_what_a_package_names_by_an_entry_point(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "their_laws.py").write_text((ROOT / "examples" / "controllers" / "pid.py").read_text())
    (tmp_path / "their_laws-1.dist-info").mkdir()
    names = tmp_path / "their_laws-1.dist-info" / "entry_points.txt"
    names.write_text(f"[{controller_files.GROUP}]\nlaws = their_laws\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    with closing(ControllerProcess("entry point laws")) as host:
        assert host.call(os.path.basename, "/a/b", limit=60) == "b"


def test_a_process_that_does_not_start_is_not_said_to_be_a_law_that_does_not_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(controller_process, "STARTING", 0.0)
    with (
        closing(ControllerProcess("mine.py")) as host,
        pytest.raises(ControllerFileError, match=r"mine\.py: its process did not start within 0 s"),
    ):
        host.call(os.path.basename, "/a/b", limit=60)
