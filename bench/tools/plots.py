# SPDX-License-Identifier: Apache-2.0
"""Pictures of a result (results.py): the roofline and the scaling over threads. SVG without dates: equal results give
equal files."""
import re

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({"svg.hashsalt": "evigrid", "font.size": 8})
import matplotlib.pyplot as plt  # noqa: E402

import results  # noqa: E402

PLANE_BYTES = 8  # a float read and written
FAMILIES = {"dense": ("#1f77b4", "o"), "cone": ("#d62728", "s"), "fan": ("#2ca02c", "^")}
# (family, rows, how cells a second are told, bytes a cell, where the flop count stands). {0}, {1} … are groups.
POINTS = [
    ("dense", r"in_place/(\w+)/(?:cells:)?(\d+)/(?:threads:)?(\d+)", "items", 36, "ops/dense/{0}"),
    ("cone", r"sonar/(\w+?)\d+/half([\d.]+)/(\w+)/avx512", "peers", 3 * PLANE_BYTES, "ops/cone/{2}"),
    ("fan", r"building/(\w+)_pcr5_avx512/(?:threads:)?(\d+)", "items", 4 * PLANE_BYTES, "ops/fan/pcr5"),
]


def best(result, name, key):
    """The largest median of a yardstick that several binaries measured."""
    found = [results.median(r, key) for r in results.find(result, re.escape(name)) if not r["error"]]
    return max((f for f in found if f), default=None)


def roofline_points(result, threads):
    """(family, label, flop per byte, flop per second) of what ran on so many threads."""
    flops = {r["name"]: results.median(r, "flop") for r in result["rows"] if r["name"].startswith("ops/")}
    points = []
    for family, pattern, kind, size, ops in POINTS:
        for row in results.find(result, pattern):
            groups = re.fullmatch(pattern, row["name"]).groups()
            flop = flops.get(ops.format(*groups))
            if row["error"] or flop is None:
                continue
            if kind == "peers":
                rate = (results.median(row, f"{threads}t_Mcell/s") or 0) * 1e6
                label = f"{groups[2]} {groups[0]} {groups[1]}°"
            elif int(groups[-1]) == threads:
                rate, label = results.median(row, "items_per_second"), " ".join(groups[:-1])
            else:
                continue
            if rate:
                points.append((family, label, flop / size, rate * flop))
    return points


def roofline(result, path):
    panels = [t for t in (1, 2) if best(result, f"machine/peak_fma/threads:{t}", "flop/s")]
    if not panels:
        return False
    figure, axes = plt.subplots(1, len(panels), figsize=(6 * len(panels), 5), sharey=True, squeeze=False)
    for axis, threads in zip(axes[0], panels):
        fma = best(result, f"machine/peak_fma/threads:{threads}", "flop/s")
        separate = best(result, f"machine/peak_mul_add/threads:{threads}", "flop/s")
        roofs = [("L2 triad", "machine/l2_triad", "#888888"), ("memory, in place", "machine/stream_in_place", "#333333"),
                 ("memory, STREAM triad", "machine/stream_triad", "#aaaaaa")]
        points = roofline_points(result, threads)
        intensities = [p[2] for p in points] or [1]
        low, high = min(intensities + [0.1]) / 2, max(intensities + [10]) * 4
        for words, name, colour in roofs:
            bandwidth = best(result, f"{name}/threads:{threads}", "bytes_per_second")
            if not bandwidth:
                continue
            knee = min(fma / bandwidth, high)
            axis.plot([low, knee], [low * bandwidth / 1e9, knee * bandwidth / 1e9], color=colour, lw=1)
            axis.annotate(f"{words} {bandwidth / 1e9:.0f} GB/s", (low, low * bandwidth / 1e9), rotation=38, fontsize=6,
                          color=colour, va="bottom", rotation_mode="anchor")
        axis.axhline(fma / 1e9, color="k", lw=1)
        axis.annotate(f"fused multiply-add {fma / 1e9:.0f} Gflop/s", (high, fma / 1e9), ha="right", va="bottom", fontsize=6)
        if separate:
            axis.axhline(separate / 1e9 / 2, color="k", lw=0.7, ls=":")
            axis.annotate(f"one operation an instruction, not fused: {separate / 2e9:.0f}", (high, separate / 2e9),
                          ha="right", va="top", fontsize=6)
        for family, (colour, marker) in FAMILIES.items():
            own = [p for p in points if p[0] == family]
            if own:
                axis.plot([p[2] for p in own], [p[3] / 1e9 for p in own], marker, color=colour, ms=4, ls="", label=family)
        for number, (family, label, x, y) in enumerate(sorted(points, key=lambda p: (p[2], p[3]))):
            axis.annotate(label, (x, y / 1e9), xytext=(4 if number % 2 else -4, 0), textcoords="offset points", fontsize=5,
                          ha="left" if number % 2 else "right", va="center", color=FAMILIES[family][0])
        axis.set(xscale="log", yscale="log", xlim=(low, high), xlabel="flop per byte of cells read and written",
                 ylabel="Gflop/s", title=f"{threads} thread{'s' if threads > 1 else ''}")
        axis.grid(True, which="both", lw=0.2)
        axis.legend(loc="lower right")
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)
    return True


def speedups(result):
    """{what: {threads: times faster than on one}}: rows that end in /threads:N, and peers' rows with 1t and 2t."""
    times, out = {}, {}
    for row in result["rows"]:
        name, threads = results.threads_of(row["name"])
        if row["error"]:
            continue
        if threads:
            work = results.median(row, "items_per_second") or results.median(row, "bytes_per_second") or \
                results.median(row, "flop/s") or 1 / results.median(row, "seconds")
            times.setdefault((row["binary"], name), {})[threads] = work
        elif "2t/1t" in row["values"]:
            out[row["name"]] = {1: 1.0, 2: results.median(row, "2t/1t")}
    for (_, name), work in times.items():
        if 1 in work and len(work) > 1:
            out[name] = {t: w / work[1] for t, w in work.items()}
    return out


def scaling(result, path):
    found = sorted(speedups(result).items(), key=lambda item: max(item[1].values()))
    if not found:
        return False
    counts = sorted({t for _, s in found for t in s if t > 1})
    figure, axis = plt.subplots(figsize=(8, 1 + 0.16 * len(found)))
    for number, threads in enumerate(counts):
        at = [(s[threads], y) for y, (_, s) in enumerate(found) if threads in s]
        axis.plot([a[0] for a in at], [a[1] for a in at], "o", ms=4, color=f"C{number}", label=f"{threads} threads")
        axis.axvline(threads, color=f"C{number}", lw=0.8, ls="--")
    axis.axvline(1, color="k", lw=0.8)
    axis.set(yticks=range(len(found)), xlabel="times faster than on one thread (dashed: as many as threads)", xlim=(0, None),
             ylim=(-0.7, len(found) - 0.3))
    axis.set_yticklabels([name for name, _ in found], fontsize=5)
    axis.grid(True, axis="x", lw=0.2)
    axis.legend(loc="upper left")
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)
    return True


def draw_all(result, stem):
    """Draws beside `stem`; answers (caption, path) of what there was something to draw for."""
    drawn = []
    for draw, word, caption in (
            (roofline, "roofline", "Achieved against memory and against peak arithmetic, measured in the same run"),
            (scaling, "scaling", "Scaling over threads")):
        path = stem.parent / f"{stem.name}-{word}.svg"
        if draw(result, path):
            drawn.append((caption, path))
    return drawn
