"""The Python code of docs/client.md, run as it is against a real server with the oracle bot, and the notebook."""

import os
import re
import subprocess
import sys
import threading
from collections.abc import Iterator

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
    """A server whose queries a bot answers."""
    service, over = Service(start_server(Settings(database=sqlite_url))), threading.Event()
    bot = threading.Thread(target=service.answer_until, args=(over,))
    bot.start()
    yield service
    over.set()
    bot.join()
    service.learner.close()
    service.bot.close()


def test_every_block_of_the_page_runs_and_prints_what_it_says(service, tmp_path):
    script = tmp_path / "page.py"
    script.write_text("\n".join(re.findall(r"^```python\n(.*?)^```", PAGE.read_text(), re.MULTILINE | re.DOTALL)))
    done = subprocess.run([sys.executable, script], env=service.env, capture_output=True, text=True, check=False)
    assert done.stderr == ""
    printed = done.stdout.splitlines()
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


def test_the_table_of_the_page_names_every_kind_of_query():
    named = re.findall(r"^\| `(\w+)\(", PAGE.read_text(), re.MULTILINE)
    kinds = {re.sub(r"(?<!^)([A-Z])", r"_\1", name).lower() for name in named}
    assert kinds == set(wire.KINDS)


def test_the_notebook_runs_from_top_to_bottom_and_its_policy_learns(service):
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    NotebookClient(notebook, timeout=120, kernel_name="python3").execute(env=service.env)
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    text = "".join(output.text for output in outputs if output.output_type == "stream" and output.name == "stdout")
    before, after = (int(percent) for percent in re.findall(r"(\d+)% of the test episodes", text))
    assert before < 60 < 90 <= after
    assert any("image/png" in output.data for output in outputs if output.output_type == "display_data")
    (run,) = service.learner.runs()
    assert f"{run.spent:g} units" in text
    assert run.state == "finished"
    assert run.episodes_done == len(service.learner.curves(run.id).episode) > 0


def test_the_outputs_in_the_notebook_name_no_path_of_a_machine():
    assert str(ROOT) not in NOTEBOOK.read_text()
    assert not re.search(r"site-packages|/tmp/|Traceback", NOTEBOOK.read_text())
