"""Many annotators, some too slow, on one queue."""

import asyncio
import random
from collections import Counter
from dataclasses import dataclass

import httpx2
from tests.server.kit import API, VOCABULARY, Json, Service, query, right_answer

from waypost_server.app import create_app
from waypost_server.settings import Settings

LEASE_SECONDS = 2.0
CHARGED = "SELECT count(*) AS n FROM ledger GROUP BY query_id"


@dataclass(frozen=True)
class Race:
    """What came out of a race.

    Args:
        costs: of the run, as the API reports them.
        charges: how often each query was charged.
        seen: how many answers were accepted, how many accepted although their lease was over ("stale"), and how many
            were refused, by the name of the problem.
    """

    costs: Json
    charges: list[int]
    seen: Counter[str]


async def race(url: str, n_annotators: int, n_queries: int, seed: int) -> Race:
    """Let annotators, a third of them slow, empty a queue; one event loop, so that the machine's threads do not."""
    app = create_app(Settings(database=url, lease_seconds=LEASE_SECONDS, hosts=("testserver",)))
    transport = httpx2.ASGITransport(app=app)
    async with (
        app.router.lifespan_context(app),
        httpx2.AsyncClient(transport=transport, base_url=f"http://testserver{API}", timeout=None) as client,
    ):
        with httpx2.Client() as unused:
            service = Service(unused, app.state.context.db)
        run = {"name": "race", "algorithm": "x", "seed": 0, "vocabulary": VOCABULARY, "budget": n_queries}
        path = f"/runs/{(await client.post('/runs', json=run, headers=service.learner.headers)).json()['id']}"
        for start in range(0, n_queries, 100):
            body = {"queries": [query(ordinal=start + n) for n in range(min(100, n_queries - start))]}
            assert (await client.post(f"{path}/queries", json=body, headers=service.learner.headers)).status_code == 200
        work = (
            _work(client, one.headers, n % 3 == 0, random.Random(f"{seed} {n}"))
            for n, one in enumerate(service.annotators(n_annotators))
        )
        done = await asyncio.gather(*work)
        costs = (await client.get(f"{path}/costs", headers=service.viewer.headers)).json()
        charged = service.db.read_now(lambda tx: tx.conn.exec_driver_sql(CHARGED).all())
        return Race(costs, [row.n for row in charged], sum(done, Counter()))


async def _work(
    client: httpx2.AsyncClient, headers: dict[str, str], is_slow: bool, choose: random.Random
) -> Counter[str]:
    """Lease and answer until the queue is empty; a slow one takes longer than its lease, at first and now and then."""
    seen: Counter[str] = Counter()
    is_late = is_slow
    while True:
        reply = await client.post("/assignments", json={"wait": 2 * LEASE_SECONDS}, headers=headers)
        if reply.status_code == 204:
            return seen
        held: Json = reply.json()
        if is_late:
            await asyncio.sleep(1.2 * LEASE_SECONDS)
        body = {"token": held["token"], "answer": right_answer(held["query"]["ask"])}
        reply = await client.post(f"/assignments/{held['id']}/answer", json=body, headers=headers)
        accepted = "stale" if is_late else "accepted"
        seen[accepted if reply.status_code == 200 else reply.json()["type"].rsplit("/", 1)[-1]] += 1
        is_late = is_slow and choose.random() < 0.1
