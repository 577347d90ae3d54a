"""The Python code of docs/client.md, of the README and of the notebook, run as it is against a real server."""

import os
import re
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from subprocess import PIPE

import nbformat
import pytest
from nbclient import NotebookClient
from tests.repository.kit import ROOT

from waypost import wire
from waypost.client import Client
from waypost_learner.experts.bot import Bot
from waypost_server.auth import tokens
from waypost_server.settings import Settings
from waypost_server.users import service as users

PAGE = ROOT / "docs" / "client.md"
NOTEBOOK = ROOT / "docs" / "notebook.ipynb"


class Service:
    """A server, and the environment variables of a learner's program."""

    def __init__(self, served) -> None:
        self._served = served
        self.learner = Client(served.url, self.token("learner", "learner"))
        self.bot = Client(served.url, self.token("oracle-bot", "annotator"))
        self.env = {**os.environ, "WAYPOST_SERVER": served.url, "WAYPOST_TOKEN": self.token("learner", "learner")}

    def token(self, name: str, role: wire.Role) -> str:
        user = self._served.db.write_now(lambda tx: users.ensure_user(tx, name, role))
        return self._served.db.write_now(lambda tx: tokens.create_token(tx, user.id, "")).token

    def answer_until(self, over: threading.Event) -> None:
        while not over.is_set():
            Bot(self.bot).work(wait=0.2)


@pytest.fixture
def service(start_server, sqlite_url) -> Iterator[Service]:
    service = Service(start_server(Settings(database=sqlite_url)))
    yield service
    service.learner.close()
    service.bot.close()


@pytest.fixture
def bot(service) -> Iterator[None]:
    """A bot that answers all queries."""
    over = threading.Event()
    thread = threading.Thread(target=service.answer_until, args=(over,))
    thread.start()
    yield
    over.set()
    thread.join()


def code_of(page: Path) -> str:
    return "\n".join(re.findall(r"^```python\n(.*?)^```", page.read_text(), re.MULTILINE | re.DOTALL))


def started(code: str, folder: Path, env: dict[str, str]) -> subprocess.Popen[str]:
    script = folder / "page.py"
    script.write_text(code)
    return subprocess.Popen([sys.executable, script], env=env, stdout=PIPE, stderr=PIPE, text=True)


def test_every_block_of_the_page_runs_and_prints_what_it_says(service, bot, tmp_path):
    out, complaints = started(code_of(PAGE), tmp_path, service.env).communicate()
    assert complaints == ""
    printed = out.splitlines()
    assert printed[:3] == ["The right actions were ('east', 'east')", "The subgoal was reached.", "[False, False]"]
    assert sorted(printed[3:8]) == [
        "episode 0, inspect_full: False, for 1 units",
        "episode 0, label_full: ('east', 'east'), for 2 units",
        "episode 1, inspect_lo: True, for 1 units",
        "episode 2, inspect_full: False, for 1 units",
        "episode 3, inspect_full: False, for 1 units",
    ]
    assert printed[8:] == ["True", "7 of 100 units, 4 inspections", "False"]
    (run,) = service.learner.runs()
    assert (run.name, run.state, run.spent, run.budget) == ("corridor by hand", "finished", 7, 200)
    assert run.result == {"success_rate": 0.5}


def test_the_script_in_the_readme_asks_what_was_right_if_the_episode_failed(service, tmp_path):
    script = started(code_of(ROOT / "README.md"), tmp_path, service.env)
    answers = [
        wire.InspectAnswer(kind="inspect_full", verdict="fail"),
        wire.LabelFullAnswer(kind="label_full", actions=["east", "east"]),
    ]
    for answer in answers:
        assignment = service.bot.lease(wire.Lease(wait=60))
        assert assignment is not None
        service.bot.answer(assignment, answer)
    assert script.communicate() == ("('east', 'east')\n", "")


def test_the_table_of_the_page_names_every_kind_of_query():
    named = re.findall(r"^\| `(\w+)\(", PAGE.read_text(), re.MULTILINE)
    kinds = {re.sub(r"(?<!^)([A-Z])", r"_\1", name).lower() for name in named}
    assert kinds == set(wire.KINDS)


def test_the_notebook_runs_from_top_to_bottom_and_its_policy_learns(service, bot):
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    NotebookClient(notebook, timeout=120, kernel_name="python3").execute(env=service.env)
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    text = "".join(output.text for output in outputs if output.output_type == "stream" and output.name == "stdout")
    before, after = (int(percent) for percent in re.findall(r"(\d+)% of the test episodes", text))
    assert before < 60 < 85 < after
    assert any("image/png" in output.data for output in outputs if output.output_type == "display_data")
    (run,) = service.learner.runs()
    assert f"{run.spent:g} units" in text
    assert run.state == "finished"
    assert run.episodes_done == len(service.learner.curves(run.id).episode) > 0


def test_the_outputs_in_the_notebook_name_no_path_of_a_machine():
    assert str(ROOT) not in NOTEBOOK.read_text()
    assert not re.search(r"site-packages|/tmp/|Traceback", NOTEBOOK.read_text())
