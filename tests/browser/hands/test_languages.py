"""The page speaks the language of the browser, or the one that a person has chosen."""

import re
from functools import cache

import pytest
from playwright.sync_api import Page, expect
from tests.browser.access.axe import violations
from tests.browser.conftest import WEB, Open
from tests.browser.kit import Complaints, Learner, ask, begun_run, wait_for_heading
from tests.browser.test_narrow import PHONE, too_wide

from waypost_server.serving import Served

GERMAN = "de-DE"
QUESTIONS = {
    "inspect_full": "Ist die ganze Aufgabe gelöst?",
    "label_hi": "Welches Teilziel wäre in jedem Segment richtig gewesen?",
    "inspect_lo": "Versucht wurde „east“. Ist das gelungen?",
    "label_lo": "Versucht wurde „east“. Was wäre in jedem Schritt richtig gewesen?",
    "label_full": "Was wäre in jedem Schritt richtig gewesen?",
}
READ = """() => [...document.querySelectorAll('body *')].flatMap(one => [
    ...[...one.childNodes].filter(node => node.nodeType === Node.TEXT_NODE).map(node => node.textContent),
    ...['aria-label', 'title', 'placeholder', 'alt'].map(name => one.getAttribute(name) ?? ''),
]).map(text => text.trim().replace(/\\s+/g, ' '))"""


@cache
def only_english() -> frozenset[str]:
    """The texts of the catalogue that are other words in German."""
    catalogue = (WEB / "src" / "language" / "de.po").read_text().replace('"\n"', "")
    pairs = re.findall(r'^msgid "(.+)"\nmsgstr "(.+)"$', catalogue, re.MULTILINE)
    english, german = {one for one, _ in pairs}, {re.sub(r"</?\d/?>", "", other) for _, other in pairs}
    return frozenset(one.replace('\\"', '"') for one in english - german)


def english(page: Page) -> frozenset[str]:
    """The texts on the page that should be German; what a learner or the server wrote is in its own language."""
    return only_english() & set(page.evaluate(READ)) - {"learner"}  # the name of the learner's account


def check(page: Page) -> None:
    """The page is German, accessible, and fits a phone."""
    expect(page.locator("html")).to_have_attribute("lang", "de")
    assert english(page) == set()
    assert violations(page) == []
    page.set_viewport_size(PHONE)
    assert too_wide(page) == []
    page.set_viewport_size({"width": 1440, "height": 900})


def test_questions_are_answered_in_german(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("Labyrinth", budget=500.0)
    own = {"label_lo": {"question": "It tried “east”. What should it have done at each step?"}}
    learner.ask(run, *[ask(kind, ordinal=ordinal, **own.get(kind, {})) for ordinal, kind in enumerate(QUESTIONS)])
    page = open_page(f"/work?run={run}", role="admin", locale=GERMAN, motion="reduce")
    for kind, question in QUESTIONS.items():
        wait_for_heading(page, question)
        if kind.startswith("label"):
            page.keyboard.press("Enter")
            page.keyboard.press("2")
        check(page)
        page.keyboard.press("f" if "inspect" in kind else "Shift+Enter")
    wait_for_heading(page, "Gerade keine Frage")
    expect(page.get_by_text("heute: 5 Antworten")).to_be_visible()
    check(page)
    page.keyboard.press("?")
    expect(page.get_by_role("dialog", name="Tasten")).to_contain_text("Strg K")
    check(page)


def test_a_question_in_other_words_is_shown_as_its_learner_asks_it(open_page: Open, learner: Learner) -> None:
    run = learner.create_run("eigene Worte")
    learner.ask(run, ask("inspect_full", question="Is the cube in the box?"))
    page = open_page(f"/work?run={run}", locale=GERMAN)
    wait_for_heading(page, "Is the cube in the box?")


def test_runs_are_german_with_german_numbers_and_dates(open_page: Open, learner: Learner) -> None:
    run, page = begun_run(learner, open_page, "Labyrinth", 12_345.5, locale=GERMAN)
    page.goto(f"/runs/{run}")
    expect(page.get_by_text("von 12.345,5 Einheiten")).to_be_visible()
    chart = page.get_by_role("slider", name="Erfolg auf neuen Instanzen")
    expect(chart).to_have_attribute("aria-valuetext", re.compile("^Episode 2: Erfolg 66,7\N{NO-BREAK SPACE}%"))
    check(page)
    page.goto(f"/runs/{run}/ledger")
    row = page.get_by_role("row", name="Inspect_FULL")
    expect(row).to_contain_text(re.compile(r"\d\d\.\d\d\.\d{4}, \d\d:\d\d:\d\d"))
    check(page)
    row.get_by_role("link").click()
    page.get_by_role("heading", name="In den Buchungen").wait_for()
    check(page)
    for path, there in (
        ("/runs", page.get_by_role("row", name="Labyrinth").first),
        (f"/runs/{run}/queries", page.get_by_role("row", name="Inspect_FULL")),
        (f"/runs/{run}/review", page.get_by_role("heading", name="Übereinstimmung")),
        (f"/runs/{run}/gold", page.get_by_role("button", name="Als Gold markieren")),
        (f"/runs/compare?run={run}", page.get_by_role("slider").first),
    ):
        page.goto(path)
        there.wait_for()
        check(page)


def test_practice_and_people_are_german(open_page: Open, empty: Served) -> None:
    page = open_page("/practice", at=empty, role="admin", locale=GERMAN)
    page.get_by_role("heading", name="Übung").wait_for()
    check(page)
    page.keyboard.press("Enter")
    wait_for_heading(page, QUESTIONS["inspect_full"])
    page.keyboard.press("f")
    wait_for_heading(page, "Nicht richtig")
    expect(page.get_by_text("Die Aufgabe ist im letzten Zustand gelöst.")).to_be_visible()
    check(page)
    page.goto("/people")
    page.get_by_role("row").nth(1).get_by_role("link").click()
    page.get_by_role("heading", name="Rolle und Anmeldung").wait_for()
    check(page)
    page.goto("/people/audit")
    page.get_by_role("row", name="hat sich angemeldet").first.wait_for()
    check(page)


def test_worked_examples_are_german(open_page: Open, empty: Served) -> None:
    page = open_page("/practice?first=yes", at=empty, locale=GERMAN, motion="reduce")
    for _ in range(5):
        page.get_by_text("Gelöstes Beispiel").wait_for()
        check(page)
        page.keyboard.press("Enter")
        page.get_by_role("button", name="Überspringen", exact=True).wait_for()
        page.keyboard.press("Shift+S")
    while not page.get_by_role("heading", name="0 von 5 richtig").is_visible():
        for _ in range(6):
            page.keyboard.press("ArrowDown")
            check(page)
        page.keyboard.press("Enter")


def test_why_the_server_refuses_is_german(open_page: Open, learner: Learner, complaints: Complaints) -> None:
    complaints.expect("409")
    complaints.expect("401")
    run = learner.create_run("endet bald")
    learner.ask(run, ask("inspect_full"))
    page = open_page(f"/work?run={run}", locale=GERMAN)
    wait_for_heading(page, QUESTIONS["inspect_full"])
    learner.call("PATCH", f"/runs/{run}", {"state": "finished"})
    page.keyboard.press("f")
    refused = "Der Server hat diese Antwort nicht angenommen: Der Lauf ist beendet und mit ihm seine offenen Fragen."
    expect(page.get_by_text(refused)).to_be_visible()
    page.goto("/login#falsch")
    expect(page.get_by_text("Bitte prüfen, ob der ganze Link kopiert ist.")).to_be_visible()
    check(page)


def test_a_person_chooses_the_language_and_the_browser_remembers_it(open_page: Open, empty: Served) -> None:
    page = open_page("/me", at=empty, locale=GERMAN)
    choice = page.get_by_role("combobox", name="Sprache dieser Seite")
    expect(choice.get_by_role("option")).to_have_text(["wie im Browser: Deutsch", "English", "Deutsch"])
    check(page)
    choice.select_option("English")
    choice = page.get_by_role("combobox", name="Language of this page")
    expect(choice).to_have_value("en")
    expect(page.locator("html")).to_have_attribute("lang", "en")
    page.goto("/practice")
    expect(page.get_by_role("heading", name="Practice")).to_be_visible()
    page.goto("/me")
    choice.select_option("as in this browser: Deutsch")
    expect(page.get_by_role("heading", name="Sprache", exact=True)).to_be_visible()


@pytest.mark.parametrize(("locale", "loaded"), [("en-US", 0), ("fr-FR", 0), (GERMAN, 1)])
def test_who_reads_english_does_not_load_german(open_page: Open, locale: str, loaded: int) -> None:
    page = open_page("/login", role=None, locale=locale)
    requests: list[str] = []
    page.on("request", lambda request: requests.append(request.url))
    page.reload()
    heading = "Mit einem Link anmelden" if loaded else "Sign in with a link"
    expect(page.get_by_role("heading", name=heading)).to_be_visible()
    assert sum(".compiled" in address for address in requests) == loaded


def test_without_its_catalogue_the_page_is_english(open_page: Open, complaints: Complaints) -> None:
    complaints.expect("net::ERR_FAILED")
    page = open_page("/login", role=None, locale=GERMAN, intercepted=True)
    page.context.route("**/*.compiled*", lambda route: route.abort())
    page.reload()
    expect(page.get_by_role("heading", name="Sign in with a link")).to_be_visible()
    expect(page.locator("html")).to_have_attribute("lang", "en")
