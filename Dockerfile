# The control room with its embedded worker. All data is in the volume /data.

FROM python:3.11-slim AS build
RUN apt-get update -qq && apt-get install -y -qq --no-install-recommends make
WORKDIR /opt/rths
COPY . .
RUN RTHS_CACHE=/opt/rths/cache make setup

FROM python:3.11-slim
WORKDIR /opt/rths
COPY --from=build /opt/rths /opt/rths
RUN useradd --system --uid 10001 rths && mkdir -m 700 /data /store && chown -R rths /data /opt/rths/cache /store
USER rths
ENV RTHS_DATA=/data RTHS_HOST=0.0.0.0 RTHS_PORT=8000 RTHS_CACHE=/opt/rths/cache
VOLUME /data
EXPOSE 8000
HEALTHCHECK --interval=10s --timeout=5s --start-period=60s \
    CMD [".venv/bin/python", "-c", "import urllib.request; urllib.request.urlopen('http://127.0.0.1:8000/healthz', timeout=4)"]
CMD [".venv/bin/rths", "serve"]
