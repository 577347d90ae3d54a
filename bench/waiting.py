"""Measures how long a person waits for the next question while a learner trains.

    PYTHONPATH=. python bench/waiting.py [--episodes 60] [--preset general --told crop --warm-start 1 --in-flight 2]

A server, `waypost train --expert queue` with two threads, and a program that answers with the oracle run on this
machine. The program takes as long for an answer as `bench/person.py` estimates for a person. A wait is the time from an
answer to the next question. The script prints the waits within and between episodes, and asserts nothing.
"""

import argparse
import statistics
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from tempfile import TemporaryDirectory

from bench.assignments import machine, serving
from bench.person import seconds_of

from waypost import wire
from waypost.client import Client
from waypost.domains import find_domain
from waypost_learner.experts.oracle import OracleExpert

LONGEST = 5.0  # seconds for which one request waits


def waits(person: Client, training: "subprocess.Popen[bytes]") -> Iterator[tuple[bool, float]]:
    """Answer as a person would, to the end of the run; yield each wait in seconds, and whether a new episode began."""
    expert, episode, answered = OracleExpert(find_domain("maze")), -1, 0.0
    while training.poll() is None:
        held = person.lease(wire.Lease(wait=LONGEST))
        if held is None:
            continue
        if answered:
            yield held.query.ask.episode != episode, time.perf_counter() - answered
        answer = expert(held.query.ask)
        time.sleep(seconds_of(held.query.ask, answer))
        person.answer(held, answer)
        episode, answered = held.query.ask.episode, time.perf_counter()


def row(name: str, times: list[float]) -> str:
    """Return a row of the table."""
    times = sorted(times)
    late = times[min(int(0.95 * len(times)), len(times) - 1)]
    return f"| {name} | {len(times)} | {statistics.median(times):.2f} | {late:.2f} | {times[-1]:.2f} |"


def main() -> None:
    """Train, answer, and print the table."""
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--episodes", default="60")
    arguments.add_argument("--preset", default="general")
    arguments.add_argument("--told", default="crop")
    arguments.add_argument("--warm-start", default="1")
    arguments.add_argument("--in-flight", default="1")
    given = arguments.parse_args()
    options = [f"--{name.replace('_', '-')}={value}" for name, value in vars(given).items()]
    with TemporaryDirectory() as folder, serving(f"sqlite:///{folder}/waiting.db") as (url, _, learner, annotators):
        token, answering = (one["Authorization"].split()[1] for one in (learner, annotators[0]))
        command = [sys.executable, "-m", "waypost_learner.cli", "train", "hg-dagger", *options, "--threads=2"]
        command += ["--expert=queue", f"--server={url}", f"--token={token}"]
        with (
            subprocess.Popen(command, stdout=subprocess.DEVNULL, cwd=Path(folder)) as training,
            closing(Client(url, answering)) as person,
        ):
            found = list(waits(person, training))
    print(machine())
    print(f"{' '.join(options)}\n\n| waits, seconds | number | median | p95 | longest |\n|---|---|---|---|---|")
    print(row("between episodes", [wait for first, wait in found if first]))
    print(row("within an episode", [wait for first, wait in found if not first]))


if __name__ == "__main__":
    main()
