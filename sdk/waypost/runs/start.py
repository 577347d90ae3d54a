"""Creates the run of a training script, or resumes it."""

import os
from collections.abc import Mapping, Sequence

from pydantic import JsonValue

from waypost import wire
from waypost.client import Client
from waypost.runs.run import Run

SERVER = "http://127.0.0.1:8000"


def start_run(
    name: str,
    *,
    actions: Sequence[str],
    subgoals: Sequence[str] = (),
    server: str | None = None,
    token: str | None = None,
    algorithm: str = "custom",
    domain: str = "custom",
    renderer: str | None = None,
    seed: int = 0,
    config: Mapping[str, JsonValue] | None = None,
    prices: wire.Prices | None = None,
    budget: float | None = None,
    episodes: int | None = None,
    resume: bool = False,
    client: Client | None = None,
) -> Run:
    """Create a run for a training script, or resume one.

    Args:
        name: the name of the run.
        actions: the names of the actions.
        subgoals: the names of the subgoals; none for a policy without subgoals.
        server: the server's address. Default: the environment variable WAYPOST_SERVER, else http://127.0.0.1:8000.
        token: an API token of a user with the role learner. Default: the environment variable WAYPOST_TOKEN.
        algorithm: the name of the algorithm; the web app groups runs by it.
        domain: the name of the environment. The oracle bot can answer if a domain with this name is installed.
        renderer: the renderer of the web app that draws the states; without one, annotators see the pictures in the
            queries, or the states as text. Default: the renderer with the domain's name, if there is one.
        seed: the seed of the training.
        config: the values that determine the run, as JSON values.
        prices: the prices of the answers. Default: the paper's, 1 unit per label and per inspection.
        budget: the highest total cost, in units; None for no limit.
        episodes: the planned number of episodes, for progress in the web app.
        resume: whether to continue your newest unfinished run with the same name, algorithm, seed, names, prices and
            config, if there is one. Queries that it has asked before are then not asked again.
        client: a client to use instead of `server` and `token`.

    Raises:
        ValueError: there is no token, or an argument is not valid.
        Refused: the server refuses, for example because the token is not valid or its user is not a learner.
        Unreachable: no server answers at this address.
    """
    client = client or _client(server, token)
    wanted = wire.RunCreate(
        name=name,
        algorithm=algorithm,
        seed=seed,
        vocabulary=wire.Vocabulary(
            domain=domain, subgoals=list(subgoals), actions=list(actions), renderer=renderer or domain
        ),
        config=dict(config or {}),
        prices=prices or wire.Prices(),
        budget=budget,
        episodes=episodes,
    )
    found = _unfinished(client, wanted) if resume else None
    if found is None:
        return Run(client, client.create_run(wanted))
    if budget is not None and budget != found.budget:
        found = client.patch_run(found.id, wire.RunPatch(budget=budget))
    return Run(client, found)


def _client(server: str | None, token: str | None) -> Client:
    token = token or os.environ.get("WAYPOST_TOKEN")
    if not token:
        raise ValueError(
            "the server needs a token: give token=... or set WAYPOST_TOKEN (`waypost token create USER` makes one)"
        )
    return Client(server or os.environ.get("WAYPOST_SERVER") or SERVER, token)


def _unfinished(client: Client, wanted: wire.RunCreate) -> wire.Run | None:
    """Return the newest unfinished run of this user with the wanted settings."""
    same = ("name", "algorithm", "seed", "vocabulary", "prices", "config")
    for run in client.runs(text=wanted.name, mine=True):
        if run.state != "finished" and all(getattr(run, field) == getattr(wanted, field) for field in same):
            return run
    return None
