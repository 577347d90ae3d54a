import re
import subprocess

import pytest
from tests.repository.kit import ROOT, name_of, tracked

# Written in parts, so that this file does not hold what it looks for.
REGISTRIES = [
    "pypi" + ".org",
    "pythonhosted" + ".org",
    "npmjs" + ".org",
    "download.pytorch" + ".org",
    "crates" + ".io",
    "docker" + ".io/",
]
MACHINE_PATH = re.compile(r"(?:^|[\s\"'`=(:,])/" + r"(?:work/(?:main|shared)|root|home/\w+|Users/\w+)\b")


def test_no_file_names_a_package_registry_or_a_path_of_one_machine():
    at_fault = []
    for path in tracked():
        try:
            text = path.read_text()
        except UnicodeDecodeError:
            continue
        at_fault += [f"{name_of(path)}: {host}" for host in REGISTRIES if host in text]
        at_fault += [f"{name_of(path)}: {found[0].strip()}" for found in MACHINE_PATH.finditer(text)]
    assert at_fault == []


def test_no_source_file_is_ignored_by_git():
    folders = ["sdk", "server", "learner", "web/src", "web/public", "tests", "docs", "bench", "scripts", "examples"]
    ask = ["git", "ls-files", "--others", "--ignored", "--exclude-standard", *folders]
    listed = subprocess.run(ask, cwd=ROOT, capture_output=True, text=True, check=False).stdout.split()
    built = ("server/waypost_server/static/", "web/src/language/.wuchale/", "web/src/language/data.js")
    assert [name for name in listed if "__pycache__" not in name and not name.startswith(built)] == []


@pytest.mark.parametrize(
    "name",
    ["LICENSE", "README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md", "Makefile", ".ci/run", "Dockerfile"],
)
def test_what_a_reader_expects_at_the_top_is_there(name):
    assert (ROOT / name).is_file()


def test_the_license_is_the_one_the_package_declares():
    assert 'license = "MIT"' in (ROOT / "pyproject.toml").read_text()
    assert (ROOT / "LICENSE").read_text().startswith("MIT License")


def test_scripts_can_be_run_and_are_plain_shell():
    for path in (*(ROOT / "scripts").iterdir(), ROOT / ".ci" / "run"):
        assert path.stat().st_mode & 0o111, name_of(path)
        assert path.read_text().startswith(("#!/bin/sh\n", "#!/usr/bin/env bash\n")), name_of(path)


def test_the_lock_file_of_the_page_says_nothing_of_where_packages_came_from():
    assert '"resolved"' not in (ROOT / "web" / "package-lock.json").read_text()
