#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The Dockerfile and the definition of Apptainer run the same commands on Debian 12.
set -euo pipefail
cd "$PIOLA_SOURCE_DIR"
tools/check_container --compare
grep -qx 'From: debian:12-slim' packaging/piola.def
# The comparison can fail.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/tools" "$folder/packaging"
cp tools/check_container "$folder/tools/"
cp Dockerfile "$folder/"
sed 's/tools.make_packages/true/' packaging/piola.def >"$folder/packaging/piola.def"
if "$folder/tools/check_container" --compare; then
  echo "a definition that builds nothing was taken for the same"
  exit 1
fi
