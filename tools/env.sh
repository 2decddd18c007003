# The pinned tools and where they are; sourced by the other scripts, which run in the root of the repository.

TRUNK=0.21.14
# Trunk takes a wasm-bindgen from PATH only in the version that the lock file names.
BINDGEN=$(sed -n '/^name = "wasm-bindgen"$/{n;s/version = "\(.*\)"/\1/p}' Cargo.lock)
RUST=$(sed -n 's/^channel = "\(.*\)"/\1/p' rust-toolchain.toml)
NODE_MAJOR=20

E2E=tests/e2e
export PATH="$PWD/.tools/bin:$PWD/$E2E/node_modules/.bin:$PATH"

# What the release is compiled with, beside Cargo.toml: the standard library along with the rest and for size, and panics that
# stop without a message. That is a twelfth of the transfer. The flags are unstable; the compiler is pinned, so they stand still.
release_flags() {
  export RUSTC_BOOTSTRAP=1 CARGO_UNSTABLE_BUILD_STD=std,panic_abort CARGO_UNSTABLE_BUILD_STD_FEATURES=optimize_for_size
  # Set here, flags replace those of .cargo/config.toml.
  RUSTFLAGS=$(sed -n 's/^rustflags = \["\(.*\)"\]$/\1/p' .cargo/config.toml)
  export RUSTFLAGS="$RUSTFLAGS -Zunstable-options -Cpanic=immediate-abort -Zlocation-detail=none -Zfmt-debug=none"
}

first_of() {
  local name
  for name in "$@"; do command -v "$name" && return; done
  return 0
}
export CHROMIUM=${CHROMIUM:-$(first_of chromium chromium-browser google-chrome)}
export CHROMEDRIVER=${CHROMEDRIVER:-$(first_of chromedriver)}

# Trunk 0.21 reads NO_COLOR as true or false and stops at the usual 1.
if [ -n "${NO_COLOR:-}" ]; then export NO_COLOR=true; fi
