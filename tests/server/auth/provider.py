"""An OpenID provider in the test process. It signs in whoever asks, and can be made to cheat."""

import base64
import hashlib
import json
import secrets
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import parse_qs, unquote, urlencode

import uvicorn
from joserfc import jwt
from joserfc.jwk import KeySet, OctKey, RSAKey
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import JSONResponse, RedirectResponse, Response
from starlette.routing import Route

from waypost_server import serving

CLIENT, SECRET = "waypost", "s3cret/+ %"
Json = dict[str, Any]


def _base64(content: bytes) -> str:
    return base64.urlsafe_b64encode(content).rstrip(b"=").decode()


def new_key() -> RSAKey:
    """A key that signs ID tokens."""
    return RSAKey.generate_key(2048, {"use": "sig"}, auto_kid=True)


@dataclass
class FakeProvider:
    """What the provider says and does. The claims are those of the person who signs in next."""

    issuer: str
    claims: Json = field(default_factory=lambda: {"sub": "u-1", "preferred_username": "zoe"})
    key: RSAKey = field(default_factory=new_key)
    signs_with: RSAKey | OctKey | None = None  # another key than the published one
    kid: str | None = None  # the name of the key in tokens, if not that of the published one
    algorithm: str = "RS256"
    metadata: Json = field(default_factory=dict)  # overrides the description of the provider
    verifier: str | None = None  # checks the PKCE challenge against this one, as if another client had sent it
    auth: str = "client_secret_basic"
    refuses: str | None = None  # the error with which it sends browsers back
    codes: dict[str, Json] = field(default_factory=dict)
    asked: list[Json] = field(default_factory=list)  # the parameters of each request to sign in

    @property
    def app(self) -> Starlette:
        return Starlette(
            routes=[
                Route("/realm/.well-known/openid-configuration", self.describe),
                Route("/realm/authorize", self.authorize),
                Route("/realm/token", self.token, methods=["POST"]),
                Route("/realm/keys", self.keys),
            ]
        )

    async def describe(self, request: Request) -> Response:
        said = {
            "issuer": self.issuer,
            "authorization_endpoint": f"{self.issuer}/authorize",
            "token_endpoint": f"{self.issuer}/token",
            "jwks_uri": f"{self.issuer}/keys",
            "response_types_supported": ["code"],
            "subject_types_supported": ["public"],
            "id_token_signing_alg_values_supported": ["RS256"],
            "token_endpoint_auth_methods_supported": [self.auth],
        }
        return JSONResponse(said | self.metadata)

    async def keys(self, request: Request) -> Response:
        return JSONResponse(KeySet([self.key]).as_dict(private=False))

    async def authorize(self, request: Request) -> Response:
        asked = dict(request.query_params)
        self.asked.append(asked)
        reply = {"state": asked["state"], "iss": self.issuer}
        if self.refuses is not None:
            return RedirectResponse(f"{asked['redirect_uri']}?{urlencode(reply | {'error': self.refuses})}", 302)
        code = secrets.token_urlsafe(16)
        self.codes[code] = asked
        return RedirectResponse(f"{asked['redirect_uri']}?{urlencode(reply | {'code': code})}", 302)

    async def token(self, request: Request) -> Response:
        form = {name: values[0] for name, values in parse_qs((await request.body()).decode()).items()}
        if not self._knows_client(request, form):
            return JSONResponse({"error": "invalid_client"}, 401)
        asked = self.codes.pop(form["code"], None)  # a code works once
        if asked is None or asked["redirect_uri"] != form["redirect_uri"]:
            return JSONResponse({"error": "invalid_grant", "error_description": "unknown code"}, 400)
        digest = hashlib.sha256((self.verifier or form["code_verifier"]).encode()).digest()
        if _base64(digest) != asked["code_challenge"]:
            return JSONResponse({"error": "invalid_grant", "error_description": "code_verifier"}, 400)
        return JSONResponse({"access_token": "at", "token_type": "Bearer", "id_token": self.id_token(asked["nonce"])})

    def _knows_client(self, request: Request, form: Json) -> bool:
        if self.auth == "client_secret_post":
            return (form.get("client_id"), form.get("client_secret")) == (CLIENT, SECRET)
        if self.auth == "none":
            return form.get("client_id") == CLIENT and "authorization" not in request.headers
        scheme, _, sent = request.headers.get("authorization", "").partition(" ")
        name, _, secret = base64.b64decode(sent).decode().partition(":")
        return scheme == "Basic" and (unquote(name), unquote(secret)) == (CLIENT, SECRET)

    def id_token(self, nonce: str) -> str:
        """Sign the claims; those that are None are left out."""
        now = int(time.time())
        usual = {"iss": self.issuer, "aud": CLIENT, "iat": now, "exp": now + 300, "nonce": nonce}
        claims = {name: value for name, value in (usual | self.claims).items() if value is not None}
        header = {"alg": self.algorithm, "kid": self.kid or self.key.kid}
        if self.algorithm == "none":
            return ".".join(_base64(json.dumps(part).encode()) for part in (header, claims)) + "."
        return jwt.encode(header, claims, self.signs_with or self.key, algorithms=[self.algorithm])


@contextmanager
def provider(host: str = "127.0.0.1") -> Iterator[FakeProvider]:
    """Run a provider on a thread for as long as the context lasts."""
    bound = serving.bind("127.0.0.1", 0)
    fake = FakeProvider(f"http://{host}:{bound.getsockname()[1]}/realm")
    server = uvicorn.Server(uvicorn.Config(fake.app, log_config=None, lifespan="off"))
    thread = threading.Thread(target=server.run, args=([bound],), daemon=True)
    thread.start()
    while not server.started:
        time.sleep(0.01)
    try:
        yield fake
    finally:
        server.should_exit = True
        thread.join()
        bound.close()
