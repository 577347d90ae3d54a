"""Send the steps of `waypost.tracing` to a collector. Only this file needs OpenTelemetry's SDK."""

from opentelemetry import trace
from opentelemetry.exporter.otlp.proto.http.trace_exporter import OTLPSpanExporter
from opentelemetry.sdk.resources import SERVICE_NAME, Resource
from opentelemetry.sdk.trace import TracerProvider
from opentelemetry.sdk.trace.export import BatchSpanProcessor
from opentelemetry.sdk.trace.id_generator import RandomIdGenerator

from waypost.tracing import planned


class _PlannedIds(RandomIdGenerator):
    """Draws ids, except those that are planned."""

    def generate_trace_id(self) -> int:
        chosen = planned.get()
        return super().generate_trace_id() if chosen is None else chosen[0]

    def generate_span_id(self) -> int:
        chosen = planned.get()
        return super().generate_span_id() if chosen is None else chosen[1]


def start(service: str) -> None:
    """Send spans from now on, in batches on a thread. OpenTelemetry's settings say to which collector.

    When the process ends, nothing more is sent: call `waypost.tracing.flush` before.
    """
    resource = Resource.create({SERVICE_NAME: service})
    provider = TracerProvider(resource=resource, id_generator=_PlannedIds(), shutdown_on_exit=False)
    provider.add_span_processor(BatchSpanProcessor(OTLPSpanExporter()))
    trace.set_tracer_provider(provider)
