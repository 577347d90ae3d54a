"""On a server without a run, each role reads what to do next."""

import shlex

from playwright.sync_api import Page, expect
from tests.browser.conftest import Open
from tests.browser.kit import Complaints, login_link, wait_for_heading
from typer.testing import CliRunner

from waypost_learner.cli import app
from waypost_server.serving import Served


def expect_command(page: Page, served: Served) -> None:
    """The command to start a learner is there, names this server, and has only options that there are."""
    text = page.locator("pre").inner_text()
    assert text.splitlines()[0] == "waypost user add learner --role learner"
    train = shlex.split(text.splitlines()[1])
    train = train[train.index("train") :]
    assert train[-1] == served.url
    refused = CliRunner().invoke(app, [*train, "--no-such-option"])
    assert refused.exit_code == 2
    assert "No such option: --no-such-option" in refused.output


def test_an_experimenter_and_an_administrator_read_the_command(
    empty: Served, open_page: Open, complaints: Complaints
) -> None:
    complaints.expect("403")  # a learner's account does not answer
    page = open_page("/runs", role="learner", at=empty)
    expect_command(page, empty)
    page.goto("/work")
    wait_for_heading(page, "This account cannot answer questions")
    page.get_by_role("link", name="watch the runs").click()
    expect_command(page, empty)
    page = open_page("/work", role="admin", at=empty)
    expect_command(page, empty)


def test_an_annotator_practices_and_is_not_told_a_command(empty: Served, open_page: Open) -> None:
    page = open_page(login_link(empty, "first here", "annotator"), role=None, at=empty)
    page.get_by_text("Worked example").wait_for()
    page.keyboard.press("Escape")
    wait_for_heading(page, "No question right now")
    expect(page.get_by_text("The person who runs this server starts one.")).to_be_visible()
    expect(page.locator("pre")).to_have_count(0)
    page.get_by_role("link", name="Practice meanwhile").click()
    wait_for_heading(page, "Practice")
    page.keyboard.press("Enter")
    wait_for_heading(page, "Did it do the whole task?")
