#!/usr/bin/env bash
# Builds and tests the Python packages, in a virtual environment of their own (PYTHON: which interpreter; python3 if not said) with what the
# package index has. Ends with a wheel of each below 5 MB, and a wheel from the source distribution of each, built without a network.
set -euo pipefail
cd "$(dirname "$0")"

step() { printf '\n-- %s (%s s)\n' "$1" "$SECONDS"; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
export CARGO_TARGET_DIR=$PWD/target
# Stripped and linked as in a release, but sooner.
export CARGO_INCREMENTAL=0

step "environment"
[ -x .venv/bin/python ] || "${PYTHON:-python3}" -m venv .venv
export VIRTUAL_ENV=$PWD/.venv PATH=$PWD/.venv/bin:$PATH
python -m pip install --quiet --disable-pip-version-check --requirement requirements.txt

step "format and lint"
cargo fmt --check -p polycsg-python -p formfactor-python -p python-run
cargo clippy --release --all-targets --locked -- -D warnings
ruff format --check --quiet .
ruff check --quiet .
(cd polycsg && mypy)
(cd formfactor && mypy)

for package in polycsg formfactor; do
    step "$package"
    (
        cd "$package"
        maturin build --quiet --release --locked --out "$out/$package"
        pip install --quiet --disable-pip-version-check --no-deps --force-reinstall "$out/$package"/*.whl
        size=$(stat -c %s "$out/$package"/*.whl)
        [ "$size" -lt 5000000 ] || { echo "the wheel has $size bytes" >&2; exit 1; }
        # The package as it is installed, not the one beside the tests, which lacks what is compiled.
        python -m pytest -q
    )
done

step "source distributions"
for package in polycsg formfactor; do
    (cd "$package" && maturin sdist --out "$out/sources" 2>"$out/log" || { cat "$out/log" >&2; exit 1; })
done
CARGO_NET_OFFLINE=true pip wheel --quiet --no-build-isolation --no-deps --no-index --wheel-dir "$out/built" "$out"/sources/*.tar.gz
[ "$(ls "$out/built" | wc -l)" = 2 ] || { echo "a wheel is missing" >&2; exit 1; }
step "done"
