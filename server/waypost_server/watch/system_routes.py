"""Health checks and metrics, for operators."""

from fastapi import APIRouter
from fastapi.responses import PlainTextResponse
from sqlalchemy import select

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import AnyoneCalls
from waypost_server.db.tables import runs
from waypost_server.db.transaction import Tx
from waypost_server.http.context import VERSION, Ctx
from waypost_server.http.problems import refusals
from waypost_server.watch import metrics

router = APIRouter(tags=["system"])


def _check_readable(tx: Tx) -> None:
    """Read a row of `runs`, to check that the database answers and has the tables."""
    tx.conn.execute(select(runs.c.id).limit(1)).all()


@router.get("/healthz", operation_id="healthz")
async def healthz() -> wire.Health:
    """Report that the process is alive."""
    return wire.Health(status="ok", version=VERSION)


@router.get("/readyz", operation_id="readyz", responses=refusals(errors.StorageFailed))
async def readyz(context: Ctx) -> wire.Health:
    """Report that the database answers and has this version's tables."""
    await context.db.read(_check_readable)
    return wire.Health(status="ok", version=VERSION)


@router.get("/metrics", operation_id="metrics", response_class=PlainTextResponse)
async def get_metrics(context: Ctx, _: AnyoneCalls) -> PlainTextResponse:
    """Return counts in Prometheus' text format."""
    text = await context.db.read(metrics.text)
    return PlainTextResponse(text, media_type="text/plain; version=0.0.4")
