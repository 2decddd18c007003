#!/usr/bin/env bash
# Installs what is missing, in pinned versions: `setup.sh build` what a build needs, `setup.sh` also what the tests need;
# `setup.sh exports` what runs exported scripts.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/env.sh

say() { printf 'setup: %s\n' "$*"; }
need() {
  printf 'setup: %s\n' "$*" >&2
  exit 1
}

prerequisites() {
  command -v rustup >/dev/null || need "rustup is missing. Install it from https://rustup.rs, then open a new shell."
  command -v cc >/dev/null || need "a C compiler (cc) is missing. On Debian: apt-get install build-essential"
  command -v node >/dev/null || need "Node.js is missing. Install version $NODE_MAJOR or later from https://nodejs.org."
  command -v npm >/dev/null || need "npm is missing. It comes with Node.js from https://nodejs.org."
  local major
  major=$(node --print 'process.versions.node.split(".")[0]')
  [ "$major" -ge "$NODE_MAJOR" ] || need "Node.js $major is too old. Install version $NODE_MAJOR or later from https://nodejs.org."
}

toolchain() {
  local installed
  installed=$({ rustup component list --toolchain "$RUST" --installed; } 2>/dev/null || true)
  local part
  for part in rustfmt clippy rust-std-wasm32-unknown-unknown; do
    grep -q "^$part" <<<"$installed" && continue
    say "Rust $RUST with clippy, rustfmt and the wasm32 target"
    rustup toolchain install "$RUST" --no-self-update --profile minimal --component clippy,rustfmt \
      --target wasm32-unknown-unknown
    return
  done
}

# Whether a tool says that it has this version.
is() { [ "$("$1" --version 2>/dev/null | awk '{ print $2; exit }')" = "$2" ]; }

# The binaries of a tool's publisher into .tools, where cargo-binstall is there to fetch them; in this version or not at all.
fetched() {
  command -v cargo-binstall >/dev/null || return
  say "$1 $2, by cargo-binstall"
  cargo binstall --no-confirm --log-level warn --strategies crate-meta-data --install-path .tools/bin "$1@$2" || {
    say "$1 $2 could not be fetched"
    return 1
  }
}

build_tools() {
  # A debug build of Trunk is as quick in use and compiles in a quarter of the time; without its default features it
  # can download nothing.
  is trunk "$TRUNK" || fetched trunk "$TRUNK" || {
    say "trunk $TRUNK, compiled once (about 2 minutes)"
    CARGO_PROFILE_DEV_DEBUG=0 CARGO_INCREMENTAL=0 cargo install --quiet --debug --locked --no-default-features \
      "trunk@$TRUNK" --root .tools --target-dir target/tools
  }
  { is wasm-bindgen "$BINDGEN" && is wasm-bindgen-test-runner "$BINDGEN"; } || fetched wasm-bindgen-cli "$BINDGEN" || {
    say "wasm-bindgen $BINDGEN, compiled once (about 2 minutes)"
    cargo install --quiet --locked --no-default-features --force \
      "wasm-bindgen-cli@$BINDGEN" --root .tools --target-dir target/tools
  }
  rm -rf target/tools
}

crates() {
  # Trunk builds offline, so everything in the lock file has to be here.
  cargo fetch --quiet --locked --offline 2>/dev/null || {
    say "the crates of Cargo.lock"
    cargo fetch --quiet --locked
  }
}

node_modules() {
  [ $E2E/node_modules/.package-lock.json -nt $E2E/package-lock.json ] || {
    say "Playwright, axe and wasm-opt, as in $E2E/package-lock.json"
    PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD=1 npm ci --prefix $E2E --no-audit --no-fund --loglevel=error
  }
}

# apt-get as root, as far as that is possible. sudo forgets the environment, so the variable goes behind it.
apt=(env DEBIAN_FRONTEND=noninteractive apt-get)
[ "$(id -u)" = 0 ] || apt=(sudo "${apt[@]}")
can_install() { command -v apt-get >/dev/null && { [ "$(id -u)" = 0 ] || sudo -n true 2>/dev/null; }; }

from_debian() {
  "${apt[@]}" update -qq
  "${apt[@]}" install -qq --no-install-recommends "$@" >/dev/null
}

browser() {
  [ -n "$CHROMIUM" ] && [ -n "$CHROMEDRIVER" ] && return
  can_install ||
    need "Chromium and ChromeDriver are missing and only root can install them. On Debian: apt-get install chromium" \
      "chromium-driver. Elsewhere, name the programs by the variables CHROMIUM and CHROMEDRIVER."
  say "Chromium and ChromeDriver from Debian"
  from_debian chromium chromium-driver
}

# Without it exported scripts run in Python alone, and the check says so.
octave() {
  command -v octave-cli >/dev/null && return
  say "Octave with its package control from Debian"
  { can_install && from_debian octave octave-control; } ||
    say "Octave is missing and could not be installed. On Debian: apt-get install octave octave-control"
}

what=${1:-all}
prerequisites
toolchain
crates
if [ "$what" != exports ]; then
  build_tools
  node_modules
fi
[ "$what" != all ] || browser
[ "$what" != exports ] || octave
say "ready (Rust $RUST, trunk $TRUNK, wasm-bindgen $BINDGEN)"
