"""Prints the OpenAPI document: `python -m waypost_server.openapi`."""

import json
import sys

from waypost_server.app import create_app


def main() -> None:
    """Print the document."""
    json.dump(create_app().openapi(), sys.stdout, indent=2)
    sys.stdout.write("\n")


if __name__ == "__main__":
    main()
