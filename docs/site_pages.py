"""Adds to the documentation site what is not in docs/: the files at the top, the API's reference, and notebooks.

MkDocs calls these hooks (`mkdocs.yml`).
"""

import json
import posixpath
import re
from functools import cache
from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

from waypost_server.app import create_app
from waypost_server.http import reference

ROOT = Path(__file__).resolve().parents[1]

# Files of the repository outside docs/, and their addresses in the site.
OUTSIDE = {
    "ARCHITECTURE.md": "architecture.md",
    "CHANGELOG.md": "changelog.md",
    "CONTRIBUTING.md": "contributing.md",
    "bench/RESULTS.md": "benchmarks.md",
    "web/public/favicon.svg": "images/favicon.svg",
}
# The texts of the examples, the files that these texts link to, and the files to deploy keep their addresses.
KEPT = {"examples": ("*.md", "*.sh", "*/*.md", "*/*.py", "*/ask.ts", "*/results/*.[ps][nv]g"), "deploy": ("*",)}
OUTSIDE |= {
    name: name
    for folder, patterns in KEPT.items()
    for pattern in patterns
    for name in sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / folder).glob(pattern))
}
LINK = re.compile(r"(\]\()([^)\s#:]+)((?:#[^)\s]*)?\))")


def on_config(config: MkDocsConfig) -> None:
    """Replace a pattern in the nav, such as `decisions/0*.md`, by the pages that it matches."""

    def expanded(item: object) -> object:
        if isinstance(item, dict):
            return {title: expanded(below) for title, below in item.items()}
        if isinstance(item, list):
            return [one for below in item for one in (matches(below) if "*" in below else [expanded(below)])]
        return item

    def matches(pattern: str) -> list[str]:
        docs = Path(config.docs_dir)
        return [path.relative_to(docs).as_posix() for path in sorted(docs.glob(pattern))]

    config.nav = expanded(config.nav)


def on_files(files: Files, config: MkDocsConfig) -> None:
    """Add the pages and files that are not in docs/."""
    for path, address in OUTSIDE.items():
        files.append(File.generated(config, address, abs_src_path=str(ROOT / path)))
    files.append(File.generated(config, "openapi.json", content=json.dumps(openapi(), indent=2)))
    for notebook in [file for file in files if file.src_uri.endswith(".ipynb")]:
        page = notebook.src_uri.removesuffix(".ipynb") + ".md"
        files.append(File.generated(config, page, content=from_notebook(notebook.content_string)))


@cache
def openapi() -> reference.Json:
    """Return the OpenAPI document."""
    return create_app().openapi()


def on_page_markdown(markdown: str, page: Page, **_: object) -> str:
    """Write the reference of the API; rewrite links between docs/ and the files outside it to their addresses here."""
    here = page.file.src_uri
    if here == "rest-api.md":
        return reference.markdown(openapi()).replace("`/api/v1/openapi.json`", "[openapi.json](openapi.json)")
    source = next((path for path, address in OUTSIDE.items() if address == here), f"docs/{here}")

    def rewritten(match: re.Match[str]) -> str:
        target = posixpath.normpath(posixpath.join(posixpath.dirname(source), match[2]))
        address = OUTSIDE.get(target, target.removeprefix("docs/") if target.startswith("docs/") else None)
        if address is None:
            return match[0]
        return match[1] + posixpath.relpath(address, posixpath.dirname(here) or ".") + match[3]

    return LINK.sub(rewritten, markdown)


def from_notebook(text: str) -> str:
    """Return a notebook as Markdown: its texts, its code, and the outputs that are text or pictures."""
    parts = []
    for cell in json.loads(text)["cells"]:
        source = "".join(cell["source"])
        parts.append(source if cell["cell_type"] == "markdown" else f"```python\n{source}\n```")
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            if "image/png" in data:
                parts.append(f"![Output](data:image/png;base64,{''.join(data['image/png']).strip()})")
            elif shown := "".join(output.get("text", data.get("text/plain", []))):
                parts.append(f"```text\n{shown.rstrip()}\n```")
    return "\n\n".join(parts) + "\n"
