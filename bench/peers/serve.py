"""Runs in the peers' environment: does a round of a module's work per line that comes in, and says what it took.

Started with a module of this folder and its settings as JSON. The first line out says which versions are measured;
then comes one line of JSON out, with the seconds, for every line in.
"""

import importlib
import json
import sys
import time
from importlib.metadata import version


def main() -> None:
    answers, sys.stdout = sys.stdout, sys.stderr  # what libraries print is no answer
    peer = importlib.import_module(sys.argv[1])
    work = peer.start(**json.loads(sys.argv[2]))
    print(json.dumps({"versions": {name: version(name) for name in peer.PACKAGES}}), file=answers, flush=True)
    for line in sys.stdin:
        asked = json.loads(line)
        began = time.perf_counter()
        work(**asked)
        print(json.dumps({"seconds": time.perf_counter() - began}), file=answers, flush=True)


if __name__ == "__main__":
    main()
