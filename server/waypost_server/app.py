"""The app: routes, error handling, the web app's files, and the background task that ends expired leases."""

import asyncio
import logging
from collections.abc import AsyncIterator, Sequence
from contextlib import asynccontextmanager
from functools import cache

from fastapi import APIRouter, FastAPI
from sqlalchemy.exc import DBAPIError
from starlette.middleware.gzip import GZipMiddleware
from starlette.routing import BaseRoute
from uvicorn.middleware.proxy_headers import ProxyHeadersMiddleware

from waypost import tracing
from waypost_server.answers import routes as answers
from waypost_server.answers.review import routes as review
from waypost_server.auth import oidc, refusals
from waypost_server.auth.access import ACCESS
from waypost_server.auth.attempts import LoginAttempts
from waypost_server.auth.lookup import CredentialCache
from waypost_server.db.engine import Database
from waypost_server.db.transaction import Tx
from waypost_server.db.wakeups import Hub
from waypost_server.errors import StorageFailed
from waypost_server.gold import practice_routes as practice
from waypost_server.gold import routes as gold
from waypost_server.gold.practice import open_practice
from waypost_server.http import description, page, problems, spa
from waypost_server.http.background import going_on
from waypost_server.http.context import VERSION, Context
from waypost_server.http.guard import Guard
from waypost_server.http.traffic import Traffic
from waypost_server.leases import routes as leases
from waypost_server.leases.service import end_future, expire
from waypost_server.play import routes as play
from waypost_server.play.relay import Relay
from waypost_server.queries import frame_routes as frames
from waypost_server.queries import routes as queries
from waypost_server.runs import routes as runs
from waypost_server.settings import Settings
from waypost_server.users import routes as users
from waypost_server.users import session_routes as sessions
from waypost_server.users import sign_in_routes as sign_in
from waypost_server.watch import audit_routes as audit
from waypost_server.watch import event_routes as event_streams
from waypost_server.watch import routes as watch
from waypost_server.watch import system_routes as system
from waypost_server.watch.readiness import Readiness
from waypost_server.webhooks import routes as webhooks
from waypost_server.webhooks.courier import delivering

API = "/api/v1"
GZIP_BYTES = 8_192  # smaller responses are not compressed
# Routes are tried in this order, so those that are called most come first.
ROUTED = (
    *(answers, leases, queries, runs, play, watch, event_streams),
    *(frames, users, sessions, sign_in, gold, review, practice, webhooks, audit),
)

log = logging.getLogger("waypost")


def create_app(settings: Settings | None = None) -> FastAPI:
    """Return the app. On start it opens the store, which must have this version's schema or be empty.

    Raises:
        BadProvider: the settings of the OpenID provider cannot be used.
    """
    chosen, traffic = settings or Settings(), Traffic()
    app = FastAPI(
        title="Waypost",
        version=VERSION,
        summary="Interactive labeling for hierarchical imitation learning.",
        openapi_url=f"{API}/openapi.json",
        docs_url=None,
        redoc_url=None,
        routes=[*_routes()],
        webhooks=webhooks.sent,
        lifespan=lambda app: _lifespan(app, chosen, traffic),
    )
    app.state.provider = oidc.open_provider(chosen)
    problems.install(app)
    refusals.install(app)
    description.install(app, {operation: rule.words for operation, rule in ACCESS.items()})
    page.install(app)
    spa.install(app, chosen.page)  # the last, because it handles every other path
    app.add_middleware(GZipMiddleware, minimum_size=GZIP_BYTES, compresslevel=5)
    app.add_middleware(
        Guard,
        hosts=chosen.hosts,
        max_body_bytes=chosen.max_body_bytes,
        body_seconds=chosen.body_seconds,
        traffic=traffic,
    )
    if chosen.trusted_proxies:
        app.add_middleware(ProxyHeadersMiddleware, trusted_hosts=[str(one) for one in chosen.trusted_proxies])
    return app


@cache
def _routes() -> Sequence[BaseRoute]:
    """Return the routes, which all apps of a process share: FastAPI needs some 0.1 s of CPU to prepare them."""
    together = APIRouter()
    for module in ROUTED:
        together.include_router(module.router, prefix=API)
    together.include_router(system.router)
    return together.routes


@asynccontextmanager
async def _lifespan(app: FastAPI, settings: Settings, traffic: Traffic) -> AsyncIterator[None]:
    hub = Hub()
    db = await asyncio.to_thread(Database, settings.database, hub.committed)
    hub.open()
    app.state.context = Context(settings, db, hub, traffic)
    app.state.credentials = CredentialCache(db)
    app.state.refusals = refusals.Refusals(db)
    app.state.attempts = LoginAttempts(settings.login_failures)
    app.state.practice = await open_practice(db, settings.practice, settings.max_frame_bytes)
    app.state.relay = Relay()
    app.state.readiness = Readiness(db)
    context = app.state.context
    try:
        async with going_on(_end_expired_leases(context)), app.state.refusals.sweeping(), delivering(context):
            yield
    finally:
        hub.close()
        await asyncio.to_thread(db.close)
        await asyncio.to_thread(tracing.flush)


def _reap(tx: Tx) -> None:
    expire(tx)
    end_future(tx)


async def _end_expired_leases(context: Context) -> None:
    """End expired leases forever, so that the queries of an annotator who vanished return to the queue."""
    while True:
        await asyncio.sleep(context.settings.reap_seconds)
        try:
            await context.db.write(_reap)
        except (StorageFailed, DBAPIError) as error:
            log.warning("Expired leases could not be ended: %s", error)
