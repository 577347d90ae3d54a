# Builds two images: `--target server` (the server with the web app) and `--target learner` (the same with PyTorch).
# requirements/ has the version and the hashes of each Python package; scripts/lock writes it.

FROM node:22-slim AS page
WORKDIR /src/web
COPY web/package.json web/package-lock.json web/.npmrc ./
RUN npm ci --no-audit --no-fund
COPY web/ ./
RUN npm run build


FROM python:3.13-slim-trixie AS wheel
WORKDIR /src
RUN python -m venv /opt/waypost
COPY requirements/ requirements/
RUN pip install --no-cache-dir --no-deps --require-hashes -r requirements/build.txt
COPY pyproject.toml README.md LICENSE ./
COPY sdk/ sdk/
COPY server/ server/
COPY learner/ learner/
COPY web/hatch_build.py web/
# The build hook uses the web app that is already built, so this stage needs no Node.
COPY --from=page /src/web/dist/ web/dist/
RUN pip wheel --no-cache-dir --no-deps --no-build-isolation --wheel-dir /wheels .


FROM wheel AS server-environment
RUN /opt/waypost/bin/pip install --no-cache-dir --no-deps --require-hashes -r requirements/server.txt
RUN /opt/waypost/bin/pip install --no-deps --no-index /wheels/*.whl && /opt/waypost/bin/pip check


FROM wheel AS learner-environment
RUN /opt/waypost/bin/pip install --no-cache-dir --no-deps --require-hashes -r requirements/learner.txt
# CPU-only builds of PyTorch save gigabytes (docs/operator.md). Such an index has other files of the same version, whose
# hashes are not known here.
ARG TORCH_INDEX_URL=
RUN if [ -z "$TORCH_INDEX_URL" ]; \
    then /opt/waypost/bin/pip install --no-cache-dir --no-deps --require-hashes -r requirements/torch.txt; \
    else /opt/waypost/bin/pip install --no-cache-dir --no-deps --index-url "$TORCH_INDEX_URL" \
           "$(sed -n 's/^\(torch==[^ ]*\).*/\1/p' requirements/torch.txt)"; \
    fi
RUN /opt/waypost/bin/pip install --no-deps --no-index /wheels/*.whl


# Debian 13, because its PostgreSQL programs are as new as the database of docker-compose.yml (17).
FROM python:3.13-slim-trixie AS runtime
RUN useradd --system --uid 10001 --home-dir /data waypost \
 && mkdir /data /tokens \
 && chown waypost /data /tokens
ENV PATH=/opt/waypost/bin:$PATH PYTHONUNBUFFERED=1
USER waypost
WORKDIR /data


FROM runtime AS learner
COPY --from=learner-environment /opt/waypost /opt/waypost
CMD ["waypost", "--help"]


FROM runtime AS server
# pg_dump and pg_restore, for `waypost backup` and `restore`.
USER root
RUN apt-get update \
 && apt-get install --yes --no-install-recommends postgresql-client \
 && rm -rf /var/lib/apt/lists/*
USER waypost
COPY --from=server-environment /opt/waypost /opt/waypost
ENV WAYPOST_DATABASE=sqlite:////data/waypost.db
EXPOSE 8000
HEALTHCHECK --interval=10s --timeout=5s --start-period=20s \
  CMD ["python", "-c", "import urllib.request; urllib.request.urlopen('http://127.0.0.1:8000/readyz', timeout=4)"]
CMD ["waypost", "serve", "--host", "0.0.0.0", "--port", "8000"]
