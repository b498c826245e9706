#!/usr/bin/env bash
# symbols.sh LIBDIR: every symbol that our shared libraries show is ours, and is in a header; no kernel is among them.
set -euo pipefail
bad=0
for library in evigrid_engine evigrid_raycast evigrid; do
  file="$1/lib$library.so"
  shown=$(nm -DC --defined-only "$file" | cut -d' ' -f3-)
  count=$(wc -l <<<"$shown")
  [ "$count" -gt 10 ] || { echo "$file shows only $count symbols: the check itself is broken"; bad=1; }
  strange=$(grep -vE '^((typeinfo( name)?|vtable) for )?evigrid(::|_)' <<<"$shown" || true)
  inner=$(grep -E 'evigrid::(kernels|TileStore|ChangeLog|ViewState|MapAccess|Admission)' <<<"$shown" || true)
  [ -z "$strange" ] || { echo "$file shows what is not ours:"; echo "$strange"; bad=1; }
  [ -z "$inner" ] || { echo "$file shows its inside:"; echo "$inner"; bad=1; }
done
exit $bad
