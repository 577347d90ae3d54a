"""Routes of the sign-in at an OpenID provider. The login page calls them before and after the provider's own pages."""

from typing import Annotated

from fastapi import APIRouter, Depends, Request, Response

from waypost import wire
from waypost_server import errors
from waypost_server.auth import oidc
from waypost_server.auth.lookup import Cached
from waypost_server.auth.permissions import HOST_ONLY, address_of, is_secure, refuse_cross_site
from waypost_server.http.context import Ctx
from waypost_server.http.jsonbody import JsonRoute
from waypost_server.http.problems import refusals
from waypost_server.users import performance, sign_in
from waypost_server.users.session_routes import set_cookie

router = APIRouter(tags=["people"], route_class=JsonRoute)

COOKIE = "waypost_sign_in"
COOKIE_SECONDS = 600  # how long somebody may be away at the provider


async def _provider(request: Request) -> oidc.Provider:
    """Return the provider of a request that comes from the login page.

    Raises:
        NotFound: the server has none.
        CrossSite: another site may have sent the request.
    """
    provider = oidc.provider_of(request)
    if provider is None:
        raise errors.NotFound("This server has no OpenID provider; open a login link instead.")
    if "sec-fetch-site" in request.headers or "origin" in request.headers:
        refuse_cross_site(request)
    return provider


_Provided = Annotated[oidc.Provider, Depends(_provider)]


@router.get("/sign-in", operation_id="getSignIn")
async def get_sign_in(request: Request) -> wire.SignInOffer:
    """Return at which OpenID provider people may sign in, if there is one. Login links always work."""
    provider = oidc.provider_of(request)
    return wire.SignInOffer(provider=None if provider is None else provider.name)


@router.post(
    "/sign-in",
    operation_id="beginSignIn",
    responses=refusals(errors.CrossSite, errors.NotFound, errors.ProviderFailed),
)
async def begin_sign_in(request: Request, response: Response, provider: _Provided) -> wire.SignInBegun:
    """Begin a sign-in: return the provider's address, and a cookie that lets this browser end the sign-in."""
    url, attempt = await provider.begin(_redirect(request))
    response.set_cookie(
        _cookie(request),
        attempt.cookie,
        max_age=COOKIE_SECONDS,
        path="/",
        httponly=True,
        samesite="strict",
        secure=is_secure(request),
    )
    return wire.SignInBegun(url=url)


@router.post(
    "/sign-in/reply",
    operation_id="endSignIn",
    responses=refusals(
        errors.SignInStale,
        errors.SignInFailed,
        errors.NoAccount,
        errors.NoRole,
        errors.Deactivated,
        errors.CrossSite,
        errors.NotFound,
        errors.ProviderFailed,
    ),
)
async def end_sign_in(
    body: wire.SignInReply, request: Request, response: Response, context: Ctx, cache: Cached, provider: _Provided
) -> wire.Me:
    """Exchange the provider's reply for a session cookie. The user gets the role that the provider says."""
    tried = request.state.sign_in = {"issuer": provider.issuer}  # for the audit log, if it is refused
    attempt = oidc.Attempt.of_cookie(request.cookies.get(_cookie(request)), body.state)
    try:
        if body.issuer not in {None, provider.issuer}:
            raise errors.SignInFailed("the reply came from another provider")
        if body.code is None:
            raise errors.SignInFailed("the provider did not sign you in")
        claims = await provider.end(attempt, _redirect(request), body.code)
        tried["subject"] = str(claims["sub"])[: oidc.MOST_SUBJECT]
        person = provider.person(claims)
    except errors.SignInFailed as failure:
        tried["fault"] = failure.fault
        raise
    settings, address = context.settings, address_of(request)
    rules = sign_in.Rules(settings.oidc_create, settings.session_seconds)
    session = await context.db.write(lambda tx: sign_in.sign_in(tx, person, rules, address))
    cache.clear()  # the role may be another one
    response.delete_cookie(_cookie(request), path="/", httponly=True, samesite="strict", secure=is_secure(request))
    set_cookie(context, request, response, session.secret)
    return await context.db.read(lambda tx: performance.me(tx, session.user))


def _cookie(request: Request) -> str:
    return HOST_ONLY + COOKIE if is_secure(request) else COOKIE


def _redirect(request: Request) -> str:
    """Return the address of the login page, to which the provider sends the browser back."""
    scheme = "https" if is_secure(request) else "http"
    return f"{scheme}://{request.headers['host']}/login"
