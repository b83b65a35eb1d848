#!/bin/sh
# Starts PostgreSQL with these options. The first time it makes the cluster, with checksums of its pages, in which the
# service's role owns the service's database and is no superuser. The superuser has no password, so it comes by the
# container's own socket alone: docker compose exec database psql -U postgres
set -eu
if [ ! -s "$PGDATA/PG_VERSION" ]; then
  chmod 700 "$PGDATA"
  new=$PGDATA/new  # moved when it is whole
  rm -rf "$new"
  initdb --pgdata="$new" --username=postgres --encoding=UTF8 --data-checksums --auth-local=trust --auth-host=scram-sha-256
  echo "host all all all scram-sha-256" >> "$new/pg_hba.conf"
  password=$(sed "s/'/''/g" /run/secrets/database_password)
  postgres --single -D "$new" postgres <<SQL
CREATE ROLE ridelab LOGIN PASSWORD '$password'
CREATE DATABASE ridelab OWNER ridelab
SQL
  find "$new" -mindepth 1 -maxdepth 1 -not -name PG_VERSION -exec mv {} "$PGDATA" \;
  mv "$new/PG_VERSION" "$PGDATA"
  rmdir "$new"
fi
exec postgres "$@"
