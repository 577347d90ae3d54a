"""The reference of the API at /api/docs, under the content security policy of the web app."""

import re

import pytest
from playwright.sync_api import expect
from tests.browser.access.axe import violations
from tests.browser.conftest import WIDE, Open

PHONE = {"width": 390, "height": 844}


@pytest.mark.parametrize(("scheme", "size"), [("light", WIDE), ("dark", PHONE)], ids=["wide", "phone"])
def test_it_is_accessible_light_and_wide_and_dark_and_narrow(
    open_page: Open, scheme: str, size: dict[str, int]
) -> None:
    page = open_page("/api/docs", role=None, scheme=scheme, size=size)
    expect(page.get_by_role("heading", name="REST API")).to_be_visible()
    assert violations(page) == []
    assert page.evaluate("document.documentElement.scrollWidth") == size["width"]


def test_the_theme_is_the_system_s(open_page: Open) -> None:
    backgrounds = {
        scheme: open_page("/api/docs", role=None, scheme=scheme).evaluate(
            "getComputedStyle(document.documentElement).backgroundColor"
        )
        for scheme in ("light", "dark")
    }
    assert backgrounds == {"light": "rgb(246, 245, 241)", "dark": "rgb(20, 21, 24)"}


def test_the_keyboard_reaches_the_text_and_follows_links(open_page: Open) -> None:
    page = open_page("/api/docs", role=None)
    page.keyboard.press("Tab")
    expect(page.get_by_role("link", name="Skip the list of contents")).to_be_focused()
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    expect(page.get_by_role("main").get_by_role("link").first).to_be_focused()
    page.get_by_role("navigation").get_by_role("link", name="POST /api/v1/assignments", exact=True).focus()
    page.keyboard.press("Enter")
    expect(page.get_by_role("heading", name="POST /api/v1/assignments", exact=True)).to_be_in_viewport()
    page.get_by_role("main").get_by_role("link", name="Lease", exact=True).first.click()
    expect(page.get_by_role("heading", name="Lease", exact=True)).to_be_in_viewport()
    page.go_back()
    page.get_by_role("link", name="The OpenAPI document").click()
    expect(page).to_have_url(re.compile(r"/api/v1/openapi\.json$"))
