"""The server's app: routes, refusals, the built page, and what runs for as long as it does."""

import asyncio
import logging
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress

from fastapi import APIRouter, FastAPI
from starlette.middleware.gzip import GZipMiddleware

from server import openapi, page, problems, queue
from server.auth import Attempts, Credentials
from server.context import VERSION, Context
from server.database import Database
from server.errors import StorageFailed
from server.guard import Guard
from server.live import Hub
from server.practice import PracticeSet
from server.relay import Relay
from server.routes import (
    assignments,
    frames,
    gold,
    me,
    people,
    play,
    practice,
    queries,
    runs,
    system,
    watching,
)
from server.settings import Settings

API = "/api/v1"
GZIP_BYTES = 8_192

log = logging.getLogger("waypost")


def create_app(settings: Settings | None = None) -> FastAPI:
    """Return the app. Its store is opened, and brought up to this version's schema, when it starts."""
    chosen = settings or Settings()
    app = FastAPI(
        title="Waypost",
        version=VERSION,
        summary="Interactive labeling for hierarchical imitation learning.",
        openapi_url=f"{API}/openapi.json",
        docs_url=None,
        redoc_url=None,
        lifespan=lambda app: _lifespan(app, chosen),
    )
    api = APIRouter(prefix=API)
    for module in (runs, queries, assignments, play, watching, frames, people, me, gold, practice):
        api.include_router(module.router)
    app.include_router(api)
    app.include_router(system.router)
    problems.install(app)
    page.install(app, chosen.page)
    openapi.install(app)
    app.add_middleware(GZipMiddleware, minimum_size=GZIP_BYTES, compresslevel=5)
    app.add_middleware(
        Guard, hosts=chosen.hosts, max_body_bytes=chosen.max_body_bytes, body_seconds=chosen.body_seconds
    )
    return app


@asynccontextmanager
async def _lifespan(app: FastAPI, settings: Settings) -> AsyncIterator[None]:
    hub = Hub()
    db = await asyncio.to_thread(Database, settings.database, hub.committed)
    hub.open()
    app.state.context = Context(
        settings,
        db,
        hub,
        Credentials(db),
        Attempts(settings.login_failures),
        PracticeSet(settings.practice),
        Relay(),
    )
    reaper = asyncio.create_task(_reap(app.state.context))
    try:
        yield
    finally:
        reaper.cancel()
        with suppress(asyncio.CancelledError):
            await reaper
        hub.close()
        await asyncio.to_thread(db.close)


async def _reap(context: Context) -> None:
    """End expired leases for ever, so that a vanished annotator's query comes back by itself."""
    while True:
        await asyncio.sleep(context.settings.reap_seconds)
        try:
            await context.db.write(queue.expire)
        except StorageFailed as error:
            log.warning("Expired leases were not swept up: %s", error)
