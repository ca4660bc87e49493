#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Writes real logs and has @mcap/core read them: finished, unfinished, repaired, and cut at every byte.
set -eu
writer=$1
folder=$2
here=$(dirname "$0")
if [ ! -d "$here/node_modules/@mcap/core" ]; then
  echo "skipped: @mcap/core is not installed; run: npm ci --prefix $here" >&2
  exit 77
fi
rm -rf "$folder"
mkdir -p "$folder"
"$writer" "$folder"
for log in "$folder"/*.mcap; do
  echo "$(basename "$log"): $(node "$here/read.mjs" "$log")"
done
echo "finished.mcap: $(node "$here/read.mjs" --cuts "$folder/finished.mcap")"
