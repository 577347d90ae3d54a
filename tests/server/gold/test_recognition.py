"""A gold query has the age of the other queries, and its annotator is at work like the others."""

import pytest
from tests.server.gold.test_gold import bring, is_gold
from tests.server.kit import Json, Service, query


@pytest.fixture
def held(lite: Service) -> tuple[str, Json, Json]:
    """A run, and a gold query and one of the run's own that an annotator holds."""
    run = lite.learner.create_run()
    lite.learner.ask(run, *(query(episode=7, ordinal=n) for n in range(20)))
    bring(lite, run, "inspect_full")
    both = [lite.annotator.lease(run=run) for _ in range(4)]
    gold, own = (next(one for one in both if is_gold(lite, run, one) == wanted) for wanted in (True, False))
    return run, gold, own


def test_a_gold_query_is_as_old_as_the_query_that_it_replaces(lite: Service, held: tuple[str, Json, Json]) -> None:
    _, gold, own = held
    assert gold["query"]["created_at"] == own["query"]["created_at"] < gold["leased_at"]


def test_an_annotator_with_a_gold_query_is_at_work_like_anybody_else(
    lite: Service, held: tuple[str, Json, Json]
) -> None:
    run, gold, own = held
    for caller in (lite.annotator, lite.viewer):
        (abe,) = caller.get("/annotators", params={"run": run})["annotators"]
        shown = {one["query"]: one for one in abe["holds"]}
        assert len(shown) == 4
        for one in (gold, own):
            found = shown[one["query"]["id"]]
            assert (found["run"], found["kind"], found["episode"]) == (run, "inspect_full", 7)
