// SPDX-License-Identifier: Apache-2.0
// PLY in its three encodings and OBJ read back to the solid they were written of; damage refused with its place.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "mesh_shapes.hpp"

namespace evigrid::scenes::test {
namespace {

void expect_equal(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.faces, b.faces);
}

TEST(MeshRead, AllEncodingsAreTheSolid) {
  const Mesh solid = prism(regular(7, 1.0 / 3), -0.1, 2.7, 3);
  expect_equal(load(obj_of(solid), ".obj"), solid);
  expect_equal(load(obj_of(solid), ".OBJ"), solid);
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
    expect_equal(load(ply_of(solid, format), ".ply"), solid);
}

TEST(MeshRead, TruncatedAnywhereItIsRefused) {
  const Mesh solid = prism(regular(3, 1), 0, 1);
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string whole = ply_of(solid, format);
    // In a text the last number may lose its end and the file its last newline without notice.
    const std::size_t last = std::string(format) == "ascii" ? whole.find_last_of(' ') + 1 : whole.size() - 1;
    for (std::size_t size = 0; size <= last; ++size)
      EXPECT_THROW((void)load(whole.substr(0, size), ".ply"), SceneError) << format << " " << size;
  }
  const std::string obj = obj_of(solid);
  for (std::size_t size = 0; size < obj.size(); ++size) {
    try {
      const Mesh part = load(obj.substr(0, size), ".obj");
      EXPECT_EQ(part.vertices.size(), solid.vertices.size());
      EXPECT_LE(part.faces.size(), solid.faces.size());
    } catch (const SceneError&) {
    }
  }
}

TEST(MeshRead, DamagedBytesNeverCrash) {
  const Mesh solid = prism(regular(4, 1), 0, 1);
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian", "obj"}) {
    const bool is_obj = std::string(format) == "obj";
    const std::string whole = is_obj ? obj_of(solid) : ply_of(solid, format);
    for (std::size_t at = 0; at < whole.size(); ++at) {
      for (const int c : {0x00, 0xff, 0x80, 0x0a, 0x2d, 0x39, 0x20}) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(c);
        try {
          const Mesh mesh = load(damaged, is_obj ? ".obj" : ".ply");
          (void)slice(mesh, {});
          for (const auto& f : mesh.faces)
            for (const std::uint32_t i : f) ASSERT_LT(i, mesh.vertices.size());
        } catch (const SceneError&) {
        }
      }
    }
  }
}

std::string refusal(const std::string& text, const std::string& extension) {
  try {
    (void)load(text, extension);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "none";
}

TEST(MeshRead, ObjFacesOfEveryForm) {
  const std::string vertices =
      "mtllib missing.mtl\no thing\nv 0 0 0\nv +1 0 0 0.5\r\n\tv 1 1e0 0 1 0 0\rv 0 1 .0\nvn 0 0 1\nvt 0 0\n";
  const Mesh mesh = load(vertices + "usemtl red\ng a b\ns off\nf 1/1/1 2//1 3/1\nf -4 -2 -1 # the rest\n", ".obj");
  EXPECT_EQ(mesh.vertices.size(), 4u);
  const std::vector<std::array<std::uint32_t, 3>> faces{{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(mesh.faces, faces);
  EXPECT_EQ(refusal(vertices + "f 1 2 3 4 note\n", ".obj"), "mesh.obj:9: f: note is not a vertex index");
  EXPECT_EQ(refusal(vertices + "f 1 2 3\nf 1 2 5\n", ".obj"),
            "mesh.obj:10: face: a vertex index is out of range: the mesh has 4 vertices");
  EXPECT_EQ(refusal(vertices + "f 1 2 -5\n", ".obj"), "mesh.obj:9: face: a vertex index is out of range");
  EXPECT_EQ(refusal(vertices + "f 1 2 0\n", ".obj"), "mesh.obj:9: f: vertex indices begin at 1");
  EXPECT_EQ(refusal(vertices + "f 1 2\n", ".obj"), "mesh.obj:9: face: has 2 corners");
  EXPECT_EQ(refusal(vertices + "f 1 2 4294967297\n", ".obj"), "mesh.obj:9: f: 4294967297 is not a vertex index");
  EXPECT_EQ(refusal("v 0 0\n", ".obj"), "mesh.obj:1: v: has no z");
  EXPECT_EQ(refusal("v 0 0x1 0\n", ".obj"), "mesh.obj:1: v: y is not a finite number");
  EXPECT_EQ(refusal("v inf 0 0\n", ".obj"), "mesh.obj:1: v: x is not a finite number");
  EXPECT_EQ(refusal(vertices, ".obj"), "mesh.obj: the mesh has no faces");
  EXPECT_EQ(refusal("", ".obj"), "mesh.obj: the mesh has no faces");
  EXPECT_EQ(refusal("", ".stl"), "mesh.stl: a mesh is a file .ply or .obj, not \".stl\"");
}

TEST(MeshRead, AConcaveFaceIsCutWithinItself) {
  // A U of area 7, upright in the x–z plane; in both directions of turning.
  for (const char* face : {"f 1 2 3 4 5 6 7 8\n", "f 8 7 6 5 4 3 2 1\n"}) {
    const Mesh u =
        load(std::string("v 0 5 0\nv 3 5 0\nv 3 5 3\nv 2 5 3\nv 2 5 1\nv 1 5 1\nv 1 5 3\nv 0 5 3\n") + face, ".obj");
    ASSERT_EQ(u.faces.size(), 6u);
    double area = 0;
    for (const auto& f : u.faces) {
      const Vertex &a = u.vertices[f[0]], &b = u.vertices[f[1]], &c = u.vertices[f[2]];
      area += std::abs((b[0] - a[0]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[0] - a[0])) / 2;
    }
    EXPECT_DOUBLE_EQ(area, 7);
    const auto walls = slice(u, {.height_m = 2});
    ASSERT_EQ(walls.size(), 2u);  // not the gap between the arms
    double length = 0;
    for (const auto& w : walls) length += std::abs(w.to.x_m - w.from.x_m);
    EXPECT_NEAR(length, 2, 1e-12);
  }
}

std::string with_header(const std::string& lines, const std::string& body = "") {
  return "ply\nformat ascii 1.0\n" + lines + "end_header\n" + body;
}

TEST(MeshRead, PlyRefusals) {
  const std::string vertex = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string face = "element face 1\nproperty list uchar int vertex_index\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 1\n";
  EXPECT_EQ(load(with_header(vertex + face, points + "3 0 1 2"), ".ply").faces.size(), 1u);
  const auto expect = [](const std::string& text, const std::string& message) {
    EXPECT_EQ(refusal(text, ".ply"), "mesh.ply:" + message);
  };
  expect(with_header(vertex + face, points + "3 0 1 3\n"),
         "13: face: a vertex index is out of range: the mesh has 3 vertices");
  expect(with_header(vertex + face, points + "3 0 1 -1\n"), "13: face: a vertex index is out of range");
  expect(with_header(vertex + face, points + "2 0 1\n"), "13: face: has 2 corners");
  expect(with_header(vertex + face, points + "-3 0 1 2\n"), "13: vertex_index: a list has a negative count");
  expect(with_header(vertex + face, points + "3 0 1 2 4\n"), "13: ply: there is more after the last element");
  expect(with_header(vertex + face, "0 0 0\n1 nan 0\n0 0 0\n3 0 1 2\n"), "11: y: is not finite");
  expect(with_header(vertex + face, "0 0 0\n1 x 0\n0 0 0\n3 0 1 2\n"), "11: y: is not a number of its type");
  expect(with_header(vertex, points), " the mesh has no faces");
  expect(with_header("element vertex 99999999999999\nproperty float x\n"),
         "3: vertex: the header promises 99999999999999 rows, 0 bytes are left");
  expect(with_header("element vertex 1\n"), "3: vertex: has rows but no properties");
  expect(with_header("element vertex -1\n"), "3: element: the count is not a number from 0 on");
  expect(with_header("property float x\n"), "3: property: stands before the first element");
  expect(with_header("element a 1\nproperty real x\n"), "4: property: its type is none of the eight of PLY");
  expect(with_header("element a 1\nproperty list float int x\n"), "4: property: the count of a list is not an integer");
  expect(with_header("element a 1\nproperty int x\nproperty int x\n"), "5: property: x comes twice");
  expect(with_header("element a 1\nelement a 2\n"), "4: element: comes twice");
  expect("ply\nend_header\n", "2: format: is missing");
  expect("ply\nformat ascii 2.0\n", "2: format: the version is not 1.0");
  expect("plyx\n", "1: ply: the file does not begin with \"ply\"");
  expect("ply\nformat ascii 1.0\nelement", "3: end_header: the file ends within the header");
}

TEST(MeshRead, ALongHeaderTakesNoLongTime) {
  std::string elements = "ply\nformat ascii 1.0\n", properties = elements + "element vertex 0\n";
  for (int i = 0; i < 100'000; ++i) {
    elements += "element e" + std::to_string(i) + " 0\n";
    properties += "property float p" + std::to_string(i) + "\n";
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_THROW((void)load(elements + "element e7 0\nend_header\n", ".ply"), SceneError);
  EXPECT_THROW((void)load(properties + "property int p7\nend_header\n", ".ply"), SceneError);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(MeshRead, AHugeListCountAsksForNoMemory) {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint uint vertex_indices\nend_header\n";
  put<std::uint32_t>(text, 0xffffffffu, false);
  EXPECT_NE(refusal(text, ".ply").find("byte 105: vertex_indices: the file ends within a list"), std::string::npos)
      << refusal(text, ".ply");
}

TEST(MeshRead, FromAFile) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "evigrid_mesh_read_test";
  std::filesystem::create_directories(folder);
  const Mesh solid = prism(regular(5, 1), 0, 1);
  std::ofstream(folder / "a.ply", std::ios::binary) << ply_of(solid, "binary_big_endian");
  expect_equal(load_mesh(folder / "a.ply"), solid);
  EXPECT_THROW((void)load_mesh(folder / "none.ply"), SceneError);
  EXPECT_THROW((void)load_mesh(folder), SceneError);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace evigrid::scenes::test
