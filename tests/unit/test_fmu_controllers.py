"""FMUs as controllers: each drives like the same law in Python, and what is wrong with one is told in words."""

import os
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pythonfmu.builder import FmuBuilder

from backend.custom_controllers.description import described, proxy_class
from backend.fmu.archive import fmu
from backend.fmu.description import Version
from sim_core import Controller, RidelabError, Scenario, StrategyResult, check_controller, load_controllers, simulate
from sim_core.control.declared import Option
from sim_core.fmi import archive
from sim_core.strategies import STRATEGIES, reads
from tests import wording

SCENARIO = Scenario.model_validate(
    {
        "road": {"length": 30, "bump": {"start": 15, "width": 3, "height": 0.09}},
        "speed": {"target_speed_kmh": 30, "detection_distance": 12},
        "mpc": {"preview": "lookahead", "force_limit": 1500},
        "lqr": {"preview": "lookahead", "preview_horizon": 12},
    }
)
ROUNDING = 1e-9  # of a signal's largest value
SLAVE = """
from pythonfmu import Boolean, Fmi2Causality, Fmi2Slave, Fmi2Variability, Integer, Real


class Damper(Fmi2Slave):
    description = "Damps the body, a little harder in every stage, and more and more."

    def __init__(self, **values):
        super().__init__(**values)
        self.damping, self.harder, self.broken = 3000.0, 2, False
        self.stage, self.velocity, self.rate, self.steps = 0, 0.0, 0.0, 0
        self.force_front = self.force_rear = 0.0
        fixed = {"causality": Fmi2Causality.parameter, "variability": Fmi2Variability.fixed}
        self.register_variable(Real("damping", start=3000.0, description="Force per velocity", **fixed))
        self.register_variable(Integer("harder", start=2, **fixed))
        self.register_variable(Boolean("broken", start=False, **fixed))
        for name, attribute in (("state[5]", "velocity"), ("state[6]", "rate"), ("stage", "stage")):
            kind = Integer if name == "stage" else Real
            setter = lambda value, to=attribute: setattr(self, to, value)
            getter = lambda of=attribute: getattr(self, of)
            self.register_variable(kind(name, causality=Fmi2Causality.input, start=0, getter=getter, setter=setter))
        self.register_variable(Real("force_front", causality=Fmi2Causality.output))
        self.register_variable(Real("force_rear", causality=Fmi2Causality.output))

    def do_step(self, time, step):
        self.steps += 1
        damping = -self.damping * (1 + self.harder * self.stage / 10) * (1 + self.steps / 1000)
        self.force_front = damping * (self.velocity - 1.015 * self.rate)
        self.force_rear = damping * (self.velocity + 1.895 * self.rate)
        if self.broken and self.steps == 3:
            raise RuntimeError("the valve is stuck")
        return self.steps != 5 or self.damping > 0
"""


class Damper(Controller):
    id, label = "in_python", "In Python"

    def force(self, seen: Any) -> tuple[float, float]:
        stage = ("cruise", "brake", "bump").index(seen.stage)
        damping = -3000.0 * (1 + 2 * stage / 10) * (1 + (seen.step + 1) / 1000)
        velocity, rate = seen.state[4], seen.state[5]
        return damping * (velocity - 1.015 * rate), damping * (velocity + 1.895 * rate)


def same(ours: StrategyResult, theirs: StrategyResult) -> bool:
    return all(
        np.abs(theirs.series[key] - values).max() <= ROUNDING * np.abs(values).max()
        for key, values in ours.series.items()
    )


@pytest.fixture(scope="module")
def made_by_pythonfmu(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("slave")
    script = folder / "damper.py"
    script.write_text(SLAVE)
    return Path(FmuBuilder.build_FMU(script, dest=folder))


@pytest.fixture(scope="module")
def exported(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("lqr") / "theirs.fmu"
    file.write_bytes(fmu(SCENARIO, "lqr", "controller", "2.0", ["linux64"]))
    return file


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_our_exported_lqr_drives_like_ours(version: Version, tmp_path: Path) -> None:
    file = tmp_path / "My LQR.fmu"
    file.write_bytes(fmu(SCENARIO, "lqr", "controller", version, ["linux64"]))
    own = load_controllers(file)
    assert list(own) == ["my_lqr"]
    kind = own["my_lqr"]
    ours = simulate(SCENARIO, "lqr")
    assert same(ours, simulate(SCENARIO, kind))
    assert np.abs(ours.series["front_force"]).max() == 1500, "the limit was met"
    assert check_controller(kind, SCENARIO) == []
    asks_for = [each.for_scenario(SCENARIO) for each in (kind(), STRATEGIES["lqr"]())]
    assert len({(each.preview, each.preview_steps) for each in asks_for}) == 1
    assert all("mismatch" in reads(each) for each in (kind, proxy_class(described(kind))))
    limited = simulate(SCENARIO, kind(force_limit=300.0))
    assert np.abs(limited.series["front_force"]).max() == 300


def test_one_that_pythonfmu_made_drives_like_the_same_law_in_python(made_by_pythonfmu: Path) -> None:
    """It counts its steps: a run that began with another's instance would differ, which the check looks for too."""
    kind = load_controllers(made_by_pythonfmu)["damper"]
    options = {name: (each.default, each.unit) for name, each in kind.declared.items() if isinstance(each, Option)}
    assert options == {"damping": (3000.0, "1"), "harder": (2, "1"), "broken": (False, "1")}
    assert kind.description() == "Damps the body, a little harder in every stage, and more and more."
    assert same(simulate(SCENARIO, Damper), simulate(SCENARIO, kind))
    assert (kind.preview, kind.prediction_horizon) == ("none", 0), "it has no input of the road ahead"
    assert not {"mismatch", "mismatch.preview_gain"} & set(reads(kind))
    assert check_controller(kind) == []


def test_an_error_of_its_own_ends_the_run_with_words(made_by_pythonfmu: Path) -> None:
    kind = load_controllers(made_by_pythonfmu)["damper"]
    with pytest.raises(RidelabError, match=r"(?s)Damper: fmi2DoStep: it reports an error .*the valve is stuck"):
        simulate(SCENARIO, kind(broken=True))
    with pytest.raises(RidelabError, match="it discards the step"):
        simulate(SCENARIO, kind(damping=-1.0))


def test_another_sample_time_than_its_own_is_told(exported: Path) -> None:
    faster = SCENARIO.model_copy(update={"mpc": SCENARIO.mpc.model_copy(update={"sample_time": 0.005})})
    with pytest.raises(RidelabError, match=r"for control steps of 0\.01 s, the scenario has 0.005 s") as caught:
        simulate(faster, load_controllers(exported)["theirs"])
    assert caught.value.field == "mpc.sample_time"


def test_one_is_unpacked_where_the_operator_says_and_only_what_a_run_reads(
    exported: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(archive.FOLDER, str(tmp_path / "fmus"))
    monkeypatch.setattr(archive, "_NO_PROGRAMS", 0)
    file = tmp_path / "large.fmu"
    file.write_bytes(exported.read_bytes())
    with zipfile.ZipFile(file, "a") as packed:
        packed.writestr("binaries/win64/library.dll", bytes(100))
        packed.writestr("resources/table.csv", "1")
    _, folder, library = archive.unpack(file.read_bytes())
    assert {path.relative_to(folder).parts[0] for path in folder.rglob("*")} == {
        "modelDescription.xml",
        "binaries",
        "resources",
    }
    assert [path.name for path in (folder / "binaries").iterdir()] == ["linux64"]
    assert library.is_file()
    monkeypatch.setattr(archive, "_NO_PROGRAMS", os.statvfs(tmp_path).f_flag | 1)
    with pytest.raises(RidelabError, match=r"may be run \(noexec\): name another one in XDG_CACHE_HOME"):
        archive.unpack(file.read_bytes())


def rewritten(exported: Path, to: Path, *, old: str = "", new: str = "", **names: str) -> Path:
    """The same FMU with another text in its description, or other names of its files."""
    with zipfile.ZipFile(exported) as source, zipfile.ZipFile(to, "w") as target:
        for name in source.namelist():
            content = source.read(name)
            if name == "modelDescription.xml" and old:
                assert old.encode() in content
                content = content.replace(old.encode(), new.encode())
            target.writestr(next((names[each] for each in names if each in name), name), content)
    return to


@pytest.mark.parametrize("changed", wording.asked_in("fmus"), ids=str)
def test_a_description_or_files_that_do_not_fit_are_told(
    exported: Path, tmp_path: Path, changed: dict[str, str]
) -> None:
    with pytest.raises(RidelabError) as refused:
        load_controllers(rewritten(exported, tmp_path / "changed.fmu", **changed))
    wording.check("fmus", changed, str(refused.value).replace(str(tmp_path), "FOLDER"))


def test_one_that_would_fill_the_disk_is_not_unpacked(
    exported: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(archive, "MOST_BYTES", 20_000)
    with pytest.raises(RidelabError, match="It unpacks to more than"):
        load_controllers(rewritten(exported, tmp_path / "bomb.fmu"))


def test_an_unpacked_library_that_the_disk_changed_is_unpacked_again(exported: Path) -> None:
    library = archive.unpack(exported.read_bytes())[2]
    whole = library.read_bytes()
    changed = library.with_suffix(".new")  # the file in its place is in this process's memory
    changed.write_bytes(whole[:-9] + bytes([whole[-9] ^ 1]) + whole[-8:])
    changed.replace(library)
    assert archive.unpack(exported.read_bytes())[2].read_bytes() == whole


def test_what_is_no_zip_is_told(tmp_path: Path) -> None:
    file = tmp_path / "law.fmu"
    file.write_bytes(b"no zip")
    with pytest.raises(RidelabError, match="no zip"):
        load_controllers(file)


def test_an_fmu_that_makes_no_instance_says_why(exported: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(exported) as source:
        token = source.read("modelDescription.xml").decode().partition('guid="')[2].partition('"')[0]
    file = rewritten(exported, tmp_path / "other.fmu", old=token, new="{0}")
    said = check_controller(load_controllers(file)["other"])
    assert said == ["ridelab_lqr: the FMU made no instance (The GUID is that of another FMU)"]
