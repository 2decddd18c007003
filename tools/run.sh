#!/usr/bin/env bash
# Runs a command with the pinned tools on PATH.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/env.sh
exec "$@"
