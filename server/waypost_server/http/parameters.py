"""Parameters that many routes share."""

from typing import Annotated

from fastapi import Path, Query

RowPath = Annotated[int, Path(ge=1, le=2**63 - 1)]
"""A row's id in the path."""

RowQuery = Annotated[int, Query(ge=0, le=2**63 - 1)]
"""A row's id in the query string; 0 is before the first row."""

Seconds = Annotated[
    float, Query(ge=0, le=60, allow_inf_nan=False, description="The longest time to wait for a change, in seconds.")
]

DryRun = Annotated[bool, Query(description="Only say what would be deleted.")]
