"""Hatchling hook: puts the built page into the wheel, as `waypost_server/static`."""

import shutil
import subprocess
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class PageBuildHook(BuildHookInterface):
    """Builds the page if it is not built; an editable install serves `web/dist` and needs nothing."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Build the page and have the wheel include it."""
        if version == "editable" or self.target_name != "wheel":
            return
        web = Path(self.root) / "web"
        built = web / "dist"
        if not (built / "index.html").is_file():
            build_page(web)
        build_data["force_include"][str(built)] = "waypost_server/static"


def build_page(web: Path) -> None:
    """Run npm.

    Raises:
        RuntimeError: if there is no npm, or it fails.
    """
    npm = shutil.which("npm")
    if npm is None:
        raise RuntimeError(
            "Waypost's page is not built and npm is not on PATH. Install Node.js 20.19 or newer, "
            "or build web/dist elsewhere (npm ci && npm run build in web/) and copy it here."
        )
    for arguments in (["ci"], ["run", "build"]):
        done = subprocess.run([npm, *arguments], cwd=web, check=False)  # noqa: S603
        if done.returncode != 0:
            raise RuntimeError(f"`npm {' '.join(arguments)}` failed in {web}; its output above says why.")
