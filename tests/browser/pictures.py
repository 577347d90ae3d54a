"""Every view of the page as a picture, light and dark, wide and narrow:
`python -m tests.browser.pictures docs/images --store runs.db` shows the runs of a store, of which a copy is served.

The questions are those of the tests. Without a store there is little to see of runs.
"""

import argparse
import io
import shutil
import tempfile
from collections.abc import Callable, Iterator
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass
from pathlib import Path

from PIL import Image
from playwright.sync_api import Page
from tests.browser import test_play, test_takeover
from tests.browser.conftest import MAZE, WEB, WIDE
from tests.browser.kit import Learner, ask, chromium, log_in, wait_for_heading

from waypost.client import Client
from waypost_learner.remote.stage import offer
from waypost_learner.remote.translation import Translator
from waypost_server import serving
from waypost_server.auth import tokens
from waypost_server.serving import Served
from waypost_server.settings import Settings
from waypost_server.users import service as users

SIZES = {
    "wide": WIDE,
    "narrow": {"width": 768, "height": 1024},
    "landscape": {"width": 844, "height": 390},  # a phone on its side
    "portrait": {"width": 390, "height": 844},  # a phone held upright
}
PHONES = ("landscape", "portrait")
USUAL = ("light", "wide")
LOOKS = ["light-wide", "dark-wide", "light-narrow", "dark-narrow", "light-landscape", "light-portrait"]
KINDS = ("inspect_full", "label_hi", "inspect_lo", "label_lo", "label_full")


def there_is_a_row(page: Page) -> None:
    """A table has come."""
    page.get_by_role("row").nth(1).wait_for()


def there_is_a_chart(page: Page) -> None:
    """A curve has been drawn."""
    page.get_by_role("slider").first.wait_for()


def there_is_a_heading(page: Page) -> None:
    """The view says what it is."""
    page.get_by_role("heading", level=1).wait_for()


@dataclass
class Gallery:
    """Takes pictures of a server's page in one scheme and size."""

    folder: Path
    served: Served
    learner: Learner
    page: Page
    suffix: str

    def take(self, name: str) -> None:
        """Keep what is on the screen."""
        self.page.wait_for_timeout(300)  # what moves has come to rest
        with Image.open(io.BytesIO(self.page.screenshot())) as picture:  # 256 colors are a third of the bytes
            picture.convert("RGB").quantize(256).save(self.folder / f"{name}{self.suffix}.png", optimize=True)

    def visit(self, name: str, path: str, ready: Callable[[Page], object]) -> None:
        """Go somewhere, and keep what is there when it is ready."""
        self.page.goto(path)
        ready(self.page)
        self.take(name)

    def questions(self) -> None:
        """The work view, each kind of question in turn, and its dialogs."""
        run = self.learner.create_run("maze-lean", budget=2_000.0)
        self.learner.ask(run, *[ask(kind, ordinal=ordinal) for ordinal, kind in enumerate(KINDS)])
        self.page.goto(f"/work?run={run}")
        for kind in KINDS:
            wait_for_heading(self.page, ask(kind)["question"])
            if kind.startswith("label"):
                self.page.keyboard.press("Enter")
                self.page.keyboard.press("2")
            self.take(kind.replace("_", "-"))
            if kind == "label_hi":
                for key, name in (("?", "keys"), ("Shift+S", "skip")):
                    self.page.keyboard.press(key)
                    self.page.get_by_role("dialog").wait_for()
                    self.take(name)
                    self.page.keyboard.press("Escape")
            self.page.keyboard.press("f" if "inspect" in kind else "Shift+Enter")
        wait_for_heading(self.page, "No question right now")
        self.take("waiting")
        self.learner.call("PATCH", f"/runs/{run}", {"state": "finished"})

    def demonstrations(self) -> None:
        """A demonstration under way, and one that goes on where a learner failed."""
        run = self.learner.create_run("maze-lean")
        with self._offered(self.learner.ask(run, test_play.ask())[0], MAZE):
            self.page.goto(f"/work?run={run}")
            test_play.is_here(self.page)
            test_play.way(self.page, test_play.WAY[:5])
            self.take("hier-demo")
        self.learner.call("PATCH", f"/runs/{run}", {"state": "finished"})
        run, query, translator = test_takeover.failed_in_a_maze(self.learner)
        with self._offered(query, translator):
            self.page.goto(f"/work?run={run}")
            test_takeover.is_here(self.page, "north")
            test_play.press(self.page, "n")
            test_play.walk(self.page, "u")
            self.take("play-on")
        self.learner.call("PATCH", f"/runs/{run}", {"state": "finished"})

    @contextmanager
    def _offered(self, query: int, translator: Translator) -> Iterator[None]:
        """Let the learner's environment take part in a demonstration."""
        user = self.served.db.write_now(lambda tx: users.ensure_user(tx, "learner", "learner"))
        token = self.served.db.write_now(lambda tx: tokens.create_token(tx, user.id, "stage")).token
        with closing(Client(self.served.url, token)) as client, ExitStack() as stack:
            stack.callback(offer(lambda: client.play(query), translator, client.upload))
            yield

    def runs(self, run: str, others: list[str]) -> None:
        """What is seen of runs: the list, one of them and its parts, several overlaid."""
        self.visit("runs", "/runs", there_is_a_row)
        self.visit("run", f"/runs/{run}", there_is_a_chart)
        self.visit("ledger", f"/runs/{run}/ledger", there_is_a_row)
        if others:
            self.visit("queries", f"/runs/{run}/queries?kind=label_hi", there_is_a_row)
            self.page.get_by_role("link", name="Label_HI").first.click()
            self.page.get_by_role("heading", name="In the ledger").wait_for()
            self.take("query")
            self.visit("review", f"/runs/{run}/review", there_is_a_heading)
            self.visit("overlay", f"/runs/compare?{'&'.join(f'run={one}' for one in others)}", there_is_a_chart)

    def practice(self) -> None:
        """Practice: the start, a worked example of the first practice, feedback, and a demonstration."""
        self.visit("practice", "/practice", there_is_a_heading)
        self.visit("practice-example", "/practice?first=yes", there_is_a_heading)
        self.page.keyboard.press("Enter")
        wait_for_heading(self.page, "Did it do the whole task?")
        self.page.keyboard.press("n")
        wait_for_heading(self.page, "Not right")
        self.take("practice-feedback")
        while not self.page.get_by_role("list", name="Moves").is_visible():
            asks = self.page.get_by_role("button", name="Skip", exact=True).is_visible()
            self.page.keyboard.press("Shift+S" if asks else "Enter")
        for _ in range(4):
            self.page.keyboard.press("ArrowDown")
        self.take("practice-demonstration")

    def people(self, run: str) -> None:
        """Accounts, an account, one's own, gold queries, and the way in."""
        self.visit("people", "/people", there_is_a_heading)
        self.page.get_by_role("link", name="learner").first.click()
        self.page.get_by_role("heading", level=1, name="learner").wait_for()
        self.take("person")
        self.visit("audit", "/people/audit", there_is_a_row)
        self.visit("me", "/me", there_is_a_heading)
        self.visit("gold", f"/runs/{run}/gold", there_is_a_heading)
        self.visit("login", "/login", there_is_a_heading)


def take_all(folder: Path, store: Path | None, looks: list[list[str]], only_work: bool) -> None:
    """Serve, and go through every view in every look: a scheme and a size."""
    folder.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as kept, ExitStack() as stack:
        database = Path(kept) / "waypost.db"
        if store is not None:
            shutil.copy(store, database)
        settings = Settings(database=f"sqlite:///{database}", page=WEB / "dist")
        served = stack.enter_context(serving.background(settings))
        learner = stack.enter_context(closing(Learner(served)))
        browser = stack.enter_context(chromium())
        there = learner.call("GET", "/runs?limit=200")["runs"]
        guided = [one["id"] for one in there if one["algorithm"] == "hg-dagger"]
        run = guided[0] if guided else learner.create_run()
        for scheme, size in looks:
            suffix = "".join(f"-{part}" for part in (scheme, size) if part not in USUAL)
            for name, role in (("bea", "annotator"), ("ada", "admin")):
                context = browser.new_context(base_url=served.url, viewport=SIZES[size], color_scheme=scheme)
                log_in(context, served, name, role)
                gallery = Gallery(folder, served, learner, context.new_page(), suffix)
                if role == "annotator":
                    gallery.questions()
                if role == "annotator" and size not in PHONES:
                    gallery.demonstrations()
                    gallery.practice()
                elif size not in PHONES and not only_work:
                    gallery.runs(run, [one["id"] for one in there])
                    gallery.people(run)
                context.close()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--store", type=Path, help="an SQLite store with runs to show")
    parser.add_argument("--looks", nargs="+", default=LOOKS, help=f"of scheme-size, such as: {' '.join(LOOKS)}")
    parser.add_argument("--only-work", action="store_true", help="only what annotators see: no store is needed")
    asked = parser.parse_args()
    take_all(asked.folder, asked.store, [look.split("-") for look in asked.looks], asked.only_work)
