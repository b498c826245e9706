# SPDX-License-Identifier: Apache-2.0
"""Results of Google Benchmark: several JSON files become one small one, a list of values for every figure.

{"context": {...}, "rows": [{"binary", "name", "label", "error", "values": {"seconds": [...], "items_per_second": [...], ...}}]}
"""
import json
import pathlib
import re
import statistics

SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
# Of Google Benchmark itself: no figures of ours.
NOT_FIGURES = {"family_index", "per_family_instance_index", "repetitions", "repetition_index", "threads", "iterations",
               "real_time", "cpu_time"}


def rounded(x):
    """Six digits are more than any run repeats."""
    return float(f"{x:.6g}") if isinstance(x, float) else x


def plain_name(name):
    """Without what Google Benchmark hangs on: iterations, kind of time."""
    return re.sub(r"/(iterations:\d+|manual_time|real_time|process_time|repeats:\d+)(?=/|$)", "", name)


def read_google(path):
    """(context, rows) of one file that a benchmark wrote; aggregates are left out."""
    data = json.loads(pathlib.Path(path).read_text())
    rows = {}
    for b in data["benchmarks"]:
        if b.get("run_type") == "aggregate":
            continue
        name = plain_name(b.get("run_name", b["name"]))
        row = rows.setdefault(name, {"binary": pathlib.Path(data["context"]["executable"]).name, "name": name,
                                     "label": b.get("label", ""), "error": "", "values": {}})
        if b.get("error_occurred"):
            row["error"] = b.get("error_message", "failed")
            continue
        values = row["values"]
        values.setdefault("seconds", []).append(rounded(b["real_time"] * SECONDS[b["time_unit"]]))
        for key, value in b.items():
            if isinstance(value, (int, float)) and not isinstance(value, bool) and key not in NOT_FIGURES:
                values.setdefault(key, []).append(rounded(value))
    return data["context"], list(rows.values())


def merge(paths, more_context=()):
    """One result of many files. The machine's description comes from the first; `more_context` is of (key, value)."""
    context, rows = {}, []
    for path in paths:
        its_context, its_rows = read_google(path)
        for key in its_context:
            if key not in ("date", "executable", "load_avg", "library_build_type", "host_name"):
                context.setdefault(key, its_context[key])
        rows += its_rows
    context.update(more_context)
    return {"context": context, "rows": rows}


def save(result, path):
    """A row a line: differences between two results can be read."""
    lines = [json.dumps(row, ensure_ascii=False) for row in result["rows"]]
    text = '{"context": ' + json.dumps(result["context"], indent=1, ensure_ascii=False) + ',\n"rows": [\n'
    pathlib.Path(path).write_text(text + ",\n".join(lines) + "\n]}\n")


def load(path):
    return json.loads(pathlib.Path(path).read_text())


def median(row, key):
    values = row["values"].get(key)
    return statistics.median(values) if values else None


def find(result, pattern):
    """Rows whose whole name matches."""
    return [r for r in result["rows"] if re.fullmatch(pattern, r["name"])]


def threads_of(name):
    """(name without its thread count, thread count) for names that end in /threads:N, else (name, None)."""
    m = re.search(r"/threads:(\d+)$", name)
    return (name[:m.start()], int(m.group(1))) if m else (name, None)
