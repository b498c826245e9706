#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The examples of docs/scenes.md, run as a reader would run them. Usage: page_examples.py PROGRAM PAGE"""
import os
import re
import subprocess
import sys
import tempfile

program, page = os.path.abspath(sys.argv[1]), open(sys.argv[2], encoding="utf-8").read()
page = page[page.index("## Three examples"):]
# A fenced block takes its name from the last `name.ext` before it.
files = {}
for match in re.finditer(r"```\w*\n(.*?)```", page, re.S):
    names = re.findall(r"`([\w]+\.(?:toml|pgm))`", page[:match.start()])
    files[names[-1]] = match.group(1)
bad = []
if len(files) < 5:
    bad.append(f"only {sorted(files)} found: the page or this test has changed")
with tempfile.TemporaryDirectory() as folder:
    for name, text in files.items():
        open(os.path.join(folder, name), "w", encoding="utf-8").write(text)
    scenes = [name for name, text in files.items() if "[trajectory]" in text]
    for name in scenes:
        p = subprocess.run([program, "run", name, "-o", "out"], cwd=folder, capture_output=True, text=True)
        print(name, p.stdout.strip())
        if p.returncode != 0:
            bad.append(f"{name}: exit {p.returncode}: {p.stderr.strip()}")
    if len(scenes) < 3:
        bad.append(f"only {scenes} ran")
print("\n".join(bad))
sys.exit(1 if bad else 0)
