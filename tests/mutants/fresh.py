"""A plug-in of pytest: each test begins with empty caches, so that it calls all that it depends on.

Mutmut tries a mutant only with the tests that were seen to call its function.
"""

import sys

import pytest


@pytest.fixture(autouse=True)
def empty_caches() -> None:
    """Forget what functions of the server with a cache have returned."""
    for name, module in list(sys.modules.items()):
        if name.startswith("waypost_server."):
            for value in list(vars(module).values()):
                if hasattr(value, "cache_clear"):
                    value.cache_clear()
