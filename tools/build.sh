#!/usr/bin/env bash
# The release: the site in dist/, ready for any static host, and the single file beside it.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/env.sh

# A failure is told by its message; a stack of Trunk itself helps nobody.
RUST_BACKTRACE=0 trunk --quiet build --release --offline
node tools/release.mjs
node tools/single.mjs
esbuild dist/*.js dist/*.css --minify --log-level=warning --outdir=dist --allow-overwrite
