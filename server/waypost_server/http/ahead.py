"""What a page will need first, told in the header Link of its HTML: a browser loads it before a script asks for it."""

import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

_RUN = re.compile(r"runs/([0-9a-f]+)(?:/(?:queries|review|ledger))?")
_REQUESTS = ("", "/costs", "/curves?after=-1&most=1000")  # what web/src/runs/watched.svelte.ts requests
_CHUNKS = ("index.html", "src/app/RunsViews.svelte")


def ahead(root: Path, path: str, may_be_known: bool) -> str:
    """Return the header for a path; empty where nothing is worth it.

    Args:
        root: the folder of the built web app, with Vite's manifest.
        path: of the page, without a slash at its beginning.
        may_be_known: whether the browser may be signed in; otherwise it loads no data.
    """
    run = _RUN.fullmatch(path)
    if run is None:
        return ""
    data = ["/api/v1/me", *(f"/api/v1/runs/{run[1]}{request}" for request in _REQUESTS)]
    requests = [f"<{address}>; rel=preload; as=fetch; crossorigin" for address in data] if may_be_known else []
    return ", ".join([*_files(root), *requests])


@cache
def _files(root: Path) -> tuple[str, ...]:
    """Return the scripts and styles of the view, those that every view needs first."""
    manifest = root / "chunks.json"
    if not manifest.is_file():
        return ()
    chunks = json.loads(manifest.read_text())
    links = ["</theme.js>; rel=preload; as=script"]  # the first that index.html waits for
    for chunk in dict.fromkeys(chunk for first in _CHUNKS for chunk in _imported(chunks, first)):
        links.append(f"</{chunks[chunk]['file']}>; rel=modulepreload")
        links += [f"</{file}>; rel=preload; as=style; crossorigin" for file in chunks[chunk].get("css", [])]
    return tuple(links)


def _imported(chunks: dict[str, dict[str, list[str]]], name: str) -> Iterator[str]:
    """Yield a chunk and those that it imports at once."""
    if name in chunks:
        yield name
        for other in chunks[name].get("imports", []):
            yield from _imported(chunks, other)
