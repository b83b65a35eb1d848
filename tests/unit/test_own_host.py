"""The process that has a file of controllers, here one that an installed package names."""

import os
from contextlib import closing
from pathlib import Path

import pytest

from backend.own import host as host_module
from backend.own.host import Host
from sim_core import controller_files
from sim_core.controller_files import ControllerFileError
from tests.servers.process import ROOT


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
