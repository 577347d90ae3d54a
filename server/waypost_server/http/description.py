"""The OpenAPI document of the API, complete enough to generate clients from it."""

import json
from collections.abc import Mapping
from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from pydantic.json_schema import models_json_schema

from waypost import wire
from waypost_server import errors
from waypost_server.http import problems

SHARED = problems.refusals(
    errors.Unauthenticated,
    errors.Forbidden,
    errors.CrossSite,
    errors.BodyTooLarge,
    errors.NotJson,
    errors.Unprocessable,
    errors.StorageFailed,
    errors.StoreBusy,
)
PROBLEM = {"$ref": "#/components/schemas/Problem"}
PLAYED = (wire.PlayTake, wire.PlayOffer, wire.PlayMoves, wire.PlayStates, wire.PlayStage)


def install(app: FastAPI, callers: Mapping[str, str]) -> None:
    """Make the app serve this document. `callers` says by operation who may call it."""

    def build() -> dict[str, Any]:
        if app.openapi_schema is None:
            app.openapi_schema = document(app, callers)
        return app.openapi_schema

    app.openapi = build  # type: ignore[method-assign]  # FastAPI's own way to extend the document


def document(app: FastAPI, callers: Mapping[str, str]) -> dict[str, Any]:
    """Return the app's OpenAPI document."""
    found = get_openapi(
        title=app.title,
        version=app.version,
        summary=app.summary,
        routes=app.routes,
        webhooks=app.webhooks.routes,
    )
    for path in found["paths"].values():
        for operation in path.values():
            _state_problems(operation)
            if operation["operationId"] in callers:
                operation["description"] += f"\n\n{callers[operation['operationId']]}"
    for path in found["webhooks"].values():
        for operation in path.values():
            operation["responses"].pop("422")  # FastAPI's own, which no receiver needs to send
    schemas = found["components"]["schemas"]
    for name in ("HTTPValidationError", "ValidationError"):
        schemas.pop(name, None)
    schemas.update(_socket_messages() | schemas)
    return _renamed(found)


def _socket_messages() -> dict[str, Any]:
    """Return the schemas of the play socket's messages. OpenAPI describes no sockets, so no path refers to them."""
    _, schema = models_json_schema(
        [(model, "serialization") for model in PLAYED], ref_template="#/components/schemas/{model}"
    )
    messages: dict[str, Any] = schema["$defs"]
    return messages


def _state_problems(operation: dict[str, Any]) -> None:
    """Add to an operation the errors that every operation can return, all as problem documents."""
    responses: dict[str, Any] = operation["responses"]
    responses.pop("422", None) if _is_fastapis(responses.get("422")) else None
    for status, shared in SHARED.items():
        if status in {401, 403} and "security" not in operation:
            continue
        if status in {413, 415} and "requestBody" not in operation:
            continue
        stated = responses.setdefault(str(status), {"description": shared["description"], "content": {}})
        content = stated["content"].setdefault(problems.MEDIA_TYPE, {})
        content["examples"] = shared["content"][problems.MEDIA_TYPE]["examples"] | content.get("examples", {})
    for status, response in responses.items():
        if status >= "400":
            examples = response["content"][problems.MEDIA_TYPE]["examples"]
            response["content"] = {problems.MEDIA_TYPE: {"schema": PROBLEM, "examples": examples}}


def _is_fastapis(response: dict[str, Any] | None) -> bool:
    """Return whether a 422 response is FastAPI's own, which this server never sends."""
    return response is not None and "HTTPValidationError" in json.dumps(response)


def _renamed(document: dict[str, Any]) -> dict[str, Any]:
    """Rename schemas: `Ask-Output` becomes `Ask`, and `Ask-Input` becomes `AskInput`."""
    text = json.dumps(document)
    for name in document["components"]["schemas"]:
        if name.endswith("-Output"):
            text = text.replace(f'"{name}"', f'"{name.removesuffix("-Output")}"')
            text = text.replace(f'/{name}"', f'/{name.removesuffix("-Output")}"')
        elif name.endswith("-Input"):
            text = text.replace(f'"{name}"', f'"{name.replace("-", "")}"')
            text = text.replace(f'/{name}"', f'/{name.replace("-", "")}"')
    renamed: dict[str, Any] = json.loads(text)
    return renamed
