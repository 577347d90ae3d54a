"""A login link opens the page once, and can lead to a run."""

from playwright.sync_api import expect
from tests.browser.conftest import Open
from tests.browser.kit import Complaints, Learner, ask, login_link, wait_for_heading

from waypost import wire
from waypost_server.serving import Served


def test_a_login_link_opens_once(open_page: Open, served: Served, complaints: Complaints) -> None:
    complaints.expect("401")
    link = login_link(served, "one-time", "viewer")
    page = open_page(link, role=None)
    page.get_by_role("heading", name="Runs").wait_for()
    assert "#" not in page.url
    used = open_page(link, role=None)
    expect(used.get_by_role("heading", name="This login link was used before")).to_be_visible()
    assert "#" not in used.url
    signed_out = open_page("/work", role=None)
    expect(signed_out.get_by_role("heading", name="You are not signed in")).to_be_visible()


def test_a_login_link_can_lead_to_a_run(open_page: Open, learner: Learner, served: Served) -> None:
    run = learner.create_run("led here")
    learner.ask(run, ask("inspect_full", question="The question of this run"))

    def link(role: wire.Role) -> str:
        return login_link(served, f"led {role}", role).replace("/login#", f"/login?run={run}#")

    page = open_page(link("viewer"), role=None)
    expect(page.get_by_role("heading", name="led here")).to_be_visible()
    page = open_page(link("annotator"), role=None)
    page.get_by_text("Worked example").wait_for()  # somebody new practices first
    page.keyboard.press("Escape")
    wait_for_heading(page, "The question of this run")
    page.goto(link("annotator"))
    expect(page.get_by_role("heading", name="led here")).to_be_visible()
