"""The examples in TypeScript and curl, as they are, against a real server."""

import os
import shutil
import subprocess
from pathlib import Path

from tests.acceptance.processes import bot
from tests.repository.kit import ROOT


def run(*command: str | Path, folder: Path = ROOT, **env: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, cwd=folder, env={**os.environ, **env}, capture_output=True, text=True, check=False)


def npm(folder: Path, script: str, **env: str) -> subprocess.CompletedProcess[str]:
    return run(ROOT / "scripts" / "with-node", "npm", "run", "--silent", script, folder=folder, **env)


def test_typescript_asks_and_reads_what_the_bot_answered(server, tmp_path):
    folder = shutil.copytree(ROOT / "examples" / "typescript", tmp_path / "typescript")
    (folder / "node_modules").symlink_to(ROOT / "web" / "node_modules")  # the web app needs the same packages
    env = {"WAYPOST_SERVER": server.url, "WAYPOST_TOKEN": server.token("learner", "learner")}
    built = npm(folder, "build", **env)
    assert built.returncode == 0, built.stdout + built.stderr
    with bot(server, "oracle-bot"):
        done = npm(folder, "start", **env)
    assert done.stderr == ""
    assert done.stdout == "Right actions: east, east (2 units, by oracle-bot)\n"
    (made,) = server.client("learner", "learner").runs()
    assert (made.name, made.state, made.spent) == ("TypeScript", "finished", 2)

    refused = npm(folder, "start", **(env | {"WAYPOST_TOKEN": "wp_wrong"}))
    assert refused.returncode == 1
    assert "token" in refused.stderr


def test_curl_asks_leases_answers_and_reads(server):
    tokens = {"LEARNER_TOKEN": server.token("learner", "learner"), "ANNOTATOR_TOKEN": server.token("ann", "annotator")}
    done = run(ROOT / "examples" / "curl.sh", server.url, **tokens)
    assert done.stderr == ""
    (made,) = server.client("learner", "learner").runs()
    assert done.stdout.splitlines() == [
        f"Asked query 1 in run {made.id}.",
        "Answered it for 1.0 units.",
        "The verdict is pass.",
    ]
    assert (made.state, made.spent) == ("finished", 1)

    refused = run(ROOT / "examples" / "curl.sh", server.url, **(tokens | {"LEARNER_TOKEN": "wp_wrong"}))
    assert refused.returncode != 0
    assert "Log in first" in refused.stdout + refused.stderr
