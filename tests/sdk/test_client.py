"""The client against the server in process: a lost reply costs nothing twice, a refusal says why."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx2
import pytest

from waypost import wire
from waypost.client import Client, Refused, Unreachable
from waypost_learner.domains.corridor import CorridorDomain
from waypost_learner.experts.bot import Bot
from waypost_learner.experts.oracle import OracleExpert
from waypost_learner.remote.in_process import InProcessTransport
from waypost_learner.remote.translation import vocabulary
from waypost_server.app import create_app
from waypost_server.auth import tokens
from waypost_server.settings import Settings
from waypost_server.users import service as users

DOMAIN = CorridorDomain()
RUN = wire.RunCreate(name="a run", algorithm="hg-dagger", seed=0, vocabulary=vocabulary(DOMAIN), episodes=3)
RESULT = wire.EpisodeResult(
    episode=0,
    warm_start=True,
    train_success=None,
    test_success=True,
    train_steps=0,
    test_steps=5,
    hi_labels=1,
    lo_labels=2,
    seconds=0.5,
)


class Lossy(httpx2.BaseTransport):
    """Loses some replies, after the server has done what it was asked, and some requests before."""

    def __init__(self, transport: httpx2.BaseTransport) -> None:
        self._transport = transport
        self.replies_to_lose = self.requests_to_lose = self.gateway_errors = 0
        self.arrived: list[str] = []

    def handle_request(self, request: httpx2.Request) -> httpx2.Response:
        if self.requests_to_lose:
            self.requests_to_lose -= 1
            raise httpx2.ConnectError("refused", request=request)
        if self.gateway_errors:
            self.gateway_errors -= 1
            return httpx2.Response(503)
        self.arrived.append(f"{request.method} {request.url.path}")
        response = self._transport.handle_request(request)
        if self.replies_to_lose:
            self.replies_to_lose -= 1
            raise httpx2.ReadError("the reply was lost", request=request)
        return response


class Service:
    """The app, and a client per role over a lossy transport."""

    def __init__(self, transport: InProcessTransport, learner: str, annotator: str) -> None:
        self.lossy = Lossy(transport)
        self.learner = Client("http://localhost", learner, self.lossy)
        self.annotator = Client("http://localhost", annotator, self.lossy)
        self.stranger = Client("http://localhost", "no-such-token", self.lossy)

    def losing(self, replies: int = 1) -> int:
        """Lose replies from now on; returns how many calls arrived before."""
        self.lossy.replies_to_lose = replies
        return len(self.lossy.arrived)


@pytest.fixture
def service(tmp_path: Path) -> Iterator[Service]:
    app = create_app(Settings(database=f"sqlite:///{tmp_path / 'waypost.db'}"))

    def token(name: str, role: wire.Role) -> str:
        user = app.state.context.db.write_now(lambda tx: users.ensure_user(tx, name, role))
        made = app.state.context.db.write_now(lambda tx: tokens.create_token(tx, user.id, "test"))
        return str(made.token)

    with InProcessTransport(app) as transport:
        service = Service(transport, token("lea", "learner"), token("abe", "annotator"))
        yield service
        for client in (service.learner, service.annotator, service.stranger):
            client.close()


def demonstration(episode: int = 0, start: int = 0) -> wire.AskHierDemo:
    return wire.AskHierDemo(
        kind="hier_demo",
        episode=episode,
        ordinal=0,
        question="?",
        instance={"cells": 13, "start": start, "target": 6},
        state=start,
        max_segments=30,
        max_actions=30,
    )


def test_asking_again_after_a_lost_reply_asks_once(service: Service) -> None:
    run = service.learner.create_run(RUN).id
    before = service.losing(replies=2)
    (query,) = service.learner.ask(run, [demonstration()])
    assert len(service.lossy.arrived) == before + 3
    assert service.learner.run(run).open_queries == 1
    assert service.learner.query(query.id).state == "open"


def test_answering_using_and_reporting_again_after_a_lost_reply_charges_and_stores_once(service: Service) -> None:
    run = service.learner.create_run(RUN).id
    (query,) = service.learner.ask(run, [demonstration()])
    assignment = service.annotator.lease(wire.Lease())
    assert assignment is not None
    answer = OracleExpert(DOMAIN)(assignment.query.ask)
    service.losing(replies=2)
    receipt = service.annotator.answer(assignment, answer)
    assert receipt.query == query.id
    assert receipt.units == service.learner.costs(run).total == 10  # two segments of six actions in all

    service.losing()
    assert service.learner.use(query.id).answer == answer
    service.losing()
    assert service.learner.report(run, [RESULT]).episodes_done == 1
    service.losing()
    finished = service.learner.patch_run(run, wire.RunPatch(state="finished", result={"ok": True}))
    assert (finished.state, finished.spent, finished.result) == ("finished", 10, {"ok": True})


def test_requests_that_do_not_arrive_and_a_server_that_is_starting_are_waited_out(service: Service) -> None:
    service.lossy.requests_to_lose, service.lossy.gateway_errors = 2, 2
    assert service.learner.runs() == []


def test_patience_ends_with_a_sentence_that_names_the_server() -> None:
    class Gone(httpx2.BaseTransport):
        def handle_request(self, request: httpx2.Request) -> httpx2.Response:
            raise httpx2.ConnectError("refused", request=request)

    client = Client("http://gone.example:8000/", "token", Gone(), patience=0.1)
    with pytest.raises(Unreachable, match=r"http://gone\.example:8000.* does not answer .*is it running"):
        client.runs()
    client.close()


def test_a_refusal_carries_the_servers_problem(service: Service) -> None:
    with pytest.raises(Refused) as refused:
        service.learner.run("no-such-run")
    assert (refused.value.name, refused.value.problem.status) == ("not-found", 404)
    with pytest.raises(Refused) as refused:
        service.stranger.runs()
    assert refused.value.problem.status == 401
    with pytest.raises(Refused) as refused:
        service.annotator.create_run(RUN)
    assert refused.value.problem.status == 403


def test_a_refusal_is_not_tried_again(service: Service) -> None:
    before = len(service.lossy.arrived)
    with pytest.raises(Refused):
        service.learner.run("no-such-run")
    assert len(service.lossy.arrived) == before + 1


def test_a_server_that_is_not_waypost_is_refused_with_what_it_said() -> None:
    class Other(httpx2.BaseTransport):
        def handle_request(self, request: httpx2.Request) -> httpx2.Response:
            return httpx2.Response(404, text="<h1>Nothing here</h1>", request=request)

    client = Client("http://other.example", "token", Other())
    with pytest.raises(Refused, match="Status 404: <h1>Nothing here</h1>"):
        client.runs()
    client.close()


def test_the_same_question_with_other_content_is_refused(service: Service) -> None:
    run = service.learner.create_run(RUN).id
    service.learner.ask(run, [demonstration(start=0)])
    with pytest.raises(Refused) as refused:
        service.learner.ask(run, [demonstration(start=1)])
    assert refused.value.problem.status == 409


def test_an_answer_that_is_not_there_yet_cannot_be_used(service: Service) -> None:
    run = service.learner.create_run(RUN).id
    (query,) = service.learner.ask(run, [demonstration()])
    with pytest.raises(Refused) as refused:
        service.learner.use(query.id)
    assert refused.value.name == "not-answered"


def test_answers_come_page_by_page_in_the_order_they_were_given(service: Service) -> None:
    run = service.learner.create_run(RUN).id
    service.learner.ask(run, [demonstration(episode) for episode in range(3)])
    expert, given = OracleExpert(DOMAIN), []
    assert service.learner.answers(run, after=0).queries == []
    while (assignment := service.annotator.lease(wire.Lease(run=run))) is not None:
        service.annotator.answer(assignment, expert(assignment.query.ask))
        given.append(assignment.query.id)
    page = service.learner.answers(run, after=0)
    assert [query.id for query in page.queries] == given
    assert service.learner.answers(run, after=page.cursor).queries == []


def test_a_question_given_back_is_nobodys_and_goes_to_whoever_asks_next(service: Service) -> None:
    run = service.learner.create_run(RUN).id
    service.learner.ask(run, [demonstration()])
    assignment = service.annotator.lease(wire.Lease())
    assert assignment is not None
    assert [held.id for held in service.annotator.assignments()] == [assignment.id]
    assert service.annotator.lease(wire.Lease()) is None
    service.annotator.release(assignment)
    assert service.annotator.assignments() == []
    again = service.annotator.lease(wire.Lease())
    assert again is not None
    assert again.query.id == assignment.query.id


def test_a_bot_whose_lease_was_lost_goes_on_with_the_next_question(service: Service) -> None:
    run = service.learner.create_run(RUN).id
    service.learner.ask(run, [demonstration(episode) for episode in range(3)])
    answer, lost = service.annotator.answer, []

    def losing_the_first(assignment: wire.Assignment, *rest: Any) -> wire.Receipt:
        if not lost:
            lost.append(assignment.query.id)
            service.annotator.release(assignment, skip=True)
        return answer(assignment, *rest)

    service.annotator.answer = losing_the_first  # type: ignore[method-assign]
    receipts: list[wire.Receipt] = []
    Bot(service.annotator).work(wait=0, on_answer=receipts.append)
    assert len(receipts) == 2
    assert lost[0] not in {receipt.query for receipt in receipts}
    assert service.learner.query(lost[0]).state == "open"


def test_a_bot_leaves_a_domain_that_it_does_not_know_to_others_and_says_why(service: Service) -> None:
    unknown = RUN.model_copy(update={"vocabulary": RUN.vocabulary.model_copy(update={"domain": "kitchen"})})
    (strange,) = service.learner.ask(service.learner.create_run(unknown).id, [demonstration()])
    (known,) = service.learner.ask(service.learner.create_run(RUN).id, [demonstration()])
    receipts: list[wire.Receipt] = []
    Bot(service.annotator, on_failure=lambda assignment, error: None).work(wait=0, on_answer=receipts.append)
    assert [receipt.query for receipt in receipts] == [known.id]
    assert service.learner.query(strange.id).state == "open"
    history = service.learner._call(wire.QueryHistory, "GET", f"/queries/{strange.id}/history")
    assert "kitchen" in (history.assignments[0].reason or "")
