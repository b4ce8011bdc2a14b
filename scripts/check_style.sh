#!/usr/bin/env bash
# Checks what needs no compiler: formatting, file sizes, include rules. scripts/tidy.sh checks names and functions.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
max_header_lines=199
max_source_lines=499

mapfile -t files < <(git ls-files --cached --others --exclude-standard -- '*.h' '*.cpp' |
  while read -r file; do [[ ! -e "$file" ]] || echo "$file"; done) # git lists what was deleted until it is committed
if [[ ${#files[@]} -eq 0 ]]; then
  echo "check_style.sh: git lists no C++ files here" >&2
  exit 1
fi

failed=0
clang-format --dry-run -Werror "${files[@]}" || failed=1

for file in "${files[@]}"; do
  [[ "$file" == *.h ]] && limit=$max_header_lines || limit=$max_source_lines
  lines="$(wc -l <"$file")"
  if ((lines > limit)); then
    echo "$file:$lines: $lines lines, more than $limit; split it" >&2
    failed=1
  fi
done

python3 scripts/check_layers.py --self-test || failed=1
python3 scripts/check_layers.py || failed=1

if ((failed)); then
  echo "check_style.sh: FAILED; 'clang-format -i FILE' fixes the formatting" >&2
  exit 1
fi
echo "Style: ${#files[@]} files are fine."
