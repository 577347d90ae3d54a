"""The server does what the model in `model.py` does, whatever is called in which order."""

import pytest
from tests.server.answers.model import run_schedules
from tests.server.kit import in_one_thread


@pytest.mark.filterwarnings("ignore::hypothesis.errors.NonInteractiveExampleWarning")
def test_the_server_does_what_the_model_does(database_url: str) -> None:
    with in_one_thread(database_url, follow_up_seconds=0) as service:
        seen = run_schedules(service, 20, 35)
    # What the sequences must have met for the test to mean something.
    assert {"asked 200", "asked 402", "retracted 200", "retracted 409", "left holding some"} <= set(+seen), seen
