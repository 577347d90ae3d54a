"""Alembic's entry point: runs the migrations on the connection that `db.schema` opened."""

from alembic import context

from waypost_server.db.tables import metadata

context.configure(
    connection=context.config.attributes["connection"],
    target_metadata=metadata,
    render_as_batch=context.config.attributes["connection"].dialect.name == "sqlite",
    transaction_per_migration=False,
)
context.run_migrations()
