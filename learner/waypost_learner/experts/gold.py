"""Gold queries out of a run's own: what was asked, with all that is right by the domain's oracle."""

from waypost import wire
from waypost.client import Client
from waypost.domain import find_domain
from waypost_learner.experts.solutions import solve


def make_gold(client: Client, run: str, queries: int) -> int:
    """Make answered queries of a run gold, the newest first and no demonstrations; returns how many are gold now.

    Raises:
        ValueError: the run's domain has no oracle, or is not installed.
    """
    domain = find_domain(client.run(run).vocabulary.domain)
    asked, cursor = list[wire.Ask](), 0
    while (page := client.answers(run, after=cursor)).queries:
        asked += [query.ask for query in page.queries if query.ask.kind != "hier_demo"]
        cursor = page.cursor
    known = [wire.KnownAsk(ask=ask, known=solve(domain, ask).known) for ask in reversed(asked)]
    return len(client.add_gold(run, wire.GoldPost(known=known[:queries])))
