"""What the page's tests are written with: a maze built by hand, a learner's queries, a browser to answer in."""

import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import httpx2
from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Page, expect, sync_playwright

from waypost import wire
from waypost_server.auth import sessions, tokens
from waypost_server.serving import Served
from waypost_server.users import service as users

Json = dict[str, Any]
Cell = tuple[int, int]

MOVES: dict[str, Cell] = {"up": (-1, 0), "down": (1, 0), "left": (0, -1), "right": (0, 1)}
LETTERS = {"u": "up", "d": "down", "l": "left", "r": "right"}
VOCABULARY = {
    "domain": "maze",
    "subgoals": ["north", "south", "west", "east", "go_to_target"],
    "actions": ["up", "down", "left", "right"],
    "renderer": "maze",
}

# --- a maze and ways through it ------------------------------------------------------------------------------------

START: Cell = (14, 2)
GOAL: Cell = (2, 14)
DOORS: tuple[Cell, ...] = (
    (12, 2),
    (8, 1),
    (6, 4),
    (7, 8),
    (4, 7),
    (2, 8),
    (3, 12),
    (10, 4),
    (12, 6),
    (14, 8),
    (10, 12),
    (8, 14),
    (4, 10),
    (6, 12),
)


def maze() -> Json:
    """The maze: 4 x 4 rooms of 3 x 3 cells, lava between them, some doors."""
    rows = [
        "".join("#" if (r % 4 == 0 or c % 4 == 0) and (r, c) not in DOORS else "." for c in range(17))
        for r in range(17)
    ]
    return {"rows": rows, "start": list(START), "goal": list(GOAL)}


def way(start: Cell, *legs: tuple[str | None, str]) -> list[Json]:
    """Segments from a start: each leg is a subgoal and its moves, such as ("north", "uuru")."""
    (row, column), segments = start, []
    for subgoal, moves in legs:
        states, actions = [[row, column]], []
        for letter in moves:
            action = LETTERS[letter]
            row, column = row + MOVES[action][0], column + MOVES[action][1]
            states.append([row, column])
            actions.append(action)
        segments.append({"subgoal": subgoal, "states": states, "actions": actions})
    return segments


# The learner's rollout: north, north, east, then it takes the wrong door and burns.
ROLLOUT = way(
    START,
    ("north", "uuu"),
    ("north", "uluu"),
    ("east", "uurrrr"),
    ("north", "urruu"),
    ("east", "lrr"),
)
LAST = ROLLOUT[-1]


def ask(kind: str, episode: int = 0, ordinal: int = 0, **more: Any) -> Json:
    """A query of a kind about the rollout, worded as the learner words it."""
    common = {"kind": kind, "episode": episode, "ordinal": ordinal, "instance": maze()}
    hi = {"kind": "label_hi", "subgoals": [one["subgoal"] for one in ROLLOUT]}
    third = ROLLOUT[2]
    lo = {
        "kind": "label_lo",
        "actions": third["actions"],
        "terminations": [*(False for _ in third["actions"]), True],
    }
    particular: dict[str, Json] = {
        "inspect_full": {"question": "Did it do the whole task?", "segments": ROLLOUT},
        "label_hi": {
            "question": "Which subgoal should it have chosen for each segment?",
            "segments": ROLLOUT,
            "suggestion": hi,
        },
        "inspect_lo": {
            "question": "It tried “east”. Did that work?",
            "segments": [third],
            "context": ROLLOUT[:2],
        },
        "label_lo": {
            "question": "It tried “east”. What should it have done at each step, and where is it done?",
            "segments": [third],
            "context": ROLLOUT[:2],
            "suggestion": lo,
        },
        "label_full": {"question": "What should it have done at each step?", "segments": ROLLOUT[:3]},
    }
    return common | particular[kind] | more


# --- a server with people -------------------------------------------------------------------------------------------


def _client(served: Served, name: str, role: wire.Role) -> httpx2.Client:
    """Return a client with a token of a user, who is created if there is no user with this name."""
    user = served.db.write_now(lambda tx: users.ensure_user(tx, name, role))
    token = served.db.write_now(lambda tx: tokens.create_token(tx, user.id, "test")).token
    return httpx2.Client(base_url=f"{served.url}/api/v1", headers={"Authorization": f"Bearer {token}"}, timeout=60)


class Learner:
    """The learner's side of the service, over REST."""

    def __init__(self, served: Served) -> None:
        self.served = served
        self._http = _client(served, "learner", "learner")

    def close(self) -> None:
        """Close the connections."""
        self._http.close()

    def call(self, method: str, path: str, body: Any = None) -> Any:
        """Call the API; the reply must be good."""
        reply = self._http.request(method, path, **({} if body is None else {"json": body}))
        assert reply.is_success, f"{method} {path}: {reply.status_code} {reply.text[:300]}"
        return reply.json() if reply.content else None

    def create_run(self, name: str = "maze-lean", **more: Any) -> str:
        """Create a run and return its id."""
        body = {"name": name, "algorithm": "hg-dagger", "seed": 0, "vocabulary": VOCABULARY, "episodes": 500}
        return str(self.call("POST", "/runs", body | more)["id"])

    def ask(self, run: str, *asks: Json) -> list[int]:
        """Ask and return the queries' ids."""
        reply = self.call("POST", f"/runs/{run}/queries", {"queries": list(asks)})
        return [query["id"] for query in reply["queries"]]

    def answer_of(self, query: int, wait: float = 10) -> Json:
        """Wait for a query's answer."""
        found = self.call("GET", f"/queries/{query}?wait={wait}")
        assert found["state"] == "answered", found["state"]
        return dict(found["answer"])

    def query(self, query: int) -> Json:
        """A query as it stands."""
        return dict(self.call("GET", f"/queries/{query}"))

    def use(self, query: int) -> None:
        """Train on an answer."""
        self.call("POST", f"/queries/{query}/use")

    def finish_all(self) -> None:
        """Finish every run there is, also of other users, so that nothing is left to be answered."""
        with _client(self.served, "finisher", "admin") as admin:
            while runs := self.call("GET", "/runs?state=running")["runs"]:
                for run in runs:
                    assert admin.patch(f"/runs/{run['id']}", json={"state": "finished"}).is_success

    def report(self, run: str, outcomes: list[bool]) -> None:
        """Report episodes."""
        rows = [
            {
                "episode": episode,
                "warm_start": False,
                "train_success": outcome,
                "test_success": outcome,
                "train_steps": 40,
                "test_steps": 40,
                "hi_labels": episode,
                "lo_labels": episode,
                "seconds": 0.1,
            }
            for episode, outcome in enumerate(outcomes)
        ]
        self.call("POST", f"/runs/{run}/episodes", {"episodes": rows})


def login_link(served: Served, name: str, role: wire.Role) -> str:
    """A one-time link that logs a new person in."""
    user = served.db.write_now(lambda tx: users.ensure_user(tx, name, role))
    code = served.db.write_now(lambda tx: sessions.create_login_link(tx, user.id, 600)).code
    return f"{served.url}/login#{code}"


def log_in(context: BrowserContext, served: Served, name: str, role: wire.Role) -> None:
    """Give a browser context the session of a new person, without opening a page."""
    code = login_link(served, name, role).partition("#")[2]
    reply = context.request.post("/api/v1/session", data={"code": code})
    assert reply.ok, reply.text()


# --- a browser ------------------------------------------------------------------------------------------------------


_FLAGS = [
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-gpu",
    "--disable-quic",
    "--disable-sync",
    "--no-first-run",
]


@contextmanager
def chromium() -> Iterator[Browser]:
    """A running Chromium: the one that WAYPOST_CHROMIUM names, else one on PATH, else Playwright's own."""
    names = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
    on_path = next((found for name in names if (found := shutil.which(name))), None)
    with sync_playwright() as playwright:
        executable = os.environ.get("WAYPOST_CHROMIUM") or on_path
        browser = playwright.chromium.launch(executable_path=executable, args=_FLAGS)
        try:
            yield browser
        finally:
            browser.close()


@dataclass
class Complaints:
    """What the browser complained of. A test that provokes something says so with `expect`."""

    heard: list[str] = field(default_factory=list)
    expected: list[str] = field(default_factory=list)

    def listen(self, page: Page) -> None:
        """Hear console errors, uncaught errors and blocked content."""
        page.on("console", self._on_console)
        page.on("pageerror", lambda error: self.heard.append(f"uncaught: {error}"))

    def _on_console(self, message: ConsoleMessage) -> None:
        if message.type in {"error", "warning"}:
            self.heard.append(f"{message.type}: {message.text} ({message.location.get('url', '')})")

    def expect(self, part: str) -> None:
        """Complaints that contain this are what the test is about."""
        self.expected.append(part)

    def check(self) -> None:
        """Fail on anything unexpected."""
        unexpected = [one for one in self.heard if not any(part in one for part in self.expected)]
        assert not unexpected, unexpected


def wait_for_heading(page: Page, text: str) -> None:
    """Wait until the question (or what stands in its place) says this and has the focus."""
    heading = page.get_by_role("heading", name=text, exact=True)
    heading.wait_for()
    expect(heading).to_be_focused()


def wait_for_question(page: Page, query: int) -> None:
    """Wait until a query's question has the focus, in whatever language it is."""
    page.locator(f"#question[data-query='{query}']:focus").wait_for()


def begun_run(
    learner: Learner, open_page: Callable[..., Page], name: str, budget: float, **opened: Any
) -> tuple[str, Page]:
    """Return a run with three episodes, and an administrator's page that has answered one of its two questions."""
    run = learner.create_run(name, budget=budget)
    first, second = learner.ask(run, ask("inspect_full"), ask("label_hi", ordinal=1))
    page = open_page(f"/work?run={run}", role="admin", **opened)
    wait_for_question(page, first)
    page.keyboard.press("f")
    wait_for_question(page, second)
    learner.report(run, [True, False, True])
    return run, page
