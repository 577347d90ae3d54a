"""The page speaks the server's language: its types are those of the OpenAPI document."""

import os
import subprocess
import sys
from pathlib import Path

from tests.browser.conftest import WEB


def test_the_types_are_current(built_page: Path) -> None:
    done = subprocess.run(
        ["node", "types.mjs", "--check"],
        cwd=WEB,
        env=os.environ | {"PYTHON": sys.executable},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
