"""Build hook: a wheel carries the built page as `server/static`."""

import shutil
import subprocess
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class PageBuildHook(BuildHookInterface[Any]):
    """Builds the page with npm when it has not been built; an editable install leaves that to `make web`."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Put web/dist into the wheel.

        Raises:
            RuntimeError: the page must be built and npm is not there.
        """
        if version == "editable":
            return
        web = Path(self.root) / "web"
        if not (web / "dist" / "index.html").exists():
            npm = shutil.which("npm")
            if npm is None:
                raise RuntimeError("npm is needed to build the page (Node 20.19 or newer), and it is not on the PATH")
            subprocess.run([npm, "ci"], cwd=web, check=True)
            subprocess.run([npm, "run", "build"], cwd=web, check=True)
        build_data["force_include"][str(web / "dist")] = "server/static"
