"""Turn a run's own answered queries into gold queries, with the right answers from the domain's oracle."""

from waypost import wire
from waypost.client import Client
from waypost.domains import find_domain, place_of
from waypost_learner.experts.solutions import solve


def make_gold(client: Client, run: str, queries: int) -> int:
    """Make gold queries from answered queries of a run, and return how many gold queries the run has now.

    Demonstrations cannot be gold.

    Args:
        client: the client of a user who may edit the run.
        run: the run's id.
        queries: the number of answered queries to take, newest first.

    Raises:
        ValueError: the run's domain has no oracle, or is not found.
    """
    domain = find_domain(place_of(client.run(run)))
    asked, cursor = list[wire.Ask](), 0
    while (page := client.answers(run, after=cursor)).queries:
        asked += [query.ask for query in page.queries if query.ask.kind != "hier_demo"]
        cursor = page.cursor
    known = [wire.KnownAsk(ask=ask, known=solve(domain, ask).known) for ask in reversed(asked)]
    return len(client.add_gold(run, wire.GoldPost(known=known[:queries])))
