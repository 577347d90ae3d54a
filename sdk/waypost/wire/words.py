"""Defines the base class and the shared types of all messages."""

from typing import Annotated, Literal, get_args

from pydantic import BaseModel, ConfigDict, Field, JsonValue, SerializeAsAny

__all__ = [
    "DEMO_FORMS",
    "KINDS",
    "DemoForm",
    "Disagreement",
    "FrameHash",
    "GoldRate",
    "Json",
    "Kind",
    "Message",
    "Name",
    "Note",
    "QueryState",
    "Role",
    "RunState",
    "Scope",
    "SecondShare",
    "Share",
    "Units",
    "Verdict",
]

Kind = Literal["hier_demo", "inspect_full", "label_hi", "inspect_lo", "label_lo", "label_full"]
KINDS: tuple[Kind, ...] = get_args(Kind)
DemoForm = Literal["hier_demo", "flat_demo", "play_on"]
"""How a demonstration is asked for: hierarchical, flat, or from a state where the learner failed."""
DEMO_FORMS: tuple[DemoForm, ...] = get_args(DemoForm)
Verdict = Literal["pass", "fail"]
RunState = Literal["running", "paused", "finished"]
QueryState = Literal["open", "leased", "answered", "cancelled"]
Disagreement = Literal["suggestion", "policy", "gold", "second"]
Role = Literal["admin", "learner", "annotator", "viewer"]
Scope = Literal["read", "answer", "learn", "manage"]

Json = Annotated[JsonValue, SerializeAsAny()]
"""Any JSON value, serialized as it is. Otherwise pydantic would check each value again in Python when in a union."""

Name = Annotated[str, Field(min_length=1, max_length=100, pattern=r"^[^\x00-\x1f\x7f]+$")]
Note = Annotated[str, Field(max_length=500, pattern=r"^[^\x00]*$")]
GoldRate = Annotated[
    float,
    Field(
        ge=0,
        le=0.5,
        allow_inf_nan=False,
        description="The share of gold queries among an annotator's queries, 0 to 0.5.",
    ),
]
SecondShare = Annotated[
    float,
    Field(
        ge=0,
        le=1,
        allow_inf_nan=False,
        description="The share of the run's queries that a second annotator answers as well, 0 to 1. A demonstration "
        "is never answered twice.",
    ),
]
Units = Annotated[float, Field(ge=0, le=1e9, allow_inf_nan=False)]
Share = Annotated[float, Field(ge=0, le=1, allow_inf_nan=False)]
FrameHash = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$", description="The SHA-256 of a PNG file, in hexadecimal.")]


class Message(BaseModel):
    """The base class of all messages. It rejects unknown fields and values of the wrong type, such as "3" for 3."""

    model_config = ConfigDict(extra="forbid", strict=True, json_schema_serialization_defaults_required=True)
