#!/bin/sh
# Makes what docker-compose.yml reads from secrets/: the database's password, Dask's certificate with the authority that
# signed it, a certificate for the proxy that signed itself (put your own in its place: certificates and key in one PEM
# file), and an empty list of tokens; beside it the folder for controllers of one's own. What is there already stays; to
# change something delete it and run this again. On a machine with one processor it also writes .env, as
# docker-compose.yml would ask for two. Needs openssl.
set -eu
folder=${1:-secrets}
mkdir -p "$folder"
if [ "$(getconf _NPROCESSORS_ONLN)" = 1 ] && [ ! -e "$folder/../.env" ]; then
  printf '%s=1\n' API_CPUS DATABASE_CPUS API_WORKERS WORKER_CORES > "$folder/../.env"
fi
mkdir -p "$folder/../controllers"
chmod 755 "$folder/../controllers"
# Containers read the files as users of their own, so the files are open and the folder is not.
chmod 700 "$folder"
cd "$folder"
curve="-newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes"

[ -s database_password ] || openssl rand -hex 32 > database_password
[ -e tokens ] || echo "# NAME TOKEN on each line; openssl rand -hex 24 makes a token" > tokens

if [ ! -s proxy.pem ]; then
  host=${RIDELAB_HOST:-localhost}
  case $host in
    *:*) kind=IP ;;  # of version 6
    *[!0-9.]*) kind=DNS ;;
    *) kind=IP ;;
  esac
  openssl req -x509 $curve -days 825 -subj "/CN=$host" \
    -addext "subjectAltName=$kind:$host,DNS:localhost,IP:127.0.0.1" -keyout key.tmp -out proxy.tmp
  cat proxy.tmp key.tmp > proxy.pem
fi

if [ ! -s dask_ca.pem ] || [ ! -s dask_cert.pem ] || [ ! -s dask_key.pem ]; then
  openssl req -x509 $curve -days 3650 -subj "/CN=Ridelab's Dask authority" -keyout ca_key.tmp -out dask_ca.pem
  openssl req $curve -subj "/CN=Ridelab's Dask" -keyout dask_key.pem -out request.tmp
  echo "extendedKeyUsage=serverAuth,clientAuth" > extensions.tmp
  openssl x509 -req -in request.tmp -CA dask_ca.pem -CAkey ca_key.tmp -CAcreateserial -CAserial serial.tmp \
    -days 3650 -extfile extensions.tmp -out dask_cert.pem
fi
rm -f ./*.tmp  # the authority's key too: whoever has it could sign more
chmod 644 tokens
chmod 444 proxy.pem database_password dask_ca.pem dask_cert.pem dask_key.pem
