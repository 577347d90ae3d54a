"""The receiver that the documentation shows, run as it is against a real server."""

import os
import re
import subprocess
import sys
from contextlib import contextmanager

import httpx2
from tests.acceptance.processes import free_port
from tests.repository.kit import ROOT

from waypost_server.auth import tokens
from waypost_server.settings import Settings
from waypost_server.users import service as users

PAGE = (ROOT / "docs" / "integrations.md").read_text()


def receiver_code(port: int) -> str:
    (code,) = re.findall(r"^```python\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)
    assert "9000" in code
    return code.replace("9000", str(port))


@contextmanager
def receiver(port: int, secret: str):
    """The documented program; it ends after one request."""
    command = [sys.executable, "-c", receiver_code(port)]
    environment = {**os.environ, "WEBHOOK_SECRET": secret}
    with subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, text=True) as program:
        try:
            yield program
        finally:
            program.kill()


def test_the_receiver_in_the_documentation_verifies_and_reads_a_message(start_server, sqlite_url):
    port = free_port()
    settings = Settings(
        database=sqlite_url,
        webhook_hosts=(f"127.0.0.1:{port}",),
        webhook_networks=("127.0.0.0/8",),
        webhook_retry_seconds=0.1,
    )
    served = start_server(settings)
    admin = served.db.write_now(users.ensure_administrator)
    token = served.db.write_now(lambda tx: tokens.create_token(tx, admin.id, "")).token
    with httpx2.Client(base_url=f"{served.url}/api/v1", headers={"Authorization": f"Bearer {token}"}) as client:
        made = client.post("/webhooks", json={"url": f"http://127.0.0.1:{port}/"}).json()
        with receiver(port, made["secret"]) as program:
            queued = client.post(f"/webhooks/{made['webhook']['id']}/ping").json()
            printed, _ = program.communicate(timeout=60)
    assert printed == f"{queued['message']} ping webhook={made['webhook']['id']}\n"


def test_the_receiver_in_the_documentation_refuses_a_forged_message():
    port = free_port()
    with receiver(port, "whsec_c2VjcmV0IHNlY3JldCBzZWNyZXQgc2VjcmV0") as program:
        headers = {"webhook-id": "msg_1", "webhook-timestamp": "1", "webhook-signature": "v1,Zm9yZ2Vk"}
        transport = httpx2.HTTPTransport(retries=8)  # until the program listens
        with httpx2.Client(transport=transport, timeout=60) as client:
            reply = client.post(f"http://127.0.0.1:{port}/", content=b"{}", headers=headers)
        printed, _ = program.communicate(timeout=60)
    assert (reply.status_code, printed) == (401, "")
