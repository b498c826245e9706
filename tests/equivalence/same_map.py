#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The program from the outside: one map_hash for every kernel, executor and number of threads, and a report that says what
really ran. Usage: same_map.py PROGRAM map LOG [options] | same_map.py PROGRAM run. Exit 77 = skipped."""
import json
import os
import subprocess
import sys
import tempfile

program, what = sys.argv[1], sys.argv[2:]
if what[0] == "map" and not os.path.exists(what[1]):
    print("skipped: missing recorded data:", what[1])
    sys.exit(77)
info = subprocess.run([program, "info"], capture_output=True, text=True, check=True).stdout.lower()
bad, hashes, ran = [], {}, []
variants = [["--kernel", k] for k in ("scalar", "avx2", "avx512")]
variants += [["--executor", e, "--threads", n] for e in ("serial", "tbb", "openmp") for n in ("1", "2", "7")]
with tempfile.TemporaryDirectory() as folder:
    for flags in variants:
        p = subprocess.run([program, *what, "-o", folder + "/out", *flags], capture_output=True, text=True)
        if p.returncode == 2 and flags[0] == "--kernel" and "cannot run" in p.stderr:
            print("this processor cannot run", flags[1])
            continue
        if p.returncode != 0:
            bad.append(f"{flags}: exit {p.returncode}: {p.stderr.strip()}")
            continue
        r = json.load(open(folder + "/out/report.json"))
        hashes.setdefault((r["map_hash"], r["cells_updated"]), []).append(flags)
        ran.append(r["kernel"])
        if flags[0] == "--kernel" and r["kernel"] != flags[1]:
            bad.append(f"{flags}: the report says {r['kernel']}")
        if flags[0] == "--executor":
            serial = flags[1] == "serial"
            if r["executor"] != flags[1]:
                bad.append(f"{flags}: the report says {r['executor']}")
            if r["threads"] > (1 if serial else int(flags[3])) or sum(t > 0 for t in r["tiles_per_worker"]) != r["threads"]:
                bad.append(f"{flags}: threads {r['threads']}, tiles per worker {r['tiles_per_worker']}")
            if not serial and flags[3] == "7" and len(r["tiles_per_worker"]) != 7:
                bad.append(f"{flags}: {len(r['tiles_per_worker'])} workers, not 7")
if len(hashes) != 1:
    bad.append(f"hashes differ: {hashes}")
if len(ran) < 10:
    bad.append(f"only {len(ran)} variants ran")
print("\n".join(bad) if bad else f"{len(ran)} variants, one map: {next(iter(hashes))}")
sys.exit(1 if bad else 0)
