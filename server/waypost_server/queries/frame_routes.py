"""Routes of frames: a learner uploads pictures of states, and the web app shows them."""

from typing import Annotated

from fastapi import APIRouter, Path, Response

from waypost import wire
from waypost_server import errors
from waypost_server.auth.permissions import Allowed
from waypost_server.db.transaction import Tx
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.problems import refusals
from waypost_server.queries import frames, quotas

router = APIRouter(prefix="/frames", tags=["frames"], route_class=JsonRoute)

Hash = Annotated[str, Path(pattern=r"^[0-9a-f]{64}$", description="The SHA-256 of the PNG.")]
HEADERS = {
    "Cache-Control": "private, max-age=31536000, immutable",
    "Content-Security-Policy": "default-src 'none'; sandbox",
}


@router.put("", status_code=204, operation_id="putFrames", responses=refusals(errors.TooManyPictures))
async def put_frames(body: wire.FrameUpload, context: Ctx, caller: Allowed) -> None:
    """Upload pictures of states: all of them or none. Pictures that were uploaded before do not change."""
    files = frames.decode(body.frames, context.settings.max_frame_bytes)
    most = context.settings.max_user_frame_bytes

    def store(tx: Tx) -> None:
        if size := frames.store(tx, files, caller.user):
            quotas.use_bytes(tx, caller.user, size, most)

    await context.db.write(store)


@router.post("/missing", operation_id="missingFrames")
async def missing_frames(body: wire.FrameHashes, context: Ctx, _: Allowed) -> wire.FrameHashes:
    """Return the hashes of frames that are not stored yet."""
    return await context.db.read(lambda tx: wire.FrameHashes(hashes=frames.missing(tx, body.hashes)))


@router.get(
    "/{frame}",
    operation_id="getFrame",
    response_class=Response,
    responses=refusals(errors.NotFound) | {200: {"description": "The picture.", "content": {"image/png": {}}}},
)
async def get_frame(frame: Hash, context: Ctx, _: Allowed) -> Response:
    """Return a picture. The picture of a hash never changes."""
    png = await context.db.read(lambda tx: frames.find(tx, frame))
    return Response(png, media_type="image/png", headers=HEADERS)
