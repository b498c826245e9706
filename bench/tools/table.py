# SPDX-License-Identifier: Apache-2.0
"""A result (results.py) as one page of Markdown."""
import re

import results

CONTEXT = [  # key, words
    ("cpu", "processor"), ("num_cpus", "cores"), ("mhz_per_cpu", "MHz, as the system says"), ("caches", "caches"),
    ("memory", "memory"), ("governor", "governor"), ("huge_pages", "transparent huge pages"), ("os", "operating system"),
    ("compiler", "compiler"), ("flags", "flags"), ("evigrid", "evigrid"), ("evigrid_kernel", "kernel of automatic"),
    ("revision", "revision"), ("mode", "mode"), ("repetitions", "repetitions"), ("seeds", "seeds"),
    ("cell_bytes", "bytes per cell"), ("cold", "cold and warm"),
]


def seconds(x):
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if x >= size:
            return f"{x / size:.3g} {unit}"
    return f"{x / 1e-9:.3g} ns"


def rate(x):
    for unit, size in (("G", 1e9), ("M", 1e6), ("k", 1e3)):
        if x >= size:
            return f"{x / size:.3g} {unit}"
    return f"{x:.3g}"


def cell(text):
    return str(text).replace("|", "\\|").replace("\n", " ")


def markdown_table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(cell(c) for c in row) + " |" for row in rows]


def machine(context):
    rows = []
    for key, words in CONTEXT:
        if key not in context:
            continue
        value = context[key]
        if key == "caches":
            value = ", ".join(f"L{c['level']} {c['type'].lower()} {c['size'] // 1024} KiB" for c in value)
        rows.append((words, value))
    rows += [(f"input `{key[6:]}`", value) for key, value in sorted(context.items()) if key.startswith("input ")]
    return markdown_table(("what", "value"), rows)


def peer_rows(rows):
    """Peers' rows hold their ratios as counters NAME/PEER_per_cell and _per_scan."""
    out = []
    for r in rows:
        m = {k: results.median(r, k) for k in r["values"]}
        peer = "mrpt" if "mrpt_Mcell/s" in m else "peer"
        agree = (f"{m['IoU_free']:.2f} / {m['IoU_occupied']:.2f}", f"{m['unknown']:.3f} / {m['peer_unknown']:.3f}") \
            if "IoU_free" in m else ("", "")
        out.append((r["name"], f"{m[peer + '_Mcell/s']:.0f}", f"{m['1t_Mcell/s']:.0f}", f"{m['2t_Mcell/s']:.0f}",
                    f"{m[f'1t/{peer}_per_cell']:.2f}", f"{m[f'2t/{peer}_per_cell']:.2f}",
                    f"{m[f'1t/{peer}_per_scan']:.2f}", f"{m[f'2t/{peer}_per_scan']:.2f}",
                    f"{m[peer + '_scans/s']:.0f}", f"{m['1t_scans/s']:.0f}", *agree))
    return out


PEER_HEAD = ("row", "peer Mcell/s", "evigrid 1t", "2t", "ratio a cell, 1t", "2t", "ratio a scan, 1t", "2t",
             "peer scans/s", "evigrid 1t", "IoU free / occupied", "unknown: evigrid / peer")


def plain_rows(rows):
    out = []
    for r in rows:
        if r["error"]:
            out.append((r["name"], "not run", "", "", "", r["error"]))
            continue
        s = r["values"]["seconds"]
        items, size = results.median(r, "items_per_second"), results.median(r, "bytes_per_second")
        flop = results.median(r, "flop/s")
        known = {"seconds", "items_per_second", "bytes_per_second", "flop/s"}
        others = ", ".join(f"{k} {results.median(r, k):.4g}" for k in r["values"] if k not in known)
        out.append((r["name"], seconds(results.median(r, "seconds")),
                    f"{seconds(min(s))} – {seconds(max(s))}" if len(s) > 1 else "", rate(items) if items else "",
                    rate(size) + "B" if size else rate(flop) + "flop" if flop else "",
                    "; ".join(x for x in (r["label"], others) if x)))
    return out


def by_name(row):
    """Numbers in names by their size: repetitions are interleaved at random, so the order of the rows means nothing."""
    return [(int(part), "") if part.isdigit() else (-1, part) for part in re.split(r"(\d+)", row["name"])]


def page(result, name, pictures):
    """The whole page; `pictures` are (caption, file)."""
    lines = [f"# Benchmarks: {name}", "", "Written by `./bench.sh`; what each figure means: `docs/benchmarks.md`. Absolute",
             "speeds of a shared machine wander; ratios within a row come from turns taken in one process.", ""]
    lines += machine(result["context"])
    for caption, file in pictures:
        lines += ["", f"![{caption}]({file})", "", f"*{caption}*"]
    binaries = list(dict.fromkeys(r["binary"] for r in result["rows"]))
    for binary in binaries:
        rows = sorted((r for r in result["rows"] if r["binary"] == binary), key=by_name)
        peers = [r for r in rows if "1t_Mcell/s" in r["values"]]
        plain = [r for r in rows if "1t_Mcell/s" not in r["values"]]
        lines += ["", f"## {binary}", ""]
        if peers:
            lines += markdown_table(PEER_HEAD, peer_rows(peers)) + [""]
        if plain:
            lines += markdown_table(("row", "median", "min – max", "items/s", "bytes or flop/s", "more"), plain_rows(plain))
    return "\n".join(lines) + "\n"
