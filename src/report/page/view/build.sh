#!/usr/bin/env bash
# Bundles view.js and what it uses of three.js into view.bundle.js, which is committed: building ribopt needs no Node.
# Needs Node and npm; with `--check` it says whether the committed bundle is what would be made.
set -euo pipefail
cd "$(dirname "$0")"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cp package.json package-lock.json view.js "$work"
(
	cd "$work"
	npm ci --silent --no-audit --no-fund
	printf '/* three.js, MIT licence, copyright 2010-2026 three.js authors: see LICENSE-three. */\n' >view.bundle.js
	npx esbuild view.js --bundle --minify --format=iife --target=es2021 --legal-comments=none --log-level=warning >>view.bundle.js
)
if [ "${1:-}" = "--check" ]; then
	cmp "$work/view.bundle.js" view.bundle.js
else
	cp "$work/view.bundle.js" view.bundle.js
	ls -l view.bundle.js
fi
