"""The script for Stable-Baselines3, as a process, with a real server and the oracle bot."""

import os
import re
import subprocess
import sys

import pytest
from tests.acceptance.processes import ServerProcess, bot
from tests.repository.kit import ROOT

SCRIPT = ROOT / "examples" / "stable_baselines3" / "train.py"


def train(server: ServerProcess, budget: int) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, SCRIPT, "--server", server.url, "--rollouts", "6", "--budget", str(budget)],
        env={**os.environ, "WAYPOST_TOKEN": server.token("learner", "learner")},
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.timeout(600)  # three processes that import PyTorch, on machines with few cores
def test_the_agent_learns_from_the_answers_and_a_larger_budget_continues_its_run(server):
    client = server.client("learner", "learner")
    with bot(server, "oracle-bot"):
        stopped = train(server, budget=60)
        (before,) = client.runs()
        done = train(server, budget=5_000)

    assert (stopped.returncode, stopped.stdout) == (1, "")
    assert "The budget is exhausted" in stopped.stderr
    assert 0 < before.spent <= 60
    assert before.state == "running"

    assert (done.returncode, done.stderr) == (0, "")
    (run,) = client.runs()  # it was continued, not started anew
    untrained, trained = (int(percent) for percent in re.findall(r"(\d+)%", done.stdout))
    assert untrained < 40
    assert trained > 50  # a script that ignores the answers ended at 13
    assert run.state == "finished"
    assert run.result == {"success_rate": pytest.approx(trained / 100, abs=0.005)}

    costs, curves = client.costs(run.id), client.curves(run.id)
    assert costs.by_kind["inspect_full"].units == len(curves.episode) == run.episodes_done  # each episode paid once
    assert costs.total == costs.by_kind["inspect_full"].units + costs.by_kind["label_full"].units
    assert f"Cost: {costs.total:g} units" in done.stdout
