# Two commands do everything on a machine with the Rust toolchain, a C compiler, make and Python:
#   make run    builds ribopt and solves an example
#   make test   runs all tests, documentation examples included

CARGO ?= cargo
EXAMPLE ?= problems/haunched-floor-rib.toml
# cmake as pip installs it for one user lies there.
export PATH := $(HOME)/.local/bin:$(PATH)

.PHONY: run test build cmake

run: build
	./target/release/ribopt solve $(EXAMPLE)

test: cmake
	$(CARGO) test --release --workspace

build: cmake
	$(CARGO) build --release

# NLopt's sources are built by cmake. apt-get where we may, pip otherwise.
cmake:
	@if ! command -v cmake >/dev/null; then \
		echo "installing cmake, which builds NLopt"; \
		{ [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null && apt-get update && apt-get install -y cmake; } || \
		python3 -m pip install --user cmake || \
		python3 -m pip install --user --break-system-packages cmake || \
		{ echo "cmake could not be installed; install it by hand, or build without NLopt: cargo build --release --no-default-features" >&2; exit 1; }; \
	fi
