#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Ratios of two builds from runs A1 B1 A2 B2 …: for each benchmark time of A over time of B (above 1: B is faster).
Usage: ab.py A1.json B1.json A2.json B2.json …   (in the order of running)"""
import statistics
import sys

import results


def ratios(pairs):
    """{name: [time of A / time of B, one a pair]} of the benchmarks that both sides ran."""
    out = {}
    for a_path, b_path in pairs:
        sides = []
        for path in (a_path, b_path):
            rows = results.read_google(path)[1]
            sides.append({(r["binary"], r["name"]): results.median(r, "seconds") for r in rows if not r["error"]})
        for key in sides[0].keys() & sides[1].keys():
            out.setdefault(key, []).append(sides[0][key] / sides[1][key])
    return out


def report(found):
    lines = ["| benchmark | A/B median | min | max |", "|---|---|---|---|"]
    for (binary, name), r in sorted(found.items()):
        note = "" if min(r) > 1 or max(r) < 1 else " (the runs disagree on who is faster)"
        lines.append(f"| {binary} {name} | {statistics.median(r):.3f} | {min(r):.3f} | {max(r):.3f}{note} |")
    return "\n".join(lines)


if __name__ == "__main__":
    files = sys.argv[1:]
    if not files or len(files) % 2:
        sys.exit(__doc__)
    print(report(ratios(list(zip(files[::2], files[1::2])))))
