#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The C interface by ctypes: no header, no compiler, nothing but the shared library."""
import ctypes as C
import math
import sys
import unittest

LIBRARY = sys.argv.pop()


class Pose(C.Structure):
    _fields_ = [("x_m", C.c_double), ("y_m", C.c_double), ("yaw_rad", C.c_double)]


class Rect(C.Structure):
    _fields_ = [(name, C.c_int64) for name in ("x", "y", "width", "height")]


class Reading(C.Structure):
    _fields_ = [("sensor", C.c_uint32), ("ranges_m", C.POINTER(C.c_float)), ("count", C.c_size_t)]


class Report(C.Structure):
    _fields_ = [(name, C.c_uint64) for name in ("readings_used", "readings_clipped", "stamps_backwards", "cells_updated",
                                                "total_conflicts")] + [
        ("refused", C.c_uint64 * 16), ("max_conflict", C.c_double), ("touched", Rect)]


class Evigrid(unittest.TestCase):
    def setUp(self):
        self.lib = C.CDLL(LIBRARY)
        self.lib.evigrid_last_error.restype = C.c_char_p
        self.lib.evigrid_map_integrate.argtypes = [C.c_void_p, C.c_int64, Pose, C.POINTER(Reading), C.c_size_t,
                                                   C.POINTER(Report)]
        self.lib.evigrid_sensor_set_number.argtypes = [C.c_void_p, C.c_char_p, C.c_double]
        self.lib.evigrid_view_render.argtypes = [C.c_void_p, C.c_char_p, Rect, C.POINTER(C.c_float), C.c_size_t,
                                                 C.c_ssize_t]
        for name in ("sensor_destroy", "view_destroy", "map_destroy"):
            getattr(self.lib, "evigrid_" + name).argtypes = [C.c_void_p]

    def ok(self, status):
        self.assertEqual(status, 0, self.lib.evigrid_last_error())

    def test_a_laser_finds_a_wall(self):
        lib, map_, laser, view = self.lib, C.c_void_p(), C.c_void_p(), C.c_void_p()
        self.ok(lib.evigrid_map_create(None, C.byref(map_)))
        self.ok(lib.evigrid_sensor_create(b"beam", C.byref(laser)))
        beams = 21
        for name, value in ((b"beams", beams), (b"first_beam_rad", -0.1), (b"beam_step_rad", 0.01), (b"max_range_m", 8)):
            self.ok(lib.evigrid_sensor_set_number(laser, name, value))
        self.ok(lib.evigrid_map_add_sensor(map_, laser, None))
        ranges = (C.c_float * beams)(*[2.0 / math.cos(-0.1 + 0.01 * i) for i in range(beams)])
        report = Report()
        self.ok(lib.evigrid_map_integrate(map_, 0, Pose(0, 0, 0), C.byref(Reading(0, ranges, beams)), 1,
                                          C.byref(report)))
        self.assertEqual(report.readings_used, beams)
        self.assertGreater(report.cells_updated, 160)  # 0.2 rad · (2 m)² / 2 of 5 cm cells
        self.ok(lib.evigrid_map_view(map_, C.byref(view)))
        row = (C.c_float * 60)()
        self.ok(lib.evigrid_view_render(view, b"betp", Rect(0, 0, 60, 1), row, 60, 60))
        self.assertLess(row[20], 0.4)     # 1 m ahead: empty
        self.assertGreater(row[40], 0.6)  # 2 m ahead: the wall
        self.assertEqual(row[55], 0.5)    # behind it: unknown
        lib.evigrid_view_destroy(view)
        lib.evigrid_sensor_destroy(laser)
        lib.evigrid_map_destroy(map_)

    def test_errors_are_words(self):
        sensor = C.c_void_p()
        self.assertEqual(self.lib.evigrid_sensor_create(b"radar", C.byref(sensor)), 1)
        self.assertIn(b"radar", self.lib.evigrid_last_error())


if __name__ == "__main__":
    unittest.main()
