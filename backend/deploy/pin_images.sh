#!/bin/sh
# Holds the images that are pulled to their digests, in Dockerfile and docker-compose.yml: NAME:TAG becomes
# NAME:TAG@sha256:... Run again it takes the digests the tags have by then. Needs docker with buildx, and the registry.
set -eu
files="${1:-Dockerfile} ${2:-docker-compose.yml}"
# shellcheck disable=SC2086  # two files
images=$(sed -nE 's/^(FROM|    image:) ([a-z]+:[0-9][A-Za-z0-9._-]*).*/\2/p' $files | sort -u)
for image in $images; do
  digest=$(docker buildx imagetools inspect "$image" --format '{{.Manifest.Digest}}')
  case $digest in
    sha256:*) ;;
    *) echo "$image: no digest but $digest" >&2; exit 1 ;;
  esac
  # shellcheck disable=SC2086
  sed -i -E "s|^(FROM\|    image:) $image(@sha256:[0-9a-f]+)?|\1 $image@$digest|" $files
  echo "$image@$digest"
done
