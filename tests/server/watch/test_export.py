"""Downloads: tables as CSV and JSON Lines, whole, in order, and harmless in a spreadsheet."""

import csv
import io
import json

import pytest
from tests.server.kit import Service, query
from tests.server.runs.test_curves import report, result

from waypost_server.watch.export import PAGE, csv_line, harmless


def download(service: Service, run: str, table: str, form: str = "csv") -> str:
    path = f"/api/v1/runs/{run}/export?table={table}&format={form}"
    reply = service.client.get(path, headers=service.viewer.headers)
    assert reply.status_code == 200, reply.text
    assert reply.headers["content-disposition"] == f'attachment; filename="{run}-{table}.{form}"'
    assert reply.headers["content-type"].startswith("text/csv" if form == "csv" else "application/jsonl")
    return reply.text


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text, newline="")))


@pytest.mark.parametrize("start", ["=", "+", "-", "@", "\t", "\r", "\n", "\uff1d"])
def test_no_text_begins_like_a_formula(start: str) -> None:
    assert harmless(f"{start}cmd|x") == f"'{start}cmd|x"
    (row,) = csv.reader(io.StringIO(csv_line([f"{start}1", "a,b", 'a"b', None, -1.5, True]), newline=""))
    assert row == [f"'{start}1", "a,b", 'a"b', "", "-1.5", "true"]


def test_curves_are_a_row_per_episode(service: Service) -> None:
    run = service.learner.create_run()
    service.learner.ask(run, query("label_lo"))
    service.annotator.answer(service.annotator.lease())
    report(service, run, result(0, None), result(1, True))
    found = rows(download(service, run, "curves"))
    assert [(row["episode"], row["test_success"], row["cost"], row["cost_label_lo"]) for row in found] == [
        ("0", "", "3.0", "3.0"),
        ("1", "true", "3.0", "3.0"),
    ]
    lines = [json.loads(line) for line in download(service, run, "curves", "jsonl").splitlines()]
    assert [(line["episode"], line["success_rate"]) for line in lines] == [(0, None), (1, 1.0)]


def test_curves_have_the_attempts_at_each_subgoal(service: Service) -> None:
    run = service.learner.create_run()
    attempt = {"subgoal": "key", "reached": True}
    report(service, run, result(0), result(1, attempts=[attempt], reward=100.0))
    assert [json.loads(row["reached"]) for row in rows(download(service, run, "curves"))] == [{"key": 0}, {"key": 0.01}]
    lines = [json.loads(line) for line in download(service, run, "curves", "jsonl").splitlines()]
    assert [(line["reached"], line["reward"]) for line in lines] == [({"key": 0}, 0), ({"key": 0.01}, 50)]


def test_the_ledger_is_whole_and_in_order(service: Service) -> None:
    run = service.learner.create_run(prices={"inspect_full": 0.1})
    service.learner.ask(run, query(), query("label_lo", ordinal=1))
    for _ in range(2):
        service.annotator.answer(service.annotator.lease())
    found = rows(download(service, run, "ledger"))
    assert [(row["entry"], row["kind"], row["units"], row["balance"]) for row in found] == [
        ("charge", "inspect_full", "0.1", "0.1"),
        ("charge", "label_lo", "3.0", "3.1"),
    ]


def test_queries_carry_question_and_answer_and_longer_than_a_page(service: Service) -> None:
    run = service.learner.create_run()
    hostile = '=HYPERLINK("http://example.org","x")'
    service.learner.ask(run, query(question=hostile))
    service.annotator.answer(service.annotator.lease())
    service.learner.ask(run, *(query(episode=1, ordinal=n) for n in range(PAGE + 1)))
    found = rows(download(service, run, "queries"))
    assert len(found) == PAGE + 2
    assert [int(row["id"]) for row in found] == sorted(int(row["id"]) for row in found)
    assert found[0]["question"] == f"'{hostile}"
    assert json.loads(found[0]["answer"]) == {"kind": "inspect_full", "verdict": "pass"}
    assert (found[0]["annotator"], found[0]["state"], found[1]["answer"]) == ("abe", "answered", "")
    first = json.loads(download(service, run, "queries", "jsonl").splitlines()[0])
    assert first["ask"]["question"] == hostile, "JSON is data: it is left as it is"
    assert first["ask"]["segments"][0]["actions"] == ["up", "up"]


def test_a_run_that_is_not_there_has_no_tables(service: Service) -> None:
    assert service.viewer.get("/runs/none/export", 404)["type"] == "/problems/not-found"
    run = service.learner.create_run()
    assert download(service, run, "queries", "jsonl") == ""
    assert rows(download(service, run, "ledger")) == []
    service.viewer.get(f"/runs/{run}/export?table=users", 422)
