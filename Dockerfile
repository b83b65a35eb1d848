# The dashboard, built with the lock file's packages.
FROM node:24-slim AS frontend
WORKDIR /build
COPY frontend/.npmrc frontend/package.json frontend/package-lock.json ./
RUN npm ci --omit=dev --no-audit --no-fund
COPY frontend/ ./
COPY examples/paper-claims.json /examples/
RUN npm run build

# The manual, as pages.
FROM python:3.11-slim AS manual
WORKDIR /build
COPY requirements-manual.lock ./
RUN python -m pip install --no-cache-dir --disable-pip-version-check --require-hashes -r requirements-manual.lock
COPY zensical.toml ./
COPY docs/ docs/
COPY examples/ examples/
RUN python -m zensical build --strict && rm -f build/manual/404.html build/manual/sitemap.xml \
    && python -m zipfile -c build/manual/examples.zip examples

# The proxy of docker-compose.yml with its configuration, which any umask of the checkout leaves readable.
FROM haproxy:2.6-alpine AS proxy
COPY backend/deploy/haproxy.cfg backend/deploy/haproxy-docker.cfg /etc/
USER 0
RUN chmod 444 /etc/haproxy.cfg /etc/haproxy-docker.cfg
USER 99:99

# Its database, whose first start makes the service's role.
FROM postgres:15-bookworm AS database
COPY backend/deploy/database.sh /usr/local/bin/
USER 0
RUN chmod 555 /usr/local/bin/database.sh
USER 999:999

# The core's library, and the programs of FMUs for every platform. The compiler stays here.
FROM python:3.11-slim AS compiled
WORKDIR /build
COPY requirements-compiler.lock ./
RUN python -m pip install --no-cache-dir --disable-pip-version-check --require-hashes -r requirements-compiler.lock
COPY sim_core/kernel/ sim_core/kernel/
COPY sim_core/ecu/source/ sim_core/ecu/source/
RUN python sim_core/kernel/build.py .
COPY backend/fmu/ backend/fmu/
RUN python backend/fmu/programs.py all

# The runtime's packages, each held to its hash and without its tests, and the program.
FROM python:3.11-slim AS program
WORKDIR /build
RUN python -m venv --without-pip /opt/ridelab
COPY requirements-cluster.lock ./
RUN python -m pip --python /opt/ridelab/bin/python install --no-cache-dir --disable-pip-version-check --require-hashes \
    -r requirements-cluster.lock \
    && find /opt/ridelab -depth \( -type d \( -name tests -o -name test \) -o -name '*.a' \) -exec rm -r {} +

# Whatever umask the checkout has, everybody may read it.
WORKDIR /app
COPY sim_core/ sim_core/
COPY --from=compiled /build/libridelab*.so.1 sim_core/kernel/
COPY backend/ backend/
COPY --from=compiled /build/backend/fmu/binaries/ backend/fmu/binaries/
COPY client/ridelab/ ridelab/
COPY --from=frontend /build/dist frontend/dist/
COPY --from=manual /build/build/manual build/manual/
# Bytecode now: the file system is read-only later.
RUN /opt/ridelab/bin/python -m compileall -q sim_core backend ridelab && chmod -R a+rX .

FROM python:3.11-slim
COPY --from=program /opt/ridelab /opt/ridelab
COPY --from=program /app /app
WORKDIR /app
# /data belongs to the user, and so does a new volume mounted there.
RUN mkdir /data && chown 10001:10001 /data
ENV PATH=/opt/ridelab/bin:$PATH PYTHONDONTWRITEBYTECODE=1 PYTHONUNBUFFERED=1 RIDELAB_DATA_DIR=/data
# As for a service on loopback, which `docker run -p 127.0.0.1:8000:8000` makes of this one; docker-compose.yml has its own.
ENV RIDELAB_ALLOWED_HOSTS=localhost,*.localhost,127.0.0.1,::1
USER 10001:10001
VOLUME /data
EXPOSE 8000
HEALTHCHECK --interval=10s --timeout=3s --start-period=30s --retries=3 \
    CMD ["python", "-c", "import urllib.request; urllib.request.urlopen('http://127.0.0.1:8000/healthz', timeout=2)"]
CMD ["python", "-m", "backend", "--host", "0.0.0.0", "--port", "8000"]
