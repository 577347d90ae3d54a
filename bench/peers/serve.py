"""Does one round of work for each input line, and prints its duration. It runs in the peers' virtual environment.

Its arguments are a module of this folder and the settings of the module as JSON. The first output line contains the
versions of the measured packages. After this, every input line gives one output line with the seconds, both as JSON.
"""

import importlib
import json
import sys
import time
from importlib.metadata import version


def main() -> None:
    answers, sys.stdout = sys.stdout, sys.stderr  # keep the output of libraries out of the answers
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
