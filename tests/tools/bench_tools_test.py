#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""bench/tools on a tiny result whose figures can be checked by hand."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
TOOLS = HERE.parent.parent / "bench" / "tools"
SAMPLE = HERE / "sample.json"
sys.dont_write_bytecode = True
sys.path.insert(0, str(TOOLS))
import ab  # noqa: E402
import results  # noqa: E402
import table  # noqa: E402

DENSE = "in_place/pcr5/cells:16777216/threads:1"


class Results(unittest.TestCase):
    def setUp(self):
        self.result = results.merge([SAMPLE], [("mode", "short")])

    def row(self, name):
        (row,) = [r for r in self.result["rows"] if r["name"] == name]
        return row

    def test_repetitions_are_kept_and_aggregates_are_not(self):
        self.assertEqual(self.row(DENSE)["values"]["seconds"], [0.02, 0.025, 0.04])
        self.assertEqual(results.median(self.row(DENSE), "items_per_second"), 7e8)

    def test_context_tells_the_machine_and_nothing_that_differs_between_runs(self):
        self.assertEqual(self.result["context"]["mode"], "short")
        self.assertEqual(self.result["context"]["flags"], "Release: -O3")
        for key in ("date", "load_avg", "executable", "host_name"):
            self.assertNotIn(key, self.result["context"])

    def test_a_row_that_did_not_run_has_its_reason_and_no_time(self):
        row = self.row("building/intel_pcr5_avx512/1")
        self.assertEqual((row["error"], row["values"]), ("missing: log", {}))

    def test_saved_and_loaded_again(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "r.json"
            results.save(self.result, path)
            self.assertEqual(results.load(path), self.result)

    def test_thread_counts(self):
        self.assertEqual(results.threads_of("a/b/threads:12"), ("a/b", 12))
        self.assertEqual(results.threads_of("a/b/12"), ("a/b/12", None))


class Table(unittest.TestCase):
    def test_page(self):
        text = table.page(results.merge([SAMPLE]), "sample", [("A caption", "x.svg")])
        self.assertIn(f"| {DENSE} | 25 ms | 20 ms – 40 ms | 700 M |", text)
        self.assertIn("| machine/peak_fma/threads:1 | 1 ms |  |  | 200 Gflop |", text)
        self.assertIn("| sonar/warm1024/half15/li2014_pcr5/avx512 | 900 | 340 | 560 | 0.38 | 0.63 | 0.37 | 0.61 |", text)
        self.assertIn("| building/intel_pcr5_avx512/1 | not run |", text)
        self.assertIn("![A caption](x.svg)", text)
        self.assertIn("A \\| B", text)  # a bar in a cell must not make a column
        widths = {}
        for line in text.splitlines():
            if line.startswith("|"):
                widths.setdefault(line.replace("\\|", "").count("|"), 0)
        self.assertLessEqual(set(widths), {3, 7, 13})


class Ratios(unittest.TestCase):
    def test_a_over_b(self):
        with tempfile.TemporaryDirectory() as folder:
            slow = pathlib.Path(folder) / "slow.json"
            data = json.loads(SAMPLE.read_text())
            for b in data["benchmarks"]:
                b["real_time"] *= 2
            slow.write_text(json.dumps(data))
            found = ab.ratios([(slow, SAMPLE), (SAMPLE, SAMPLE)])
            self.assertEqual(found[("bench_dense", DENSE)], [2.0, 1.0])
            self.assertNotIn(("bench_dense", "building/intel_pcr5_avx512/1"), found)
            out = subprocess.run([sys.executable, TOOLS / "ab.py", slow, SAMPLE, slow, SAMPLE], capture_output=True,
                                 text=True, check=True).stdout
            self.assertIn(f"| bench_dense {DENSE} | 2.000 | 2.000 | 2.000 |", out)

    def test_an_odd_number_of_files_is_refused(self):
        run = subprocess.run([sys.executable, TOOLS / "ab.py", SAMPLE], capture_output=True, text=True)
        self.assertNotEqual(run.returncode, 0)


class Pictures(unittest.TestCase):
    def setUp(self):
        try:
            import plots
        except ImportError as missing:
            self.skipTest(f"no pictures: {missing}")
        self.plots = plots

    def test_points_of_the_roofline(self):
        result = results.merge([SAMPLE])
        dense, = [p for p in self.plots.roofline_points(result, 1) if p[0] == "dense"]
        self.assertEqual(dense[1], "pcr5 16777216")
        self.assertAlmostEqual(dense[2], 41 / 36)   # flop per byte
        self.assertAlmostEqual(dense[3], 7e8 * 41)  # flop per second
        self.assertEqual([p[0] for p in self.plots.roofline_points(result, 2)], [])

    def test_speedups(self):
        found = self.plots.speedups(results.merge([SAMPLE]))
        self.assertEqual(found["machine/stream_triad"], {1: 1.0, 2: 1.5})
        self.assertEqual(found["sonar/warm1024/half15/li2014_pcr5/avx512"], {1: 1.0, 2: 1.65})

    def test_the_same_result_gives_the_same_files(self):
        with tempfile.TemporaryDirectory() as folder:
            stems = [pathlib.Path(folder) / name for name in ("a", "b")]
            result = results.merge([SAMPLE])
            drawn = [[path.read_bytes() for _, path in self.plots.draw_all(result, stem)] for stem in stems]
            self.assertEqual(len(drawn[0]), 2)
            self.assertEqual(*drawn)


if __name__ == "__main__":
    unittest.main()
