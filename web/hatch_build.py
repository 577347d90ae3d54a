"""Adds the built web app to the wheel, as `waypost_server/static`. Hatchling calls this hook."""

import shutil
import subprocess
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class PageBuildHook(BuildHookInterface):
    """Builds the web app if it is not built. An editable install needs no hook, because it serves `web/dist`."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the web app if needed, and add it to the wheel."""
        if version == "editable" or self.target_name != "wheel":
            return
        web = Path(self.root) / "web"
        built = web / "dist"
        if not (built / "index.html").is_file():
            build_page(web)
        build_data["force_include"][str(built)] = "waypost_server/static"


def build_page(web: Path) -> None:
    """Build the web app with npm.

    Raises:
        RuntimeError: npm is missing or fails.
    """
    npm = shutil.which("npm")
    if npm is None:
        raise RuntimeError(
            "The web app is not built and npm is not on PATH. Install Node.js 20.19 or newer, "
            "or build web/dist elsewhere (npm ci && npm run build in web/) and copy it here."
        )
    for arguments in (["ci"], ["run", "build"]):
        done = subprocess.run([npm, *arguments], cwd=web, check=False)  # noqa: S603
        if done.returncode != 0:
            raise RuntimeError(f"`npm {' '.join(arguments)}` failed in {web}; see its output above.")
