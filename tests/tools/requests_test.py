#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every test that docs/requests.md names as a proof is there: requests_test.py CTEST BUILD_DIR REQUESTS.md"""
import pathlib
import re
import subprocess
import sys

ctest, build, page = sys.argv[1:]
listing = subprocess.run([ctest, "--test-dir", build, "-N"], capture_output=True, text=True, check=True).stdout
there = re.findall(r"Test +#\d+: (\S+)", listing)
named = re.findall(r"`([A-Z]\w+(?:[./]\w+|\.\*|/\*)|consumer_\w+|exported_symbols|capi\w*|python|bench_tools)`",
                   pathlib.Path(page).read_text())
bad = [] if len(named) > 25 else [f"only {len(named)} tests found in {page}: the check itself is broken"]
for name in named:
    begin = name[:-1] if name.endswith("*") else name
    if not any(t.startswith(begin) if name.endswith("*") else t == begin for t in there):
        bad.append(f"{page}: no test is called {name}")
print("\n".join(bad) if bad else f"{len(named)} tests named, all there")
sys.exit(1 if bad else 0)
