# The pinned tools and where they are; sourced by the other scripts, which run in the root of the repository.

TRUNK=0.21.14
# Trunk takes a wasm-bindgen from PATH only in the version that the lock file names.
BINDGEN=$(sed -n '/^name = "wasm-bindgen"$/{n;s/version = "\(.*\)"/\1/p}' Cargo.lock)
RUST=$(sed -n 's/^channel = "\(.*\)"/\1/p' rust-toolchain.toml)
NODE_MAJOR=20

E2E=tests/e2e
export PATH="$PWD/.tools/bin:$PWD/$E2E/node_modules/.bin:$PATH"

first_of() {
  local name
  for name in "$@"; do command -v "$name" && return; done
  return 0
}
export CHROMIUM=${CHROMIUM:-$(first_of chromium chromium-browser google-chrome)}
export CHROMEDRIVER=${CHROMEDRIVER:-$(first_of chromedriver)}

# Trunk 0.21 reads NO_COLOR as true or false and stops at the usual 1.
if [ -n "${NO_COLOR:-}" ]; then export NO_COLOR=true; fi
