"""Who is refused reads why in the language of the page, with the role, the units or the field that it is about."""

from playwright.sync_api import Page, expect
from tests.browser.conftest import Open
from tests.browser.hands.test_languages import GERMAN, check
from tests.browser.kit import Complaints, Learner, ask

from waypost_server.serving import Served


def refused(page: Page, words: str) -> None:
    """The page says why, and all of it is German."""
    expect(page.get_by_role("alert")).to_have_text(words)
    check(page)


def test_a_refused_form_says_in_german_which_field_or_name_it_was(
    open_page: Open, empty: Served, complaints: Complaints
) -> None:
    complaints.expect("422")
    complaints.expect("409")
    page = open_page("/people", at=empty, role="admin", locale=GERMAN)
    name = page.get_by_role("textbox", name="Name")
    name.fill("   ")
    name.press("Enter")
    refused(page, "„Name“ ist leer.")
    name.fill(page.get_by_role("row").last.get_by_role("link").inner_text())
    name.press("Enter")
    refused(page, "Jemand hat diesen Namen schon. Bitte einen anderen wählen.")


def test_a_budget_that_is_too_low_is_refused_in_german_with_german_numbers(
    open_page: Open, learner: Learner, complaints: Complaints
) -> None:
    complaints.expect("409")
    run = learner.create_run("zu wenig", budget=500.0)
    learner.ask(run, ask("inspect_full"), ask("label_lo", ordinal=1))
    reserved = f"{learner.call('GET', f'/runs/{run}')['reserved']:g}".replace(".", ",")
    page = open_page(f"/runs/{run}", role="admin", locale=GERMAN)
    page.get_by_role("button", name="Ändern …").click()
    page.get_by_role("spinbutton", name="Einheiten").fill("0.5")
    page.get_by_role("button", name="Speichern").click()
    expect(page.get_by_role("alert")).to_contain_text(f"0 Einheiten sind ausgegeben und {reserved} für offene Anfragen")
    expect(page.get_by_role("alert")).to_contain_text(f"muss das Budget mindestens {reserved} betragen")
    check(page)


def test_who_changes_the_run_of_somebody_else_reads_in_german_whose_it_is(
    open_page: Open, learner: Learner, complaints: Complaints
) -> None:
    complaints.expect("403")
    page = open_page(f"/runs/{learner.create_run('fremd')}/gold", role="learner", locale=GERMAN)
    page.get_by_role("spinbutton").fill("5")
    page.keyboard.press("Enter")
    refused(page, "Dieser Lauf gehört learner. Nur wem er gehört und wer die Rolle Admin hat, darf ihn ändern.")
