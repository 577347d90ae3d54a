"""OpenTelemetry traces: one for each episode of a run, from its questions to the training on their answers.

Server and learner need not tell each other which trace a question belongs to: the ids follow from the run and the
number of the episode. So a trace goes on after a restart of either. `install` sends the traces to a collector; without
it, a step costs almost nothing.
"""

import hashlib
import logging
import os
import threading
import time
from collections.abc import Mapping
from contextvars import ContextVar
from dataclasses import dataclass, field

from opentelemetry import trace
from opentelemetry.context import Context
from opentelemetry.trace import NonRecordingSpan, SpanContext, TraceFlags

ADDRESSES = ("OTEL_EXPORTER_OTLP_TRACES_ENDPOINT", "OTEL_EXPORTER_OTLP_ENDPOINT")
"""OpenTelemetry's own settings, with the address of a collector."""
_FLUSH_SECONDS = 2.0

_log = logging.getLogger("waypost")
_tracer = trace.get_tracer("waypost")

planned: ContextVar[tuple[int, int] | None] = ContextVar("planned", default=None)
"""The ids of the trace and of the span that begins next; None if both are drawn."""

Attributes = Mapping[str, str | int | float | bool]


@dataclass(frozen=True)
class Step:
    """Something that was done about an episode: it is a span of the episode's trace.

    Args:
        name: such as "lease".
        run: the run's id.
        episode: the episode's number.
        attributes: what else is known.
        began: when it began, in nanoseconds since the epoch.
    """

    name: str
    run: str
    episode: int
    attributes: Attributes = field(default_factory=dict)
    began: int = field(default_factory=time.time_ns)

    def end(self) -> None:
        """Add the span, which ends now, below the first span of the trace."""
        if is_on():
            self._end(_below_first(self.run, self.episode))

    def end_as_first(self) -> None:
        """Add the span, which ends now, as the first span of the trace: the episode as a whole."""
        token = planned.set(ids_of(self.run, self.episode))
        try:
            self._end(Context())
        finally:
            planned.reset(token)

    def _end(self, context: Context) -> None:
        span = _tracer.start_span(self.name, context, start_time=self.began)
        span.set_attributes({"waypost.run": self.run, "waypost.episode": self.episode, **self.attributes})
        span.end()


def ids_of(run: str, episode: int) -> tuple[int, int]:
    """Return the ids of an episode's trace and of its first span, of 128 and 64 bits."""
    digest = hashlib.sha256(f"waypost {run} {episode}".encode()).digest()
    return int.from_bytes(digest[:16], "big"), int.from_bytes(digest[16:24], "big")


def _below_first(run: str, episode: int) -> Context:
    trace_id, span_id = ids_of(run, episode)
    first = SpanContext(trace_id, span_id, is_remote=True, trace_flags=TraceFlags(TraceFlags.SAMPLED))
    return trace.set_span_in_context(NonRecordingSpan(first), Context())


def is_on() -> bool:
    """Return whether spans go anywhere. To make one that does not is wasted time."""
    return not isinstance(trace.get_tracer_provider(), trace.ProxyTracerProvider)


def install(service: str) -> None:
    """Send the steps of this process to a collector, if the environment names one.

    If OpenTelemetry's SDK is not installed, a warning says so.

    Args:
        service: the name under which the collector shows this process, unless OTEL_SERVICE_NAME gives another.
    """
    if not any(os.environ.get(name) for name in ADDRESSES):
        return
    try:
        from waypost.tracing_sdk import start
    except ImportError:
        _log.warning(
            "There are no traces, because OpenTelemetry's SDK is not installed: `pip install 'waypost[telemetry]'`, or "
            "unset %s.",
            " and ".join(ADDRESSES),
        )
    else:
        start(os.environ.get("OTEL_SERVICE_NAME", service))


def flush() -> None:
    """Send what was not sent yet. What a collector does not take within two seconds is lost."""
    provider = trace.get_tracer_provider()
    if hasattr(provider, "force_flush"):  # its own limit has no effect
        sending = threading.Thread(target=provider.force_flush, daemon=True)
        sending.start()
        sending.join(_FLUSH_SECONDS)
