"""A real browser against a real server with the built page."""

import subprocess
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from itertools import count
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect
from tests.browser.kit import Complaints, Learner, chromium, log_in, maze

from waypost import wire
from waypost.client import Client
from waypost_learner.domains.maze.domain import MazeDomain
from waypost_learner.domains.maze.maze import Maze
from waypost_learner.remote.stage import offer
from waypost_learner.remote.translation import Translator
from waypost_server import serving
from waypost_server.auth import tokens
from waypost_server.serving import Served
from waypost_server.settings import Settings
from waypost_server.users import service as users

WEB = Path(__file__).resolve().parents[2] / "web"
WIDE = {"width": 1440, "height": 900}
_numbers = count()
expect.set_options(timeout=15_000)  # a busy machine is not a broken page

Open = Callable[..., Page]
Stage = Callable[..., Callable[[], None]]
MAZE = Translator(MazeDomain(), Maze.from_json(maze()))


@pytest.fixture(scope="session")
def built_page() -> Path:
    """The page, built if it is missing or older than its sources."""
    built = WEB / "dist" / "index.html"
    written = (".wuchale", "data.js")  # by the build
    files = [*WEB.glob("src/**/*"), *WEB.glob("public/*"), WEB / "index.html", WEB / "package.json"]
    sources = [file for file in files if file.is_file() and not any(name in file.parts for name in written)]
    if not built.is_file() or built.stat().st_mtime < max(source.stat().st_mtime for source in sources):
        if not (WEB / "node_modules").is_dir():
            subprocess.run(["npm", "ci"], cwd=WEB, check=True)
        subprocess.run(["npm", "run", "build"], cwd=WEB, check=True)
    return built.parent


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Chromium.

    Not for the session: while Playwright runs, this thread has an event loop, and other tests bring their own.
    """
    with chromium() as browser:
        yield browser


@pytest.fixture(scope="session")
def served(built_page: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    """A server for all tests; each test works on its own run."""
    store = tmp_path_factory.mktemp("store") / "waypost.db"
    with serving.background(Settings(database=f"sqlite:///{store}", page=built_page)) as served:
        yield served


@pytest.fixture
def empty(built_page: Path, tmp_path: Path) -> Iterator[Served]:
    """A server without a run."""
    settings = Settings(database=f"sqlite:///{tmp_path / 'empty.db'}", page=built_page)
    with serving.background(settings) as served:
        yield served


@pytest.fixture
def learner(served: Served) -> Iterator[Learner]:
    """The learner's side."""
    learner = Learner(served)
    yield learner
    learner.close()


@pytest.fixture
def complaints() -> Iterator[Complaints]:
    """What the browser complains of; a test fails if it did not expect it."""
    complaints = Complaints()
    yield complaints
    complaints.check()


@pytest.fixture
def open_page(browser: Browser, served: Served, complaints: Complaints) -> Iterator[Open]:
    """Open an address as a new person in a fresh browser context."""
    contexts = []

    def open_(
        path: str,
        role: wire.Role | None = "annotator",
        at: Served | None = None,
        scheme: str = "light",
        size: dict[str, int] = WIDE,
        motion: str = "no-preference",
        intercepted: bool = False,
        touch: bool = False,
        locale: str = "en-US",
    ) -> Page:
        server = at or served
        context = browser.new_context(
            base_url=server.url,
            viewport=size,
            color_scheme=scheme,
            reduced_motion=motion,
            has_touch=touch,
            is_mobile=touch,
            locale=locale,
        )
        context.set_default_timeout(15_000)
        contexts.append(context)
        if intercepted:  # from the start: a route added later may miss the very next request
            context.route("**/nothing", lambda route: route.abort())
        page = context.new_page()
        complaints.listen(page)
        if role is not None:
            log_in(context, server, f"person-{next(_numbers)}", role)
        page.goto(path)
        return page

    yield open_
    for context in contexts:
        context.close()


@pytest.fixture
def stage() -> Iterator[Stage]:
    """Offers the maze on the play socket of a query; what is offered is withdrawn when the test ends."""
    with ExitStack() as stack:

        def offered(served: Served, query: int, translator: Translator = MAZE) -> Callable[[], None]:
            user = served.db.write_now(lambda tx: users.ensure_user(tx, "learner", "learner"))
            token = served.db.write_now(lambda tx: tokens.create_token(tx, user.id, "stage")).token
            client = Client(served.url, token)
            stack.callback(client.close)
            withdraw = offer(lambda: client.play(query), translator, client.upload)
            stack.callback(withdraw)
            return withdraw

        yield offered
