"""Whatever the OpenAPI document allows or forbids, the server answers as the document says, and never with a 5xx."""

from collections.abc import Iterator

import httpx2
import pytest
import schemathesis
from hypothesis import HealthCheck, Phase, settings
from schemathesis import checks
from tests.server.kit import Service, query

from waypost_server import serving
from waypost_server.app import create_app
from waypost_server.settings import Settings

EXAMPLES = 12


@pytest.fixture(scope="module")
def url(tmp_path_factory: pytest.TempPathFactory) -> str:
    return f"sqlite:///{tmp_path_factory.mktemp('fuzz') / 'waypost.db'}"


@pytest.fixture(scope="module")
def busy(url: str) -> Iterator[Service]:
    """A service with a run, queries in every state, and an assignment to guess at."""
    settings = Settings(database=url, login_failures=10**6)
    with serving.background(settings) as served, httpx2.Client(base_url=served.url) as client:
        service = Service(client, served.db)
        run = service.learner.create_run()
        service.learner.ask(run, *(query(kind, ordinal=n) for n, kind in enumerate(("label_lo", "inspect_full"))))
        service.admin.answer(service.admin.lease())
        service.admin.lease()
        yield service


document = schemathesis.openapi.from_dict(create_app(Settings(database="sqlite:///none.db")).openapi())


@document.include(path_regex=".").exclude(operation_id=["streamEvents", "streamChanges"]).parametrize()
@settings(
    max_examples=EXAMPLES,
    deadline=None,
    derandomize=True,
    phases=[Phase.generate],
    suppress_health_check=list(HealthCheck),
)
def test_every_operation_keeps_to_its_description(case: schemathesis.Case, busy: Service) -> None:
    if isinstance(case.query, dict) and "wait" in case.query:
        case.query["wait"] = 0
    if isinstance(case.body, dict):
        for lease in (case.body, case.body.get("next")):
            if isinstance(lease, dict) and isinstance(lease.get("wait"), int | float):
                lease["wait"] = 0
    response = case.call(base_url=str(busy.client.base_url), headers=busy.admin.headers, timeout=20)
    case.validate_response(
        response, checks=[checks.not_a_server_error, checks.status_code_conformance, checks.response_schema_conformance]
    )
