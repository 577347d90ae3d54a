"""Health checks and metrics, for operators."""

from fastapi import APIRouter
from fastapi.responses import PlainTextResponse

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import Allowed
from waypost_server.http.context import VERSION, Ctx
from waypost_server.http.problems import refusals
from waypost_server.watch import metrics
from waypost_server.watch.readiness import Ready

router = APIRouter(tags=["system"])


@router.get("/healthz", operation_id="healthz")
async def healthz() -> wire.Health:
    """Report that the process is alive."""
    return wire.Health(status="ok", version=VERSION)


@router.get("/readyz", operation_id="readyz", responses=refusals(errors.StorageFailed, errors.Stopping))
async def readyz(readiness: Ready) -> wire.Health:
    """Report that the database can be read and written, and that the server goes on. One check serves a second."""
    await readiness.check()
    return wire.Health(status="ok", version=VERSION)


@router.get("/metrics", operation_id="metrics", response_class=PlainTextResponse)
async def get_metrics(context: Ctx, _: Allowed) -> PlainTextResponse:
    """Return metrics of the store and of this process in Prometheus' text format."""
    held = await context.db.read(metrics.of_store)
    done = metrics.of_process(context.db.counts, context.db.load, context.traffic)
    return PlainTextResponse("\n".join([*held, *done, ""]), media_type="text/plain; version=0.0.4")
