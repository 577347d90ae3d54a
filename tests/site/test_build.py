"""The site: it builds without a warning, no link in it is dead, and it loads nothing from other sites."""

import json
import re
import shutil
import subprocess
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

import pytest
from tests.repository.kit import ROOT, tracked
from tests.site.blocks import PAGES

from waypost_server.app import create_app

LOADING = {("img", "src"), ("script", "src"), ("link", "href"), ("source", "src"), ("iframe", "src")}


def build(folder: Path, out: Path) -> subprocess.CompletedProcess[str]:
    """Build the site of a checkout."""
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(out)]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The built site."""
    out = tmp_path_factory.mktemp("site") / "site"
    done = build(ROOT, out)
    assert done.returncode == 0, done.stderr
    return out


class Read(HTMLParser):
    """The addresses and links of a page, and what it loads."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.ids: set[str] = set()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.feed(page.read_text())

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        self.ids |= {given[name] for name in ("id", "name") if name in given}
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        if tag == "link" and given.get("rel") in {"canonical", "next", "prev"}:
            return
        self.loaded += [given[name] for one, name in LOADING if one == tag and name in given]


@pytest.fixture(scope="session")
def pages(site: Path) -> dict[Path, Read]:
    """Every page of the site; not the one that a server would show instead of a missing page."""
    return {page: Read(page) for page in site.rglob("*.html") if page.name != "404.html"}


def test_every_link_in_the_site_leads_to_a_page_and_a_place_in_it(site: Path, pages: dict[Path, Read]) -> None:
    dead = []
    for page, read in pages.items():
        for link in {*read.links, *read.loaded}:
            parts = urlsplit(link)
            if parts.scheme or link.startswith("//"):
                continue
            target = (page.parent / unquote(parts.path)).resolve() if parts.path else page
            missing = parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].ids
            if missing or not target.is_file():
                dead.append(f"{page.relative_to(site)}: {link}")
    assert len(pages) > 40
    assert sum(len(read.links) for read in pages.values()) > 1_000
    assert dead == []


def test_no_page_loads_anything_from_another_site(site: Path, pages: dict[Path, Read]) -> None:
    elsewhere = {one for read in pages.values() for one in read.loaded if urlsplit(one).netloc}
    assert elsewhere == set()
    styles = [style.read_text() for style in site.rglob("*.css")]
    assert styles
    assert [
        found for text in styles for found in re.findall(r"(?:url\(|@import)\s*['\"]?(?:https?:)?//[^)]+", text)
    ] == []


def test_links_to_other_sites_are_well_formed_and_encrypted(pages: dict[Path, Read]) -> None:
    for read in pages.values():
        for link in read.links:
            parts = urlsplit(link)
            if parts.scheme:
                assert parts.scheme == "https", link
                assert re.fullmatch(r"[a-z0-9-]+(\.[a-z0-9-]+)+", parts.netloc), link


def test_every_document_but_the_readme_is_a_page(pages: dict[Path, Read], site: Path) -> None:
    titles = [re.search(r"<title>(.*?)</title>", page.read_text()) for page in pages]
    assert all(titles)
    other = {
        "ARCHITECTURE": "architecture",
        "CONTRIBUTING": "contributing",
        "CHANGELOG": "changelog",
        "RESULTS": "benchmarks",
    }
    for document in PAGES:
        if document != ROOT / "README.md":
            inside = document.relative_to(ROOT).with_suffix("")
            if "docs" in inside.parts:
                inside = inside.relative_to("docs")
            elif "examples" not in inside.parts:
                inside = Path(other[inside.name])
            address = inside.with_name("index") if inside.name == "README" else inside
            assert (site / address).with_suffix(".html") in pages, document


def test_the_openapi_document_is_published(site: Path) -> None:
    assert "POST /api/v1/assignments" in (site / "rest-api.html").read_text()
    assert json.loads((site / "openapi.json").read_text()) == json.loads(json.dumps(create_app().openapi()))


def test_the_reference_has_the_public_package_and_the_fields_of_messages(pages: dict[Path, Read], site: Path) -> None:
    assert {"waypost.Client", "waypost.Client.lease", "waypost.domains.Domain", "waypost.prices.cost"} <= pages[
        site / "python-api.html"
    ].ids
    assert {"waypost.wire.Lease", "waypost.wire.Lease.wait"} <= pages[site / "messages.html"].ids


# --- mistakes fail the build


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A copy of what the site is built from."""
    for path in tracked():
        name = path.relative_to(ROOT)
        if name.parts[0] in {"docs", "bench", "examples", "sdk", "web"} or len(name.parts) == 1:
            (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
            if path.suffix not in {".png", ".svg", ".gz"} or "favicon" in name.name:
                shutil.copyfile(path, tmp_path / name)
            else:
                (tmp_path / name).touch()
    return tmp_path


def test_mistakes_fail_the_build_which_names_each(checkout: Path) -> None:
    docs = checkout / "docs"
    (docs / "not-in-the-nav.md").write_text("# Forgotten\n")
    (docs / "theory.md").unlink()  # it is in the nav
    with (docs / "index.md").open("a") as page:
        page.write("\n[no page](no-such-page.md) [no place in a page](cli.md#no-such-place)\n")
    done = build(checkout, checkout / "built")
    assert done.returncode != 0
    lines = done.stderr.splitlines()
    for name, said in {
        "not-in-the-nav.md": 'not included in the "nav"',
        "theory.md": "is included in the 'nav'",
        "no-such-page.md": "the target is not found",
        "cli.md#no-such-place": "does not contain an anchor",
    }.items():
        assert [line for line in lines if name in line], f"{name}: {done.stderr}"
        assert said in done.stderr
