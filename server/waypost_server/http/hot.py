"""Routes that are called for every query. They read requests and write replies themselves.

FastAPI finds the parameters of an endpoint anew for each request, which takes longer than leasing a query. A hot route
is declared and documented like any other, but its parameters are found once, when the server starts.
"""

from collections.abc import Awaitable, Callable, Coroutine
from typing import Annotated, Any, get_args, get_origin, get_type_hints

from fastapi import Request, Response
from fastapi.exceptions import RequestValidationError
from fastapi.params import Depends, Header
from fastapi.routing import APIRoute
from fastapi.security.base import SecurityBase
from pydantic import BaseModel, TypeAdapter, ValidationError
from pydantic_core import from_json
from starlette.requests import HTTPConnection

Finder = Callable[[Request], Awaitable[Any]]
"""Returns the value of a dependency."""

NOTHING: list[Any] = [{"type": "missing", "loc": ("body",), "msg": "Field required", "input": None}]


class HotRoute(APIRoute):
    """A route whose endpoint takes the request, dependencies, parameters of the path, headers and one JSON body.

    The body is parsed as strictly as RFC 8259 allows, to a depth of 200.
    """

    def get_route_handler(self) -> Callable[[Request], Coroutine[Any, Any, Response]]:
        """Return the handler.

        Raises:
            TypeError: the endpoint takes something else.
        """
        endpoint = self.endpoint
        dependencies, others = _split(endpoint)
        path, headers, bodies = dict[str, TypeAdapter[Any]](), dict[str, tuple[str, TypeAdapter[Any]]](), list[Any]()
        for name, hint in others.items():
            mark = get_args(hint)[1] if get_origin(hint) is Annotated else None
            if f"{{{name}}}" in self.path_format:
                path[name] = TypeAdapter(hint)
            elif isinstance(mark, Header):
                headers[name] = str(mark.alias), TypeAdapter(hint)
            elif isinstance(hint, type) and issubclass(hint, BaseModel) and not bodies:
                bodies.append((name, TypeAdapter(hint)))
            else:
                raise TypeError(f"A hot route cannot read the parameter {name} of {self.name}.")
        written = None if self.response_model is None else TypeAdapter(self.response_model)
        status = self.status_code or 200

        async def handle(request: Request) -> Response:
            sent = await _parsed(request) if bodies else None
            values = {name: await find(request) for name, find in dependencies}
            faults: list[Any] = []
            for name, adapter in path.items():
                _read(values, faults, name, adapter, ("path", name), request.path_params[name])
            for name, (alias, adapter) in headers.items():
                if alias in request.headers:
                    _read(values, faults, name, adapter, ("header", alias), request.headers[alias])
            for name, adapter in bodies:
                _read(values, faults, name, adapter, ("body",), sent)
            if faults:
                raise RequestValidationError(faults, body=sent)
            result = await endpoint(**values)
            if isinstance(result, Response):
                return result
            if written is None:
                return Response(status_code=status)
            return Response(written.dump_json(result), status, media_type="application/json")

        return handle


def _split(function: Callable[..., Any]) -> tuple[list[tuple[str, Finder]], dict[str, Any]]:
    """Return the parameters of a function that are dependencies, and the types of the others."""
    found, others = list[tuple[str, Finder]](), dict[str, Any]()
    for name, hint in get_type_hints(function, include_extras=True).items():
        mark = get_args(hint)[1] if get_origin(hint) is Annotated else None
        if isinstance(mark, Depends) and mark.dependency is not None:
            found.append((name, _finder(mark.dependency)))
        elif hint in {Request, HTTPConnection}:
            found.append((name, _request))
        elif name != "return":
            others[name] = hint
    return found, others


def _finder(dependency: Any) -> Finder:
    """Return a dependency with its own dependencies found."""
    if isinstance(dependency, SecurityBase):
        return _nothing
    needed, _ = _split(dependency)

    async def find(request: Request) -> Any:
        return await dependency(**{name: await one(request) for name, one in needed})

    return find


async def _request(request: Request) -> Request:
    return request


async def _nothing(_: Request) -> None:
    """Stand for what only documents how a caller is authenticated."""


async def _parsed(request: Request) -> Any:
    sent = await request.body()
    if not sent:
        raise RequestValidationError(NOTHING)
    try:
        return from_json(sent, allow_inf_nan=False)
    except ValueError as error:
        fault = {"type": "json_invalid", "loc": ("body", 0), "msg": "JSON decode error", "input": {}}
        raise RequestValidationError([fault | {"ctx": {"error": str(error)}}]) from None


def _read(
    values: dict[str, Any], faults: list[Any], name: str, adapter: TypeAdapter[Any], place: tuple[str, ...], sent: Any
) -> None:
    try:
        values[name] = adapter.validate_python(sent)
    except ValidationError as error:
        faults += [fault | {"loc": (*place, *fault["loc"])} for fault in error.errors(include_url=False)]
