"""On a phone held upright, the rows that are being labeled are in sight, not behind the buttons at the foot."""

import pytest
from playwright.sync_api import expect
from tests.browser.conftest import Open
from tests.browser.kit import Json, Learner, ask, wait_for_heading

SEEN = """list => {
    const foot = document.querySelector('.act').getBoundingClientRect().top
    return Math.min(foot, list.getBoundingClientRect().bottom) - list.getBoundingClientRect().top
}"""  # the height of the part of a list above the foot
TALL, SHORT = {"width": 390, "height": 844}, {"width": 390, "height": 664}


@pytest.mark.parametrize(
    ("kind", "rows", "size", "least"),
    [
        ("label_hi", "Segments", TALL, 4 * 35),
        ("label_hi", "Segments", SHORT, 3 * 35),
        ("label_lo", "States", TALL, 1.2 * 52),
        ("label_lo", "States", SHORT, 48),
        ("label_full", "States", TALL, 2.2 * 52),
        ("label_full", "States", SHORT, 1.6 * 52),
    ],
)
def test_the_rows_are_in_sight(
    open_page: Open, learner: Learner, kind: str, rows: str, size: Json, least: float
) -> None:
    run = learner.create_run("rows")
    learner.ask(run, ask(kind))
    page = open_page(f"/work?run={run}", size=size, touch=True, motion="reduce")
    wait_for_heading(page, ask(kind)["question"])
    listed = page.get_by_role("list", name=rows)
    expect(listed).to_be_in_viewport()
    assert listed.evaluate(SEEN) >= least
    assert page.evaluate("scrollY") == 0
