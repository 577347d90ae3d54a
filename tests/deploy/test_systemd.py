"""The unit for systemd is valid, and leaves the server few rights."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

FILE = Path(__file__).resolve().parents[2] / "deploy" / "waypost.service"


@pytest.fixture
def unit(tmp_path: Path) -> Path:
    """The unit, with a program that exists on this machine."""
    if shutil.which("systemd-analyze") is None:
        pytest.skip("no systemd-analyze on this machine")
    text = FILE.read_text()
    assert "ExecStart=/opt/waypost/bin/waypost serve\n" in text
    copy = tmp_path / FILE.name
    copy.write_text(text.replace("/opt/waypost/bin/waypost", sys.executable))
    return copy


def analyze(*arguments: str) -> None:
    done = subprocess.run(["systemd-analyze", *arguments], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, ""), done.stdout + done.stderr


def test_it_is_valid(unit: Path) -> None:
    analyze("verify", "--man=no", "--recursive-errors=no", str(unit))


def test_what_it_allows_is_rated_as_safe(unit: Path) -> None:
    analyze("security", "--offline=true", "--no-pager", "--threshold=25", str(unit))  # 2.5 of 10
