"""How SQLite finds the next query: by an index in the right order, however many queries are open."""

from typing import Any

import pytest
from sqlalchemy import Connection
from tests.server.kit import Json, Service, query

from waypost_server.db.sending import Single


def plans(service: Service, wish: Json) -> list[str]:
    """Return the plan of each statement by which a lease request selects a query."""
    found: list[str] = []
    read = Single.read

    def explaining(line: Single, conn: Connection, statement: str, arguments: Any) -> Any:
        if "ORDER BY queries.run_priority" in statement:
            rows = read(line, conn, f"EXPLAIN QUERY PLAN {statement}", arguments)
            found.append("\n".join(row[3] for row in rows))
        return read(line, conn, statement, arguments)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Single, "read", explaining)
        service.annotator.lease(**wish)
    return found


@pytest.mark.parametrize("wish", [{}, {"kinds": ["inspect_full"]}, {"defer": 5}, {"ahead": True}])
@pytest.mark.parametrize("one_run", [False, True])
def test_the_next_query_is_found_without_sorting_the_backlog(lite: Service, wish: Json, one_run: bool) -> None:
    run = lite.learner.create_run()
    lite.learner.ask(run, *(query(episode=episode) for episode in range(5)))
    first, *others = plans(lite, wish | ({"run": run} if one_run else {}))
    for plan in (first, *others):
        assert ("ix_queries_run_next" if one_run else "ix_queries_next") in plan
        assert "TEMP B-TREE" not in plan


def test_a_follow_up_is_looked_for_in_its_episode_alone(lite: Service) -> None:
    run = lite.learner.create_run()
    lite.learner.ask(run, *(query(episode=episode) for episode in range(5)))
    lite.annotator.answer(lite.annotator.lease())
    *_, follow_up = plans(lite, {"run": run})
    assert "ix_queries_episode_next (run_id=? AND episode=?" in follow_up
    assert "TEMP B-TREE" not in follow_up
