# Every goal sets up what it needs; the logic is in tools/.
.PHONY: help setup serve dev build single module check check-exports test bench fmt

PORT ?= 8080

help: ## list the goals
	@sed -n 's/^\([a-z-]*\):.*## /  make \1\t/p' Makefile | expand -t 23

setup: ## install what is missing: toolchain, build tools, Chromium, node modules
	@tools/setup.sh

serve: ## build the release and serve it on 127.0.0.1:8080 (PORT=… for another)
	@tools/setup.sh build
	@tools/build.sh
	@PORT=$(PORT) exec node tools/serve.mjs

dev: ## serve a development build that follows every edit
	@tools/setup.sh build
	@tools/run.sh trunk serve --offline --dist target/dist-dev

build: ## build the site into dist/, with the single file beside it
	@tools/setup.sh build
	@tools/build.sh

single: build ## the whole laboratory as one file: dist/quadtank.html

module: ## the core as a JavaScript module: the npm package in target/npm/quadtank, with an example beside it
	@tools/setup.sh build
	@tools/module.sh

check: ## format, lints and native tests: what is quick enough to run before every commit
	@tools/setup.sh build 2>&1
	@tools/run.sh node tools/test.mjs --quick 2>&1

check-exports: ## run exported scripts in Python and Octave, which hold their figures against those of the laboratory (ONLY=… for some)
	@tools/setup.sh exports 2>&1
	@tools/run.sh node tools/check-exports.mjs 2>&1

# What a step says on stderr goes to stdout, so that the total stays in the right place.
test: ## run everything: format, lints, native, browser and end-to-end tests
	@tools/setup.sh 2>&1 || { echo '0 passed, 1 failed'; exit 1; }
	@tools/run.sh node tools/test.mjs 2>&1

bench: ## measure speed and size, check margins of 1000 loops (BENCH=--write puts the tables into docs/benchmarks.md; PEER=1, LIGHTHOUSE=1 add comparisons)
	@tools/setup.sh >&2
	@tools/run.sh cargo test --locked -p quadtank-scenario --test documents margins -- --ignored >&2
	@tools/build.sh >&2
	@tools/run.sh node tools/bench.mjs $(BENCH)

fmt: ## format the Rust code
	@cargo fmt --all
