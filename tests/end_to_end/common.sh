# SPDX-License-Identifier: Apache-2.0
# Sourced by the end-to-end tests. Each is called as: TEST.sh PFSEQ_PROGRAM SOURCE_FOLDER
set -euo pipefail

pfseq=$1
source_folder=$2
work=$(mktemp -d)
trap 'chmod -R u+w "$work" 2>/dev/null; rm -rf "$work"' EXIT
cd "$work"
# Stored light stays here as well.
export XDG_CACHE_HOME=$work/cache
tiny=$source_folder/data/sequences/tiny.yaml

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# expect_failure STATUS TEXT COMMAND...: the command ends with this status and one line on standard error that holds TEXT
expect_failure() {
  local status=$1 text=$2 actual=0
  shift 2
  "$@" >stdout.txt 2>stderr.txt || actual=$?
  [ "$actual" -eq "$status" ] || fail "expected exit status $status, got $actual: $*: $(cat stderr.txt)"
  grep -qF -- "$text" stderr.txt || fail "expected '$text' on standard error of: $*; got: $(cat stderr.txt)"
  [ "$(grep -c '^pfseq: ' stderr.txt)" -eq 1 ] || fail "expected one line 'pfseq: ...' from: $*; got: $(cat stderr.txt)"
}

# expect_same_folders A B: the same files with the same bytes
expect_same_folders() {
  diff -r "$1" "$2" >difference.txt || fail "$1 and $2 differ: $(head -n 5 difference.txt)"
}
