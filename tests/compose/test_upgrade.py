"""The image for one, by the manual's own command; and volumes of 0.4.0, each opened by this version during a batch."""

import re
import shlex
import shutil
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.compose.engine import PROJECT, Composed, Site, docker, inspect, running, stand_ins, volumes, wait
from tests.servers.process import ROOT

OLD_COMMIT, OLD_IMAGE = "899e0802", "ridelab:0.4.0"
MOST_BYTES = 850e6  # of the image
RUNS = 1500  # of a batch
PORT = "8062"
NAME = f"{PROJECT}-alone"


@pytest.fixture(scope="session")
def old(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A checkout of 0.4.0; its image is built where no `OLD_IMAGE` is there."""
    folder = tmp_path_factory.mktemp("old")
    archive = subprocess.run(["git", "archive", OLD_COMMIT], cwd=ROOT, capture_output=True, check=True).stdout
    subprocess.run(["tar", "--extract", "--directory", folder], input=archive, check=True)
    subprocess.run(["backend/deploy/secrets.sh"], cwd=folder, capture_output=True, check=True)
    compose = folder / "docker-compose.yml"
    compose.write_text(compose.read_text().replace("image: ridelab\n", f"image: {OLD_IMAGE}\n"))
    if not docker("images", "--quiet", OLD_IMAGE):
        Composed(folder, **stand_ins(folder)).compose("build", "api")
    return folder


@pytest.fixture
def alone() -> Iterator[None]:
    """Afterwards neither the container nor its volume is there."""
    yield
    docker("rm", "--force", NAME, check=False)
    docker("volume", "rm", NAME, check=False)


def start(image: str, *options: str) -> Site:
    """Start the image as the manual says, with that name, port and volume; return it when it is ready."""
    page = (ROOT / "docs/how-to/operations.md").read_text()
    (command,) = re.findall(r"^    docker (run .*?[^\\])$", page, re.MULTILINE | re.DOTALL)
    words = shlex.split(command.replace("\\\n", " "))
    here = {"ridelab": NAME, "ridelab:/data": f"{NAME}:/data", "127.0.0.1:8000:8000": f"127.0.0.1:{PORT}:8000"}
    if image == OLD_IMAGE:  # which does not know it
        del words[words.index("RIDELAB_ONE_USER=yes") - 1 :]
        words.append("ridelab")
    docker(*(here.get(word, word) for word in words[:-1]), *options, image)
    site = Site(f"http://127.0.0.1:{PORT}")
    took = wait(lambda: site.request("GET", "/readyz").status_code == 200, "it is ready", 60)
    print(f"\n{image} is ready {took:.1f} s later")
    return site


@pytest.mark.usefixtures("built", "alone")
def test_one_container_serves_everything(tmp_path: Path) -> None:
    layers = docker("history", "--format", "{{.Size}} {{.CreatedBy}}", "ridelab").splitlines()
    print("\n".join(layers[:6]))
    assert inspect("ridelab")["Size"] < MOST_BYTES
    (tmp_path / "controllers").mkdir()
    before = volumes()
    own = ("--volume", f"{tmp_path}/controllers:/controllers:ro", "--env", "RIDELAB_CONTROLLERS=/controllers")
    site = start("ridelab", *own, "--tmpfs", "/fmu:exec,mode=1777", "--env", "XDG_CACHE_HOME=/fmu")
    (line,) = [each for each in docker("logs", NAME).splitlines() if each.startswith("Ridelab is at")]
    assert line.startswith("Ridelab is at http://localhost:8000; its data are in /data"), line
    exported = site.request("POST", "/api/v1/fmus", json={"scenario": {}, "strategy": "lqr", "of": "controller"})
    theirs = tmp_path / "controllers/theirs.fmu"
    theirs.write_bytes(exported.content)
    theirs.chmod(0o644)
    wait(lambda: "theirs" in {each["id"] for each in site.ask("GET", "/strategies")}, "it is there", 30)
    run = site.run("lv", "lv_hil", "passive", "theirs")
    assert {each["status"] for each in run["strategies"].values()} == {"ok"}
    for path in ("/", "/manual/", "/api/v1/paper", f"/api/v1/runs/{run['id']}/report.html"):
        assert site.request("GET", path).status_code == 200, path
    assert site.request("POST", "/api/v1/controller/report", json={"scenario": {}}).status_code == 200
    slug = site.ask("POST", "/links", {"run_id": run["id"]})["slug"]
    assert [each["slug"] for each in site.ask("GET", "/links")["links"]] == [slug], "RIDELAB_ONE_USER"
    assert site.request("GET", "/", headers={"Host": "lab.example.com"}).status_code == 421
    site.assert_complete(site.batch(200), 200)
    docker("stop", NAME)
    assert inspect(NAME)["State"]["ExitCode"] == 0
    docker("rm", NAME)
    assert volumes() - before == {NAME}


def used(site: Site) -> tuple[str, str, str]:
    """Return a batch under way, a link and a run of before."""
    run = site.run("lv", "passive")["id"]
    slug = site.ask("POST", "/links", {"run_id": run})["slug"]
    batch = site.batch(RUNS)
    wait(lambda: site.progress(batch)["done"] > 20, "the batch begins", 120, 0.05)
    return batch, slug, run


def assert_kept(site: Site, batch: str, slug: str, run: str) -> None:
    site.assert_complete(batch, RUNS)
    assert site.ask("GET", f"/links/{slug}")["run"]["id"] == run
    assert set(site.ask("GET", f"/runs/{run}")["strategies"]) == {"lv", "passive"}


@pytest.mark.usefixtures("built", "alone", "old")
def test_a_volume_of_one_container_of_0_4_0_is_opened_during_a_batch() -> None:
    kept = used(start(OLD_IMAGE))
    docker("kill", NAME)
    docker("rm", NAME)
    assert_kept(start("ridelab"), *kept)


def test_a_composed_0_4_0_is_upgraded_during_a_batch(built: Composed, old: Path) -> None:
    """As the manual says: down, up. Its dump, restored, has what an old volume lacks."""
    shutil.copytree(built.folder / "secrets", old / "secrets", dirs_exist_ok=True)  # in one checkout they stay
    before = Composed(old)
    with running(built):
        before.up()
        kept = used(before)
        before.compose("down")
        begun = time.monotonic()
        built.up()
        print(f"\nupgraded in {time.monotonic() - begun:.1f} s")
        assert_kept(built, *kept)
        assert built.sql("show data_checksums") == ["off"], "an old volume stays as it is"
        (old / "dump").write_bytes(piped(built, "pg_dump", "-U", "ridelab", "-Fc", "ridelab"))
        built.compose("down")
        docker("volume", "rm", f"{PROJECT}_database")
        built.up("database")
        restore = ("pg_restore", "-U", "ridelab", "--clean", "--if-exists", "--single-transaction", "-d", "ridelab")
        piped(built, *restore, sent=(old / "dump").read_bytes())
        built.up()
        assert_kept(built, *kept)
        assert built.sql("select rolsuper from pg_roles where rolname = current_user") == ["f"]


def piped(site: Composed, *command: str, sent: bytes = b"") -> bytes:
    """Return what a program of the database's container prints of what it is sent."""
    words = ["docker", "compose", "exec", "-T", "database", *command]
    return subprocess.run(
        words, input=sent, capture_output=True, check=True, cwd=site.folder, env=site.variables
    ).stdout
