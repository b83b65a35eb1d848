#!/bin/sh
# Holds the images that are pulled to their digests, in the Dockerfile: NAME:TAG becomes NAME:TAG@sha256:... Run again it
# takes the digests the tags have by then. Needs docker with buildx, and the registry.
set -eu
file=${1:-Dockerfile}
for image in $(sed -nE 's/^FROM ([a-z]+:[0-9][A-Za-z0-9._-]*).*/\1/p' "$file" | sort -u); do
  digest=$(docker buildx imagetools inspect "$image" --format '{{.Manifest.Digest}}')
  case $digest in
    sha256:*) ;;
    *) echo "$image: no digest but $digest" >&2; exit 1 ;;
  esac
  sed -i -E "s|^FROM $image(@sha256:[0-9a-f]+)?|FROM $image@$digest|" "$file"
  echo "$image@$digest"
done
