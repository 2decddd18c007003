#!/usr/bin/env bash
# The JavaScript module: the npm package in target/npm/quadtank, ready for `npm pack`, with examples/ beside it.
#
# `module.sh --beside-page` names the page too. Then cargo gives both the same features of all crates, and after a release of the page two crates
# are left to compile; alone, the module takes the features that it needs, and its crates are compiled anew.
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/env.sh

FILES=crates/quadtank-js/npm
OUT=target/npm/quadtank
BUILT=${CARGO_TARGET_DIR:-target}/wasm32-unknown-unknown/release/quadtank_js.wasm
VERSION=$(sed -n '/^\[workspace.package\]$/,/^$/s/^version = "\(.*\)"/\1/p' Cargo.toml)

PACKAGES=(--package quadtank-js)
[ "${1:-}" != --beside-page ] || PACKAGES+=(--package quadtank-lab)
cargo build --quiet --locked --offline --release --target wasm32-unknown-unknown "${PACKAGES[@]}"
rm -rf target/npm
mkdir -p $OUT
wasm-bindgen --target web --no-typescript --out-name quadtank --out-dir $OUT "$BUILT"
wasm-opt -O2 $OUT/quadtank_bg.wasm -o $OUT/quadtank_bg.wasm
cp $FILES/*.js $FILES/*.ts $FILES/README.md LICENSE-* $OUT
sed "s/\"version\": \"0.0.0\"/\"version\": \"$VERSION\"/" $FILES/package.json > $OUT/package.json
cp -r examples target/npm/examples
printf 'module: quadtank %s is in %s, %s KB of WebAssembly, %s KB in gzip\n' "$VERSION" $OUT \
  $(($(wc -c <$OUT/quadtank_bg.wasm) / 1000)) $(($(gzip -6c $OUT/quadtank_bg.wasm | wc -c) / 1000))
