#!/usr/bin/env bash
# The release: the site in dist/, ready for any static host, and the single file beside it.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/env.sh

trunk --quiet build --release --offline
node tools/release.mjs
node tools/single.mjs
node tools/minify.mjs
