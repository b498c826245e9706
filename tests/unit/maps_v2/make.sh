#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# How the maps of this folder were made, once and for ever, by the program of file version 2 and maths version 2:
#   tests/unit/maps_v2/make.sh build/evigrid FOLDER
# Never made anew: a later version has a folder of its own, and must go on reading this one. expected.txt holds, of each
# map, file, rule, tiles, sensors and the map hash that the program printed.
set -e
program=$1 folder=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
: > "$folder/expected.txt"
one() {  # name, then what `run` of the embedded scene takes besides
  name=$1
  shift
  "$program" run -o "$work/$name" --cell 0.25 --kernel scalar --executor serial "$@" >&2
  cp "$work/$name/map.evigrid" "$folder/$name.evigrid"
  "$program" info "$work/$name" --json - | python3 -c "import json, sys
m = json.load(sys.stdin)
print('$name.evigrid', m['rule'], m['tiles'], len(m['sensors']), m['map_hash'])" >> "$folder/expected.txt"
}
one pcr5 --rule pcr5
one history --rule yager --layers con,last_conflict
one forgets --rule dempster --decay 20
one conjunctive --rule conjunctive
one cautious --rule cautious
one dempster_log --rule dempster_log
one murphy --rule murphy
one bayes --rule bayes --bayes-limits 0.01,0.98
