"""Practice queries of a run's domain: its first learner sends them, so people practice what they will be asked."""

from waypost.client import Client, Refused
from waypost.domains import Domain, oracle_of
from waypost_learner.experts.practice import made
from waypost_learner.remote.translation import vocabulary

SEED = 0  # of the rollouts from which the practice queries are picked
CANDIDATES = 50  # of these rollouts: fewer than for a file, because the run waits for them


def send_practice(client: Client, run: str, domain: Domain, instances: str) -> str | None:
    """Send practice queries, unless the server has some for this domain as it is, or the domain has no oracle.

    Args:
        client: the learner's client.
        run: the run.
        domain: its domain; the oracle gives the right answers.
        instances: the name of a set of instances, or a file.

    Returns:
        why nothing could be sent, as a sentence; None if all is well.
    """
    if oracle_of(domain) is None or _has_practice(client, domain):
        return None
    try:
        content, frames = made(domain, instances, SEED, CANDIDATES)
        client.upload(frames)
        client.put_practice(run, content)
    except (ValueError, Refused) as error:  # training goes on without
        return f"The server gets no practice queries for the domain {domain.name!r}: {error}"
    return None


def _has_practice(client: Client, domain: Domain) -> bool:
    try:
        return client.practice(domain.name).vocabulary == vocabulary(domain)
    except Refused:
        return False
