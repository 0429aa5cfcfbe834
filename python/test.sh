#!/usr/bin/env bash
# Builds and tests the Python packages, in a virtual environment of their own (PYTHON: which interpreter; python3 if not said) with
# what the package index has: wheels of less than 5 MB, built from the source distributions without a network.
set -euo pipefail
cd "$(dirname "$0")"

step() { printf '\n-- %s (%s s)\n' "$1" "$SECONDS"; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}
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
        # From the source distribution, as somebody without a network would build it.
        maturin sdist --out "$out/sources" 2>"$out/log" || { cat "$out/log" >&2; exit 1; }
        CARGO_NET_OFFLINE=true pip wheel --quiet --disable-pip-version-check --no-build-isolation --no-deps --no-index \
            --wheel-dir "$out/wheels" "$out/sources/$package"-*.tar.gz
        pip install --quiet --disable-pip-version-check --no-deps --force-reinstall "$out/wheels/$package"-*.whl
        size=$(stat -c %s "$out/wheels/$package"-*.whl)
        [ "$size" -lt 5000000 ] || { echo "the wheel has $size bytes" >&2; exit 1; }
        python -m pytest -q
    )
done
step "done"
