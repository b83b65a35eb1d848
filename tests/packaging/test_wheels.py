"""What the wheels hold: each is installed by itself in an environment with its dependencies alone."""

import io
import json
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from zipfile import ZipFile

import httpx
import pytest
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator

from sim_core.strategies import STRATEGIES
from tests.packaging.environments import ROOT, Environment, built
from tests.servers.process import HANG_TIMEOUT, wait_until

PINNED = re.compile(r"^(\S+)==(\S+)", re.MULTILINE)
TYPED = """
from sim_core import Bump, Controller, Mpc, Road, Scenario, Seen, option, simulate

class BodyDamper(Controller):
    "Damps the body's vertical motion."
    id, label = "body_damper", "Body damper"
    damping: float = option(2000.0, unit="N s/m", ge=0, le=20_000, help="Force per body velocity.")

    def force(self, seen: Seen) -> tuple[float, float]:
        each = -self.damping * float(seen.state[4]) / 2
        return each, each

scenario = Scenario(road=Road(length=60, bump=Bump(start=30)), mpc=Mpc(force_limit=2000))
peak: float = simulate(scenario, BodyDamper).metrics["bump"]["body_acceleration"]["peak"]
"""


@pytest.fixture(scope="module")
def wheels(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    return built(tmp_path_factory.mktemp("wheels"))


@pytest.fixture(scope="module")
def core(wheels: dict[str, Path], tmp_path_factory: pytest.TempPathFactory) -> Environment:
    return Environment(tmp_path_factory.mktemp("core"), [wheels["ridelab-core"]])


@pytest.fixture(scope="module")
def client(wheels: dict[str, Path], tmp_path_factory: pytest.TempPathFactory) -> Environment:
    return Environment(tmp_path_factory.mktemp("client"), [wheels["ridelab"]])


@pytest.fixture(scope="module")
def server(wheels: dict[str, Path], tmp_path_factory: pytest.TempPathFactory) -> Environment:
    return Environment(tmp_path_factory.mktemp("server"), wheels.values())


@pytest.fixture(scope="module")
def address(server: Environment, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """A service that the installed `ridelab serve` runs."""
    folder = tmp_path_factory.mktemp("service")
    log = folder / "log"
    with log.open("wb") as out:
        command = [server.program("ridelab"), "serve", "--port", "0"]
        process = subprocess.Popen(command, cwd=folder, env=server.variables(), stdout=out, stderr=out)
    wait_until(lambda: "Ridelab is at " in log.read_text() or process.poll() is not None, "it serves")
    announced = re.search(r"Ridelab is at (\S+)\n", log.read_text())
    assert announced is not None, log.read_text()
    yield announced[1]
    process.terminate()
    assert process.wait(HANG_TIMEOUT) is not None


def test_each_distribution_is_typed_and_only_the_cores_belongs_to_a_platform(wheels: dict[str, Path]) -> None:
    for name, package in (("ridelab-core", "sim_core"), ("ridelab", "ridelab"), ("ridelab-server", "backend")):
        wheel = ZipFile(wheels[name])
        files = wheel.namelist()
        assert f"{package}/py.typed" in files
        assert {file.split("/")[0] for file in files if ".dist-info/" not in file} == {package}
        assert f"{package}/setup.py" not in files, "what builds it is no part of it"
        (licence,) = [file for file in files if file.endswith(".dist-info/licenses/LICENSE")]
        assert wheel.read(licence) == (ROOT / "LICENSE").read_bytes()
    programs = {file.name for file in (ROOT / "backend/fmu/binaries/linux64").iterdir()}
    assert programs == {Path(each).name for each in ZipFile(wheels["ridelab-server"]).namelist() if "/linux64/" in each}
    tags = {name: path.stem.split("-")[2:] for name, path in wheels.items()}
    assert tags["ridelab"] == tags["ridelab-server"] == ["py3", "none", "any"]
    assert tags["ridelab-core"][:2] == ["py3", "none"], "its library needs no Python headers"
    assert tags["ridelab-core"][2] != "any"


def test_the_servers_wheel_says_what_it_is_made_of(wheels: dict[str, Path]) -> None:
    wheel = ZipFile(wheels["ridelab-server"])
    (bill,) = [file for file in wheel.namelist() if file.endswith(".dist-info/sboms/sbom.cdx.json")]
    content = wheel.read(bill).decode()
    assert JsonStrictValidator(SchemaVersion.V1_6).validate_str(content) is None
    components = {each["purl"]: each for each in json.loads(content)["components"]}
    pinned = {f"pkg:pypi/{name}@{number}" for name, number in PINNED.findall((ROOT / "requirements.lock").read_text())}
    assert pinned == {purl for purl in components if purl.startswith("pkg:pypi/")}
    assert all(each["hashes"] for purl, each in components.items() if purl in pinned)
    assert {purl.rsplit("@")[0] for purl in components} > {"pkg:npm/react", "pkg:pypi/fastapi"}


@pytest.mark.thorough
def test_the_core_alone_simulates(core: Environment) -> None:
    declared = {"numpy", "scipy", "osqp", "scikit-fuzzy", "pydantic", "cachetools", "threadpoolctl"}
    assert declared < core.packages
    web = {"fastapi", "starlette", "uvicorn", "httpx", "SQLAlchemy", "psycopg", "distributed", "orjson", "ridelab"}
    assert not web & core.packages
    script = """
from sim_core.scenario import Mpc, Scenario
from sim_core.simulate import simulate
from sim_core.strategies import STRATEGIES

osqp = Scenario(mpc=Mpc(solver="osqp", force_limit=2000))
for scenario, names in (Scenario(), STRATEGIES), (osqp, ["lv"]):
    for name in names:
        print(name, simulate(scenario, name).metrics["bump"]["body_acceleration"]["peak"].hex())
"""
    run = core.run("python", "-c", script)
    here = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert (run.returncode, run.stderr) == (0, "")
    assert run.stdout == here.stdout, "the same numbers as from the sources"
    assert len(run.stdout.splitlines()) == len(STRATEGIES) + 1


@pytest.mark.thorough
def test_a_program_that_uses_the_core_is_type_checked_without_plugins(core: Environment, tmp_path: Path) -> None:
    (tmp_path / "right.py").write_text(TYPED)
    (tmp_path / "wrong.py").write_text(f"{TYPED}Scenario(rod=Road())\nsimulate(scenario, 3)\n")
    words = ["-m", "mypy", "--strict", "--config-file=", "--python-executable", core.program("python")]
    check = [sys.executable, *words, "right.py", "wrong.py"]
    *errors, _ = subprocess.run(check, capture_output=True, text=True, check=False, cwd=tmp_path).stdout.splitlines()
    assert [error.rpartition("[")[2] for error in errors] == ["call-arg]", "arg-type]"], errors
    assert all(error.startswith("wrong.py:") for error in errors)


@pytest.mark.thorough
def test_client_and_core_run_check_and_play_without_a_server(
    wheels: dict[str, Path], tmp_path_factory: pytest.TempPathFactory
) -> None:
    local = Environment(tmp_path_factory.mktemp("local"), [wheels["ridelab-core"], wheels["ridelab"]])
    before = {path.name for path in local.file(".").iterdir()}
    run = local.run("ridelab", "run", "bump_only", "--strategy", "passive", "--json")
    assert json.loads(run.stdout)["strategies"]["passive"]["status"] == "ok", run.stderr
    wrong = local.run("ridelab", "run", "--set", "road.bump.hight=0.1", "--strategy", "passive")
    assert (wrong.returncode, wrong.stderr.split(":")[0]) == (2, "road.bump.hight")
    assert {path.name for path in local.file(".").iterdir()} == before, "no data, no cache"
    assert list(json.loads(local.run("ridelab", "demo", "--json").stdout)) == ["lv", "lqr", "passive"]


def test_the_client_alone_is_small_and_asks_a_service(client: Environment, address: str) -> None:
    packages = "httpx, typer, numpy, pandas, scipy, fastapi, sim_core, backend"
    code = f"import importlib.util; print([n for n in '{packages}'.split(', ') if importlib.util.find_spec(n)])"
    assert client.run("python", "-c", code).stdout == "['httpx', 'typer']\n"
    assert "Usage: ridelab" in client.run("ridelab", "--help").stdout
    run = client.run("ridelab", "run", "--strategy", "passive", "--json", RIDELAB_SERVER=address)
    assert json.loads(run.stdout)["strategies"]["passive"]["status"] == "ok", run.stderr
    script = f"from ridelab import Ridelab\nprint(Ridelab('{address}').run({{}}, ['passive'])['passive'].status)"
    assert client.run("python", "-c", script).stdout == "ok\n"


@pytest.mark.parametrize(("words", "missing"), [("serve", "server"), ("demo", "core")])
def test_what_needs_more_says_what_to_install(client: Environment, words: str, missing: str) -> None:
    run = client.run("ridelab", words)
    assert (run.returncode, run.stdout) == (3, "")
    assert run.stderr.startswith(f"Ridelab's {missing} is not installed here: `pip install`")


def test_the_servers_wheel_has_its_pages_the_manual_the_ecus_sources_and_the_reports_templates(address: str) -> None:
    def get(path: str) -> httpx.Response:
        return httpx.get(address + path, timeout=HANG_TIMEOUT).raise_for_status()

    named = [name for path in ("/", "/docs") for name in re.findall(r'(?:src|href)="(/[^/"][^"]*)"', get(path).text)]
    assert len(named) >= 4
    for path in (*named, "/manual/", "/manual/reference/scenario/", "/manual/search.json"):
        assert get(path).content, path
    body = {"scenario": {"road": {"length": 40, "bump": {"start": 20}}}, "strategies": ["lv_hil", "passive"]}
    run = httpx.post(f"{address}/api/v1/runs", json=body, timeout=HANG_TIMEOUT).json()
    assert run["strategies"]["lv_hil"]["status"] == "ok", run
    sources = httpx.post(f"{address}/api/v1/controller", json={"scenario": body["scenario"]}, timeout=HANG_TIMEOUT)
    assert (sources.status_code, sources.content[:2]) == (200, b"PK")
    fmu = httpx.post(f"{address}/api/v1/fmus", json={"of": "vehicle"}, timeout=HANG_TIMEOUT).raise_for_status()
    assert "binaries/linux64/ridelab_vehicle.so" in ZipFile(io.BytesIO(fmu.content)).namelist()
    assert get(f"/api/v1/runs/{run['id']}/report.html").text


@pytest.mark.thorough
def test_the_servers_command_line_starts_its_own_service(server: Environment) -> None:
    run = server.run("ridelab", "run", "bump_only", "--strategy", "passive", "--roads", "2")
    assert run.returncode == 0, run.stderr
    assert "\nrun " in run.stdout
    assert server.file("data-home/ridelab/ridelab.sqlite").exists(), "not in the folder one is in"
    copy = server.run("ridelab", "backup", "copy.sqlite")
    assert copy.stdout.startswith("copy.sqlite: "), copy.stderr


@pytest.mark.thorough
def test_without_its_extras_the_server_says_what_to_install(server: Environment, address: str) -> None:
    assert not {"distributed", "dask", "pyarrow"} & server.packages
    run = server.run("ridelab", "serve", "--port", "0", RIDELAB_DASK_SCHEDULER="tcp://127.0.0.1:8786")
    assert run.returncode == 2
    assert "RIDELAB_DASK_SCHEDULER needs Dask: pip install distributed" in run.stderr
    grid = {"strategies": ["passive"], "sweep": {"grid": {"road.seed": [1, 2]}}}
    batch = httpx.post(f"{address}/api/v1/batches", json=grid, timeout=HANG_TIMEOUT).json()["id"]
    export = server.run("ridelab", "export", batch, "--out", "rows.parquet", RIDELAB_SERVER=address)
    assert export.returncode == 2
    assert "pip install pyarrow" in " ".join(export.stderr.split())
