"""Every route needs a login and is described. `auth/test_access.py` says who may call it."""

from typing import Any

import pytest
from starlette.routing import WebSocketRoute
from tests.server.kit import Service

from waypost import wire
from waypost_server.app import create_app
from waypost_server.settings import Settings

OPEN = {
    ("GET", "/healthz"),
    ("GET", "/readyz"),
    ("POST", "/api/v1/session"),
    ("GET", "/api/v1/sign-in"),
    ("POST", "/api/v1/sign-in"),
    ("POST", "/api/v1/sign-in/reply"),
}


def document() -> dict[str, Any]:
    return create_app(Settings(database="sqlite:///never-opened.db")).openapi()


def operations() -> list[tuple[str, str, str]]:
    return [
        (method.upper(), path, operation["operationId"])
        for path, item in document()["paths"].items()
        for method, operation in item.items()
    ]


def called(service: Service, method: str, path: str, headers: dict[str, str]) -> int:
    for name in ("run", "query", "assignment", "user", "token", "item"):
        path = path.replace(f"{{{name}}}", "1")
    body = {"json": {}} if method in {"POST", "PATCH", "PUT"} else {}
    return service.client.request(method, path, headers=headers, **body).status_code


def all_routes(routes: Any, prefix: str = "") -> set[tuple[str, str]]:
    """Every method and path the app really serves, through whatever nests its routers."""
    found: set[tuple[str, str]] = set()
    for route in routes:
        nested = getattr(route, "original_router", None) or getattr(route, "app", None)
        if getattr(route, "methods", None):
            found |= {(method, prefix + route.path) for method in route.methods - {"HEAD"}}
        elif isinstance(route, WebSocketRoute):
            found.add(("WS", prefix + route.path))
        elif nested is not None and hasattr(nested, "routes"):
            inner = getattr(route, "include_context", None)
            found |= all_routes(nested.routes, prefix + (getattr(inner, "prefix", "") or ""))
        else:
            raise AssertionError(f"unknown kind of route: {route!r}")
    return found


def test_the_app_serves_nothing_that_is_not_described() -> None:
    app = create_app(Settings(database="sqlite:///never-opened.db"))
    described = {(method, path) for method, path, _ in operations()}
    assert all_routes(app.routes) - described == {
        ("GET", "/api/v1/openapi.json"),
        ("GET", "/api/docs"),
        ("GET", "/api/docs/style.css"),
        ("GET", "/{path:path}"),
        ("WS", "/api/v1/queries/{query}/play"),  # OpenAPI has no sockets; docs/rest-client.md describes it
    }


def test_the_messages_of_the_play_socket_are_described() -> None:
    schemas = document()["components"]["schemas"]
    names = {name for name, of in vars(wire).items() if name.startswith("Play") and isinstance(of, type)}
    assert len(names) == 5
    assert names <= set(schemas)


def test_what_a_receiver_of_webhooks_gets_is_described() -> None:
    (sent,) = document()["webhooks"].values()
    schema = sent["post"]["requestBody"]["content"]["application/json"]["schema"]
    assert set(schema["discriminator"]["mapping"]) == {*wire.WEBHOOK_TOPICS, "ping"}
    assert set(sent["post"]["responses"]) == {"200"}
    described = document()["components"]["schemas"]
    assert {"WebhookAnswer", "WebhookRun", "WebhookPing", "AnswerNews", "RunNews", "PingNews"} <= set(described)


def test_every_route_needs_a_login_but_health_and_login_itself(lite: Service) -> None:
    for method, path, name in operations():
        if (method, path) in OPEN:
            continue
        for headers in ({}, {"Authorization": "Bearer wp_wrong"}):
            assert called(lite, method, path, headers) == 401, name


def test_every_operation_has_a_short_name_and_says_what_may_go_wrong() -> None:
    for path, item in document()["paths"].items():
        for operation in item.values():
            assert operation["operationId"].isalnum(), path
            assert operation["summary"], path
            assert operation["description"], path
            for status, response in operation["responses"].items():
                if status >= "400":
                    assert list(response["content"]) == ["application/problem+json"], path


def test_answers_and_questions_are_tagged_unions() -> None:
    schemas = document()["components"]["schemas"]
    asked = schemas["Query"]["properties"]["ask"]
    assert set(asked["discriminator"]["mapping"]) == set(wire.Kind.__args__)
    assert not [name for name in schemas if "-" in name]
    for name, schema in asked["discriminator"]["mapping"].items():
        assert schema.removeprefix("#/components/schemas/") in schemas, name


def test_what_the_server_sends_has_no_optional_fields() -> None:
    schemas = document()["components"]["schemas"]
    for name in (
        "Run",
        "Query",
        "Assignment",
        "Receipt",
        "Costs",
        "Curves",
        "AskLabelLo",
        "Prices",
        "Me",
        "Numbers",
        "Gold",
    ):
        assert set(schemas[name]["required"]) == set(schemas[name]["properties"]), name


def test_the_document_is_served_to_everybody(lite: Service) -> None:
    assert lite.client.get("/api/v1/openapi.json").json() == document()


@pytest.mark.parametrize("path", ["/healthz", "/readyz"])
def test_health_is_open(service: Service, path: str) -> None:
    assert service.client.get(path).json()["status"] == "ok"


def test_metrics_count_what_the_store_holds(service: Service) -> None:
    service.learner.create_run()
    text = service.client.get("/metrics", headers=service.viewer.headers).text
    assert 'waypost_runs{state="running"} 1' in text
    assert "# TYPE waypost_answers_total counter" in text
