"""The images install locked packages: each with a version and hashes, and as pyproject.toml wants them."""

import re
import tomllib

import pytest
from packaging.requirements import Requirement
from tests.repository.kit import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())
EXTRAS = PROJECT["project"]["optional-dependencies"]
BASE = PROJECT["project"]["dependencies"] + EXTRAS["oidc"] + EXTRAS["telemetry"]
LEARNER = EXTRAS["learner"]
FILES = ("build", "server", "learner", "torch")
IMAGES = (ROOT / "Dockerfile").read_text().replace("\\\n", " ")


def locked(*files: str) -> dict[str, str]:
    """The version of each package."""
    lines = [line for file in files for line in (ROOT / "requirements" / f"{file}.txt").read_text().splitlines()]
    pins = [Requirement(line.rstrip(" \\")) for line in lines if not line.startswith(" ")]
    assert all(re.fullmatch(r"==[^*,]+", str(pin.specifier)) for pin in pins)
    return {pin.name: str(pin.specifier)[2:] for pin in pins}


@pytest.mark.parametrize("file", FILES)
def test_every_locked_package_has_hashes_and_nothing_says_where_it_came_from(file: str) -> None:
    blocks = re.split(r"\n(?=\S)", (ROOT / "requirements" / f"{file}.txt").read_text().strip())
    assert len(blocks) >= 1
    for block in blocks:
        pin, *hashes = block.replace(" \\", "").splitlines()
        assert re.fullmatch(r"[\w.-]+==\S+( ; .+)?", pin), pin
        assert hashes, f"{pin} has no hash"
        assert all(re.fullmatch(r"    --hash=sha256:[0-9a-f]{64}", one) for one in hashes), pin


@pytest.mark.parametrize(
    ("files", "wanted"),
    [
        (("build",), PROJECT["build-system"]["requires"]),
        (("server",), BASE),
        (("learner", "torch"), BASE + LEARNER),
    ],
)
def test_the_locks_are_what_the_project_needs(files: tuple[str, ...], wanted: list[str]) -> None:
    have = locked(*files)
    for one in map(Requirement, wanted):
        assert one.name in have, f"{one.name} is not locked: run scripts/lock"
        assert one.specifier.contains(have[one.name]), f"{one} is locked at {have[one.name]}: run scripts/lock"


def test_both_images_have_the_same_server() -> None:
    server, learner = locked("server"), locked("learner", "torch")
    assert {name: learner.get(name) for name in server} == server


def test_the_images_install_nothing_without_hashes_but_the_wheel_and_another_build_of_pytorch() -> None:
    installed = re.findall(r"pip (?:install|wheel) [^;&\n]*", IMAGES)
    unlocked = [one for one in installed if "--require-hashes -r requirements/" not in one]
    assert len(installed) == 8
    assert [one for one in unlocked if "/wheels" not in one and '--index-url "$TORCH_INDEX_URL"' not in one] == []
