#!/bin/sh
# Ask a query with curl, lease it as an annotator, answer it, and read the answer.
#
#   LEARNER_TOKEN=wp_... ANNOTATOR_TOKEN=wp_... examples/curl.sh http://127.0.0.1:8000
set -eu

api="${1:-http://127.0.0.1:8000}/api/v1"

# call TOKEN METHOD PATH [BODY]: print the reply. After a refusal, print the explanation and stop.
call() {
  if ! reply=$(curl --silent --show-error --fail-with-body --max-time 90 --request "$2" "$api$3" \
    --header "Authorization: Bearer $1" --header "Content-Type: application/json" ${4:+--data "$4"}); then
    echo "$reply" >&2
    return 1
  fi
  printf '%s' "$reply"
}

# field KEY...: print one value of the JSON document on standard input.
field() {
  python3 -c '
import json, sys
value = json.load(sys.stdin)
for key in sys.argv[1:]:
    value = value[int(key) if key.isdigit() else key]
print(value)' "$@"
}

# The learner creates a run, and asks whether an episode accomplished the task.
run=$(call "$LEARNER_TOKEN" POST /runs '{"name": "curl", "algorithm": "custom", "seed": 0, "vocabulary":
  {"domain": "corridor", "renderer": "corridor", "subgoals": ["west", "east", "target"], "actions": ["west", "east"]}}')
run=$(printf '%s' "$run" | field id)
asked=$(call "$LEARNER_TOKEN" POST "/runs/$run/queries" '{"queries": [{"kind": "inspect_full", "episode": 0, "ordinal": 0,
  "question": "Did it do the whole task?", "instance": {"cells": 13, "start": 8, "target": 10},
  "segments": [{"subgoal": null, "states": [8, 9, 10], "actions": ["east", "east"]}]}]}')
query=$(printf '%s' "$asked" | field queries 0 id)
echo "Asked query $query in run $run."

# The annotator leases the next query of this run, and answers it.
assignment=$(call "$ANNOTATOR_TOKEN" POST /assignments "{\"run\": \"$run\", \"wait\": 30}")
id=$(printf '%s' "$assignment" | field id)
token=$(printf '%s' "$assignment" | field token)
receipt=$(call "$ANNOTATOR_TOKEN" POST "/assignments/$id/answer" \
  "{\"token\": \"$token\", \"answer\": {\"kind\": \"inspect_full\", \"verdict\": \"pass\"}}")
echo "Answered it for $(printf '%s' "$receipt" | field units) units."

# The learner waits for the answers after the cursor 0, marks the answer as used, and finishes the run.
answers=$(call "$LEARNER_TOKEN" GET "/runs/$run/answers?after=0&wait=30")
echo "The verdict is $(printf '%s' "$answers" | field queries 0 answer verdict)."
call "$LEARNER_TOKEN" POST "/queries/$query/use" >/dev/null
call "$LEARNER_TOKEN" PATCH "/runs/$run" '{"state": "finished"}' >/dev/null
