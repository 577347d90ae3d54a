"""What axe-core finds on the page: violations of WCAG 2.2 A and AA, and of its best practices."""

from typing import Any

from playwright.sync_api import Page
from tests.browser.conftest import WEB, WIDE

SCHEMES = ("light", "dark")
SIZES = (WIDE, {"width": 768, "height": 1024}, {"width": 390, "height": 844})
TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]
AXE = (WEB / "node_modules" / "axe-core" / "axe.min.js").read_text
SETTLED = "() => Promise.allSettled(document.getAnimations().map((one) => one.finished))"
RUN = "tags => axe.run({ runOnly: tags, resultTypes: ['violations'], preload: false })"


def violations(page: Page) -> list[Any]:
    """What axe finds on the page as it is, once nothing fades in any more."""
    page.evaluate(SETTLED)
    if not page.evaluate("'axe' in window"):
        page.evaluate(AXE())
    return [(one["id"], [node["html"] for node in one["nodes"]]) for one in page.evaluate(RUN, TAGS)["violations"]]


def violations_in_every_look(page: Page) -> list[Any]:
    """What axe finds light and dark, on a desktop, a tablet and a phone. The page is not loaded again."""
    found = []
    for scheme in SCHEMES:
        page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
        for size in SIZES:
            page.set_viewport_size(size)
            found += [(scheme, size["width"], *one) for one in violations(page)]
    page.set_viewport_size(WIDE)
    return found
