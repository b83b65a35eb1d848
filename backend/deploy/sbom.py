"""Prints a bill of materials (CycloneDX 1.6, JSON) of the service: locked Python packages, and the page's libraries.

`python backend/deploy/sbom.py` reads both lock files; `make dist` puts what it prints into the wheel.
"""

import json
import re
from collections.abc import Iterator
from pathlib import Path

from cyclonedx.model import HashAlgorithm, HashType
from cyclonedx.model.bom import Bom
from cyclonedx.model.component import Component, ComponentType
from cyclonedx.output.json import JsonV1Dot6
from packageurl import PackageURL

ROOT = Path(__file__).parents[2]
PINNED = re.compile(r"^([A-Za-z0-9._-]+)==([^ ;\\]+)((?:[^\n]*\\\n)*[^\n]*)", re.MULTILINE)


def python_packages() -> Iterator[Component]:
    """What requirements.lock pins, with the hashes of its files."""
    for name, version, rest in PINNED.findall((ROOT / "requirements.lock").read_text()):
        hashes = [HashType(alg=HashAlgorithm.SHA_256, content=each) for each in re.findall(r"sha256:(\w+)", rest)]
        yield Component(name=name, version=version, purl=PackageURL("pypi", None, name, version), hashes=hashes)


def page_libraries() -> Iterator[Component]:
    """What the built page is made of, without what only builds it."""
    locked = json.loads((ROOT / "frontend" / "package-lock.json").read_text())["packages"]
    for path, package in locked.items():
        if path and not package.get("dev"):
            scope, _, name = path.rpartition("node_modules/")[2].rpartition("/")
            purl = PackageURL("npm", scope or None, name, package["version"])
            yield Component(name=name, group=scope or None, version=package["version"], purl=purl)


def main() -> None:
    """What the module's documentation says."""
    service = Component(name="ridelab-server", type=ComponentType.APPLICATION)
    bom = Bom(components=[*python_packages(), *page_libraries()])
    bom.metadata.component = service
    bom.register_dependency(service, bom.components)
    print(JsonV1Dot6(bom).output_as_string(indent=1))  # noqa: T201  # a command: what it prints is the bill


if __name__ == "__main__":
    main()
