#!/usr/bin/env python3
"""What the programs are made of, as CycloneDX 1.5 in JSON: every crate that is compiled into them for one platform.

    scripts/sbom.py [--platform TRIPLE] > sbom.cdx.json

The same commit gives the same bytes.
"""

import argparse
import hashlib
import json
import subprocess
import tomllib
import uuid
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROGRAMS = "dynabs-cli"


def metadata(platform):
    command = ["cargo", "metadata", "--format-version", "1", "--locked", "--filter-platform", platform]
    return json.loads(subprocess.run(command, cwd=ROOT, check=True, capture_output=True).stdout)


def linked(found):
    """The packages that the programs depend on to be built, and on which of them each depends."""
    nodes = {node["id"]: node for node in found["resolve"]["nodes"]}
    start = next(package["id"] for package in found["packages"] if package["name"] == PROGRAMS)
    needs, todo = {}, [start]
    while todo:
        name = todo.pop()
        if name in needs:
            continue
        deps = nodes[name]["deps"]
        needs[name] = sorted(
            dep["pkg"] for dep in deps if any(kind["kind"] != "dev" for kind in dep["dep_kinds"])
        )
        todo += needs[name]
    return start, needs


def url(package):
    return f"pkg:cargo/{package['name']}@{package['version']}"


def component(package, checksums, kind):
    shown = {
        "type": kind,
        "bom-ref": url(package),
        "name": package["name"],
        "version": package["version"],
        "purl": url(package),
    }
    if package.get("description"):
        shown["description"] = " ".join(package["description"].split())
    if package.get("license"):
        # What older crates write as A/B means A OR B.
        shown["licenses"] = [{"expression": package["license"].replace("/", " OR ")}]
    if checksum := checksums.get((package["name"], package["version"])):
        shown["hashes"] = [{"alg": "SHA-256", "content": checksum}]
    return shown


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--platform", default="x86_64-unknown-linux-musl")
    platform = parser.parse_args().platform
    lock = (ROOT / "Cargo.lock").read_bytes()
    checksums = {
        (package["name"], package["version"]): package.get("checksum")
        for package in tomllib.loads(lock.decode())["package"]
    }
    found = metadata(platform)
    packages = {package["id"]: package for package in found["packages"]}
    start, needs = linked(found)
    others = sorted((packages[name] for name in needs if name != start), key=url)
    serial = uuid.UUID(bytes=hashlib.sha256(lock + platform.encode()).digest()[:16], version=4)
    bom = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.5",
        "serialNumber": f"urn:uuid:{serial}",
        "version": 1,
        "metadata": {
            "component": component(packages[start], checksums, "application"),
            "properties": [{"name": "cargo:platform", "value": platform}],
        },
        "components": [component(package, checksums, "library") for package in others],
        "dependencies": sorted(
            (
                {"ref": url(packages[name]), "dependsOn": [url(packages[other]) for other in on]}
                for name, on in needs.items()
            ),
            key=lambda dependency: dependency["ref"],
        ),
    }
    print(json.dumps(bom, indent=2, ensure_ascii=False))


if __name__ == "__main__":
    main()
