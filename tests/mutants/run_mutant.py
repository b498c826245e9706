#!/usr/bin/env python3
"""Builds a copy of the sources with one deliberate mistake in it and wants the named tests to fail.
Only the portable kernels are built, lightly optimised, and of each program only the tests of the mutant's filter run.
Usage: run_mutant.py SOURCE_DIR WORK_DIR MUTANTS.json NUMBER [CMAKE ARGUMENTS ...]
Exit status: 0 the tests failed, as they must; 1 they passed: the mistake would go unseen; 2 the mutant itself is out of
date (its text is not there exactly once) or does not compile."""
import json
import pathlib
import re
import shutil
import subprocess
import sys

KEPT = ("CMakeLists.txt", "cmake", "kernels", "engine", "tests")


def run(*command):
    return subprocess.run(command, capture_output=True, text=True)


def copy_sources(source, to):
    """Only what is new or different, so that a second mutant in the same folder compiles only what it changes."""
    for name in KEPT:
        for path in [source / name] if (source / name).is_file() else sorted((source / name).rglob("*")):
            if not path.is_file():
                continue
            target = to / path.relative_to(source)
            if target.exists() and target.read_bytes() == path.read_bytes():
                continue
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, target)


def main(source, work, mutants, number, *cmake):
    source, work = pathlib.Path(source), pathlib.Path(work)
    mutant = json.loads(pathlib.Path(mutants).read_text())[int(number)]
    tree = work / "source"
    copy_sources(source, tree)
    file = tree / mutant["file"]
    text = file.read_text()
    if text.count(mutant["from"]) != 1:
        print(f"{mutant['name']}: its text stands {text.count(mutant['from'])} times in {mutant['file']}, not once")
        return 2
    file.write_text(text.replace(mutant["from"], mutant["to"]))
    off = [f"-DEVIGRID_BUILD_{part}=OFF" for part in ("DRIVER", "RAYCAST", "BENCH", "SHARED", "C", "PYTHON")]
    off += ["-DEVIGRID_INSTALL=OFF", "-DEVIGRID_SIMD=OFF"]  # the portable kernels have the same text, and compile in minutes
    for step in (
        ["cmake", "-S", str(tree), "-B", str(work / "build"), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Debug",
         "-DCMAKE_CXX_FLAGS_DEBUG=-O1", *off, *cmake],
        ["cmake", "--build", str(work / "build"), "--target", *mutant["tests"]],
    ):
        done = run(*step)
        if done.returncode != 0:
            print(f"{mutant['name']}: does not build\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
            return 2
    for name in mutant["tests"]:
        program = next((work / "build").rglob(name))
        done = run(str(program), "--gtest_fail_fast", "--gtest_brief=1", "--gtest_filter=" + mutant.get("filter", "*"))
        if done.returncode != 0:
            failed = re.findall(r"\[  FAILED  \] (\S+)", done.stdout)
            print(f"{mutant['name']}: seen by {name}, {failed[0] if failed else 'which crashed'}")
            return 0
    print(f"{mutant['name']}: {', '.join(mutant['tests'])} passed with it")
    return 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
