"""The context of a request: the settings, the store and the wake-ups of the server that handles it."""

from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from typing import Annotated, cast

from fastapi import Depends
from starlette.requests import HTTPConnection

from waypost_server.db.engine import Database
from waypost_server.db.wakeups import Hub
from waypost_server.http.traffic import Traffic
from waypost_server.settings import Settings

try:
    VERSION = version("waypost")
except PackageNotFoundError:  # run from a checkout that was not installed
    VERSION = "0.0.0"


@dataclass(frozen=True)
class Context:
    """The objects that every request can use."""

    settings: Settings
    db: Database
    hub: Hub
    traffic: Traffic


async def context_of(connection: HTTPConnection) -> Context:
    """Return the context of the app that serves a request or a socket."""
    return cast(Context, connection.app.state.context)


Ctx = Annotated[Context, Depends(context_of)]
