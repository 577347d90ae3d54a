"""The search of a run's queries: it follows what one types."""

from playwright.sync_api import Page, Route, expect
from tests.browser.conftest import Open
from tests.browser.kit import Learner, ask


def opened(open_page: Open, learner: Learner) -> Page:
    """The queries of a run: three ask about a door, one asks about lava."""
    run = learner.create_run("searched")
    words = ["the left door", "the right door", "the last door", "the lava"]
    asks = [ask("inspect_full", episode, question=f"What of {one}?") for episode, one in enumerate(words)]
    learner.ask(run, *asks)
    page = open_page(f"/runs/{run}/queries", role="viewer", intercepted=True)
    expect(page.get_by_role("row")).to_have_count(5)
    return page


def hold_time(page: Page) -> None:
    """Let nothing that waits go on, until the clock is resumed."""
    page.clock.install()
    page.clock.pause_at(page.evaluate("Date.now() + 1000"))


def test_the_search_finds_while_one_types(open_page: Open, learner: Learner) -> None:
    page = opened(open_page, learner)
    box, found = page.get_by_role("searchbox", name="Find a query"), page.get_by_role("search").get_by_role("status")
    asked: list[str] = []
    page.on("request", lambda one: asked.append(one.url) if "text=" in one.url else None)
    hold_time(page)
    box.press_sequentially("door")
    assert asked == [], "no request while keys are pressed"
    page.clock.resume()
    expect(page.get_by_role("row")).to_have_count(4)
    expect(found).to_have_text("3 queries found")
    assert len({one for one in asked if "query-rows" in one}) == 1, "one search for all keys"
    box.press_sequentially(" le", delay=10)
    expect(found).to_have_text("1 query found")
    expect(box).to_have_value("door le")  # what is typed stays as it is
    box.fill("zzz")
    expect(found).to_have_text("No query found")
    expect(page.get_by_text("No queries match.")).to_be_visible()
    box.press("Escape")
    expect(box).to_have_value("")
    expect(page.get_by_role("row")).to_have_count(5)
    expect(found).to_have_text("")


def test_a_space_at_the_end_stays_while_one_thinks(open_page: Open, learner: Learner) -> None:
    page = opened(open_page, learner)
    box = page.get_by_role("searchbox", name="Find a query")
    box.press_sequentially("door ")
    expect(page.get_by_role("row")).to_have_count(4)
    box.press_sequentially("left")
    expect(page.get_by_role("row")).to_have_count(2)
    expect(box).to_have_value("door left")


def test_enter_searches_at_once_and_clear_empties_the_field(open_page: Open, learner: Learner) -> None:
    page = opened(open_page, learner)
    hold_time(page)
    box = page.get_by_role("searchbox", name="Find a query")
    box.fill("lava")
    box.press("Enter")
    expect(page.get_by_role("row")).to_have_count(2)
    page.clock.resume()
    page.get_by_role("link", name="Clear").click()
    expect(box).to_have_value("")
    expect(page.get_by_role("row")).to_have_count(5)


def test_an_older_reply_never_replaces_a_newer_one(open_page: Open, learner: Learner) -> None:
    page = opened(open_page, learner)
    held: list[Route] = []
    page.route("**/query-rows?*text=door*", lambda route: held.append(route))
    box = page.get_by_role("searchbox", name="Find a query")
    with page.expect_request("**/query-rows?*text=door*"):
        box.fill("door")
    box.fill("lava")
    expect(page.get_by_role("row")).to_have_count(2)
    with page.expect_response("**/query-rows?*text=door*"):
        for route in held:
            route.continue_()
    page.wait_for_timeout(200)
    expect(page.get_by_role("row")).to_have_count(2)
