#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""import evigrid: what its stub says is there, what its arrays are, who waits for whom."""
import ast
import gc
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import time
import unittest

try:
    import numpy as np
except ImportError:
    print("no numpy: the Python module is not tested")
    sys.exit(77)
import evigrid


def ring(map_, n=8, model="li2014", **settings):
    return [map_.add(evigrid.Sensor(model, T_robot_sensor=(0, 0, 2 * math.pi * i / n), **settings)) for i in range(n)]


def drive(map_, sonars, steps=20, seed=1):
    draw = np.random.default_rng(seed)
    for k in range(steps):
        map_.integrate(k * 10**8, (0.2 * k, 0.05 * k, 0.1 * k), zip(sonars, draw.uniform(0.5, 4.5, len(sonars))))


class Arrays(unittest.TestCase):
    def setUp(self):
        self.map = evigrid.Map(cell_m=0.1, keep_con=True)
        drive(self.map, ring(self.map))
        self.view = self.map.view()

    def test_layers_and_masses_agree(self):
        x, y, width, height = self.view.bounds()
        betp, e, o, u = (self.view.render(layer) for layer in ("betp", "empty", "bel", "unknown"))
        self.assertEqual(betp.shape, (height, width))
        self.assertEqual(betp.dtype, np.float32)
        np.testing.assert_allclose(e + o + u, 1, atol=4e-7)
        np.testing.assert_array_equal(betp, o + u * np.float32(0.5))
        for row, column in ((0, 0), (height // 2, width // 2), (height - 1, width - 1)):
            mass = self.view.mass(x + column, y + row)
            self.assertEqual(mass[:3], (e[row, column], o[row, column], u[row, column]))
        part = self.view.render("betp", (x + 3, y + 5, 7, 2))
        np.testing.assert_array_equal(part, betp[5:7, 3:10])

    def test_a_map_larger_than_its_cap_is_the_same(self):
        roomy, paged = evigrid.Map(), evigrid.Map(memory_cap_bytes=40 << 16)
        with self.assertRaises(OSError):
            paged.page_to("/no/such/folder")
        paged.page_to(tempfile.gettempdir())
        for m in (roomy, paged):
            sonars = ring(m)
            for k in range(12):
                m.integrate(k, (30 * k, 0, 0.1 * k), {s: 3.5 for s in sonars})
        self.assertGreater(paged.paged_bytes, 0)
        self.assertLessEqual(paged.memory_bytes, 40 << 16)
        self.assertEqual(paged.hash(), roomy.hash())

    def test_tiles_are_views_without_a_copy_and_outlive_all(self):
        tile = self.view.tiles()[0]
        names = self.view.plane_names
        self.assertEqual(names, ["e", "o", "u", "conflict", "con"])
        for name, layer in (("e", "empty"), ("o", "bel"), ("u", "unknown"), ("conflict", "conflict"), ("con", "con")):
            plane = tile.plane(name)
            self.assertFalse(plane.flags.owndata)
            self.assertFalse(plane.flags.writeable)
            np.testing.assert_array_equal(plane.reshape(64, 64), self.view.render(layer, tile.rect))
        self.assertEqual(tile.plane("o").ctypes.data, tile.plane("o").ctypes.data)  # the same memory each time
        self.assertEqual(tile.plane("o").ctypes.data - tile.plane("e").ctypes.data, 64)
        kept, before = tile.plane("e"), tile.plane("e").copy()
        self.assertGreater(float(before.max()), 0)
        drive(self.map, range(8), seed=2)  # the map goes on in a copy
        self.map.clear()
        del tile
        self.view = self.map = None
        gc.collect()
        np.testing.assert_array_equal(kept, before)
        with self.assertRaises(ValueError):
            kept[0, 0, 0, 0] = 1

    def test_costs(self):
        grid, costs = self.view.occupancy(), self.view.costmap()
        self.assertEqual((grid.dtype, costs.dtype), (np.int8, np.uint8))
        np.testing.assert_array_equal(grid == -1, costs == 255)
        np.testing.assert_array_equal(grid == 100, costs == 254)
        self.assertTrue((grid == 0).any() and (grid == 100).any())

    def test_changes(self):
        self.assertEqual(self.view.changes(self.view.version)["rects"], [])
        self.map.integrate(10**10, (0, 0, 0), {0: 2.0})
        changes = self.map.view().changes(self.view.version)
        self.assertFalse(changes["cleared"])
        self.assertTrue(1 <= len(changes["rects"]) <= 4)

    def test_refused_readings_are_named(self):
        report = self.map.integrate(10**10, (0, 0, 0), {0: float("nan"), 1: -math.inf, 2: 1e9, 77: 1.0, 3: 2.0})
        self.assertEqual(report.readings_used, 1)
        self.assertEqual(report.refused, {"not_a_number": 1, "too_close": 1, "no_return": 1, "unknown_sensor": 1})


class Maps(unittest.TestCase):
    def test_the_same_bits_on_any_executor(self):
        hashes = set()
        for executor, threads in (("serial", 1), ("tbb", 2), ("openmp", 3), ("spin", 2)):
            map_ = evigrid.Map(cell_m=0.1, executor=executor, threads=threads)
            drive(map_, ring(map_))
            hashes.add(map_.hash())
        self.assertEqual(len(hashes), 1)

    def test_files(self):
        map_ = evigrid.Map(cell_m=0.1, rule="conjunctive")
        drive(map_, ring(map_))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.map")
            map_.view().save(path)
            back = evigrid.load(path)
            self.assertEqual((back.hash(), back.rule, back.cell_m), (map_.hash(), "conjunctive", 0.1))
            self.assertEqual(back.sensors()[3].T_robot_sensor, map_.sensors()[3].T_robot_sensor)
            data = bytearray(pathlib.Path(path).read_bytes())
            data[len(data) // 2] ^= 1
            pathlib.Path(path).write_bytes(data)
            with self.assertRaisesRegex(evigrid.MapFileError, "a.map"):
                evigrid.load(path)

    def test_known_areas_windows_and_merge(self):
        map_ = evigrid.Map(cell_m=0.1)
        sonars = ring(map_)
        walls = np.zeros((4, 6, 3), np.float32)
        walls[..., 1], walls[..., 2] = 0.9, 0.1
        map_.write(3, 5, walls)
        map_.protect((3, 5, 6, 4))
        drive(map_, sonars)
        np.testing.assert_array_equal(map_.view().render("bel", (3, 5, 6, 4)), walls[..., 1])
        map_.write_occupancy(500, 500, [[-1, 100], [0, 50]], 0.8)
        np.testing.assert_allclose(map_.view().render("bel", (500, 500, 2, 2)), [[0, 0.8], [0, 0.4]], atol=1e-6)
        other = evigrid.Map(cell_m=0.1)
        self.assertGreater(other.merge(map_.view(), (10, 0, 0), 0.9), 1000)
        other.set_window((0, 0, 64, 64))
        self.assertLessEqual(len(other.view().tiles()), 1)
        with self.assertRaisesRegex(ValueError, "2\\^60"):
            map_.clear((2**62, 0, 5, 5))

    def test_undo_and_revision(self):
        sums = evigrid.Map(cell_m=0.1, rule="dempster_log")
        sonars = ring(sums)
        drive(sums, sonars)
        before = sums.hash()
        sums.integrate(10**11, (0, 0, 0), {0: 2.0})
        sums.undo(10**11, (0, 0, 0), {0: 2.0})
        self.assertEqual(sums.hash(), before)
        with self.assertRaisesRegex(RuntimeError, "pcr5"):
            evigrid.Map().undo(0, (0, 0, 0), {})

        def revisable():
            map_ = evigrid.Map(cell_m=0.1)
            ring(map_)
            return map_, evigrid.RevisableMap(map_)

        taken, revised = revisable()
        ids = [revised.integrate(k * 10**8, (0.1 * k, 0, 0), {k % 8: 1.0 + 0.1 * k}) for k in range(10)]
        revised.remove(ids[4])
        revised.move(ids[7], (0, 0.5, 0.1))
        _, straight = revisable()
        for k in range(10):
            if k != 4:
                straight.integrate(k * 10**8, (0, 0.5, 0.1) if k == 7 else (0.1 * k, 0, 0), {k % 8: 1.0 + 0.1 * k})
        self.assertEqual(revised.view().hash(), straight.view().hash())
        self.assertEqual(len(revised.poses()), 9)
        with self.assertRaises(IndexError):
            revised.remove(ids[4])
        with self.assertRaisesRegex(RuntimeError, "RevisableMap"):
            taken.hash()

    def test_errors_name_what_is_wrong(self):
        for words, call in (
                ("apeture_rad", lambda: evigrid.Sensor("li2014", apeture_rad=1)),
                ("sensor.aperture_rad", lambda: evigrid.Sensor("li2014", aperture_rad=10)),
                ("radar", lambda: evigrid.Sensor("radar")), ("pcr9", lambda: evigrid.Map(rule="pcr9")),
                ("map.cell_m", lambda: evigrid.Map(cell_m=-1)), ("decay", lambda: evigrid.Map(decays=1)),
                ("betq", lambda: evigrid.Map().view().render("betq")),
                ("2\\^34", lambda: evigrid.Map().view().render("betp", (0, 0, 2**30, 2**30))),
                ("shape", lambda: evigrid.Scene().cast([[1, 2, 3]])),
                ("along the first axis", lambda: evigrid.combine("pcr5", [1.0], [1.0]))):
            with self.assertRaisesRegex(ValueError, words):
                call()


class Threads(unittest.TestCase):
    def test_others_run_while_it_works(self):
        """A counter of another thread goes on during one long call: the interpreter's lock is released."""
        a = np.random.default_rng(1).dirichlet([1, 1, 1], 4_000_000).T.astype(np.float32)
        count, stop = [0], threading.Event()

        def counter():
            while not stop.is_set():
                count[0] += 1
                time.sleep(0)

        other = threading.Thread(target=counter)
        other.start()
        while count[0] == 0:
            time.sleep(0.001)
        before = count[0]
        for _ in range(5):
            evigrid.combine("pcr5", a, a)
        during = count[0] - before
        stop.set()
        other.join()
        self.assertGreater(during, 20)

    def test_writers_wait_and_readers_do_not(self):
        map_ = evigrid.Map(cell_m=0.1, rule="dempster_log", executor="serial")  # sums: the order does not matter
        sonars = ring(map_)
        draw = np.random.default_rng(3)
        scans = [(k, (0.1 * k, 0, 0), dict(zip(sonars, draw.uniform(1, 4, 8)))) for k in range(200)]
        wrong = []

        def write(part):
            for scan in part:
                map_.integrate(*scan)

        def read():
            for _ in range(50):
                view = map_.view()
                if view.hash() != view.hash():
                    wrong.append(view.version)
                view.render("betp")

        threads = [threading.Thread(target=write, args=(scans[i::2],)) for i in range(2)] + [threading.Thread(target=read)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(wrong, [])
        alone = evigrid.Map(cell_m=0.1, rule="dempster_log", executor="serial")
        ring(alone)
        for scan in scans:
            alone.integrate(*scan)
        self.assertEqual(map_.hash(), alone.hash())


class Algebra(unittest.TestCase):
    def test_by_hand(self):
        a, b = np.array([[0.5], [0.2], [0.3]]), np.array([[0.1], [0.6], [0.3]])
        masses, conflict = evigrid.combine("conjunctive", a, b, double=True)
        self.assertEqual((masses.shape, masses.dtype), ((4, 1), np.float64))  # the rule keeps the conflict
        np.testing.assert_allclose(masses[:, 0], [0.23, 0.36, 0.09, 0.32], atol=1e-15)
        np.testing.assert_allclose(conflict, [0.32], atol=1e-15)
        masses, _ = evigrid.combine("dempster", a, b, double=True)
        np.testing.assert_allclose(masses[:, 0], np.array([0.23, 0.36, 0.09]) / 0.68, atol=1e-15)

    def test_any_shape_sources_and_threads(self):
        draw = np.random.default_rng(2)
        sources = [draw.dirichlet([1, 1, 1], (7, 5)).transpose(2, 0, 1) for _ in range(4)]
        folded = sources[0]
        for source in sources[1:]:
            folded, _ = evigrid.combine("pcr5", folded, source, double=True)
        together, conflict = evigrid.combine("pcr5", *sources, double=True, threads=2)
        self.assertEqual((together.shape, conflict.shape), ((3, 7, 5), (7, 5)))
        np.testing.assert_array_equal(together, folded)


class Casting(unittest.TestCase):
    def test_a_wall_a_pole_and_nothing(self):
        scene = evigrid.Scene(walls=[((2, -5), (2, 5))], circles=[(-3, 0, 0.5)])
        ranges = scene.cast([[0, 0, 0, 0.4, 0.1, 5], [0, 0, math.pi, 0.4, 0.1, 5], [0, 0, math.pi / 2, 0.4, 0.1, 5],
                             [1.95, 0, 0, 0.4, 0.1, 5]])
        np.testing.assert_allclose(ranges[:2], [2, 2.5], atol=1e-9)
        self.assertEqual(list(ranges[2:]), [math.inf, -math.inf])
        fan = scene.cast_fan((0, 0, 0), -0.1, 0.1, 3, 10)
        np.testing.assert_allclose(fan, [2 / math.cos(0.1), 2, 2 / math.cos(0.1)], rtol=1e-6)


class Package(unittest.TestCase):
    def test_the_stub_names_what_is_there(self):
        tree = ast.parse(pathlib.Path(os.environ["EVIGRID_STUB"]).read_text())
        stub = {}
        for node in tree.body:
            if isinstance(node, ast.ClassDef) and not any(getattr(b, "id", "") == "TypedDict" for b in node.bases):
                stub[node.name] = {m.name for m in node.body if isinstance(m, ast.FunctionDef)} | {
                    m.target.id for m in node.body if isinstance(m, ast.AnnAssign)}
            elif isinstance(node, ast.FunctionDef):
                stub[node.name] = None
            elif isinstance(node, ast.AnnAssign):
                stub[node.target.id] = None
        self.assertEqual(set(stub), set(evigrid.__all__))
        for name, members in stub.items():
            if members:
                there = {m for m in vars(getattr(evigrid, name)) if not m.startswith("_")}
                self.assertEqual(members - {"__init__"}, there, name)
                for member in there:
                    if callable(vars(getattr(evigrid, name))[member]):
                        self.assertIn("self", getattr(evigrid, name).__dict__[member].__doc__)

    def test_the_example_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            picture = os.path.join(folder, "map.png")
            done = subprocess.run([sys.executable, os.path.join(os.environ["EVIGRID_EXAMPLES"], "first_map.py"), picture],
                                  capture_output=True, text=True)
            if "matplotlib is not installed" in done.stderr:
                self.skipTest("no matplotlib")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertGreater(os.path.getsize(picture), 20000)


if __name__ == "__main__":
    unittest.main()
