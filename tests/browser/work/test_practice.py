"""The worked examples of the first practice show a learner's mistakes, and how a right answer corrects them."""

import re

import pytest
from playwright.sync_api import expect
from tests.browser.conftest import Open
from tests.browser.kit import Json

SIZES = [{"width": 1440, "height": 900}, {"width": 768, "height": 1024}, {"width": 390, "height": 844}]


@pytest.mark.parametrize("size", SIZES)
def test_every_worked_example_has_a_mistake(open_page: Open, size: Json) -> None:
    page = open_page("/practice?first=yes", size=size, motion="reduce")
    page.get_by_text("Worked example").wait_for()
    kinds = page.get_by_role("progressbar", name="Questions answered").get_attribute("max")
    for _ in range(int(kinds or 0)):  # those that runs on the server ask
        page.get_by_text("Worked example").wait_for()
        corrected = page.get_by_role("button", name=re.compile("no, it failed|instead of")).first
        expect(corrected).to_have_attribute("aria-current", "step")
        expect(corrected).to_be_in_viewport(ratio=0.9)
        page.keyboard.press("Enter")
        page.get_by_role("button", name="Skip").first.wait_for()
        page.keyboard.press("Shift+S")


def test_on_a_tablet_the_bar_is_in_the_window(open_page: Open) -> None:
    page = open_page("/practice?first=yes", size=SIZES[1])
    page.get_by_text("Worked example").wait_for()
    expect(page.get_by_role("button", name="Skip the practice")).to_be_in_viewport(ratio=1)
