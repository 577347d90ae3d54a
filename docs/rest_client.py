"""Lease and answer one query over REST, with only the standard library: `python rest_client.py SERVER`."""

import json
import os
import sys
from urllib.request import Request, urlopen

server, token = sys.argv[1].rstrip("/"), os.environ["WAYPOST_TOKEN"]


def call(method, path, body=None):
    headers = {"Authorization": f"Bearer {token}", "Content-Type": "application/json"}
    data = None if body is None else json.dumps(body).encode()
    with urlopen(Request(f"{server}/api/v1{path}", data, headers, method=method), timeout=90) as reply:
        return None if reply.status == 204 else json.load(reply)


assignment = call("POST", "/assignments", {"kinds": ["inspect_full"], "wait": 30})
if assignment is None:
    sys.exit("No query arrived within 30 seconds.")
run, ask = assignment["run"]["id"], assignment["query"]["ask"]
arrived = ask["segments"][-1]["states"][-1] == ask["instance"]["goal"]  # the maze's JSON view has the goal
answer = {"kind": "inspect_full", "verdict": "pass" if arrived else "fail"}
receipt = call("POST", f"/assignments/{assignment['id']}/answer", {"token": assignment["token"], "answer": answer})
print(f"{ask['question']} {answer['verdict']}: {receipt['units']:g} unit, query {receipt['query']}")
print(f"The run has cost {call('GET', f'/runs/{run}/costs')['total']:g} units.")
