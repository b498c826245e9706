// SPDX-License-Identifier: Apache-2.0
// From a file to a plan: the format by its extension, the scale from the file or from the caller, the place last.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>

#include "readers.hpp"

namespace evigrid::scenes {
namespace {

/// The largest plan as plain PGM with 16-bit samples takes as much.
constexpr std::uintmax_t kMostBytes = std::uintmax_t{6} * kMostPixels;
constexpr std::uintmax_t kMostYamlBytes = 1u << 20;
constexpr double kFarthest_m = 1e7, kCoarsest_m = 1e3, kFinest_m = 1e-6;

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool is_yaml(const std::string& extension) { return extension == ".yaml" || extension == ".yml"; }

Bitmap read_image(Bytes bytes, const std::filesystem::path& path, const Shading& shading) {
  const std::string extension = extension_of(path), name = path.string();
  if (bytes.empty()) throw SceneError(name + ": is empty");
  if (extension == ".pgm") return read_pgm(bytes, name, shading);
  if (extension == ".png") return read_png(bytes, name, shading);
  if (extension == ".bmp") return read_bmp(bytes, name, shading);
  throw SceneError(name + ": format: is not known by its extension; images are .pgm, .png or .bmp");
}

void check_scale(const ImageScale& s, const std::string& name) {
  const auto require = [&](bool good, const char* field, const char* message) {
    if (!good) throw SceneError(name + ": " + field + ": " + message);
  };
  // NaN fails each comparison.
  const auto pixel = [](double m) { return m >= kFinest_m && m <= kCoarsest_m; };
  require(!s.resolution_m || pixel(*s.resolution_m), "resolution_m", "must be within [1e-06, 1000]");
  const auto side = [](double m) { return m >= kFinest_m && m <= kFarthest_m; };
  require(!s.size_m || (side(s.size_m->x_m) && side(s.size_m->y_m)), "size_m", "must be within [1e-06, 1e+07]");
  require(!s.resolution_m || !s.size_m, "size_m", "is given together with resolution_m: one of them is enough");
  require(!s.origin || (std::abs(s.origin->x_m) <= kFarthest_m && std::abs(s.origin->y_m) <= kFarthest_m &&
                        std::abs(s.origin->yaw_rad) <= 1e3),
          "origin", "must be finite, at most 1e+07 m away");
  require(s.occupied_threshold >= 0 && s.occupied_threshold <= 1, "occupied_threshold", "must be within [0, 1]");
  require(s.free_threshold >= 0 && s.free_threshold <= s.occupied_threshold, "free_threshold",
          "must be within [0, occupied_threshold]");
}

/// Puts a bitmap to scale; by default its pixels are `resolution_m` and its corner is at (0, 0).
FloorPlan place(Bitmap bitmap, const Shading& shading, const ImageScale& scale, double resolution_m) {
  FloorPlan plan;
  plan.width = bitmap.width;
  plan.height = bitmap.height;
  plan.resolution_m = plan.resolution_y_m = scale.resolution_m.value_or(resolution_m);
  if (scale.size_m) {
    plan.resolution_m = scale.size_m->x_m / static_cast<double>(plan.width);
    plan.resolution_y_m = scale.size_m->y_m / static_cast<double>(plan.height);
    plan.origin = {-scale.size_m->x_m / 2, -scale.size_m->y_m / 2, 0};
  }
  if (scale.origin) plan.origin = *scale.origin;
  plan.occupancy = std::move(bitmap.cells);
  plan.cells.resize(plan.occupancy.size());
  std::transform(plan.occupancy.begin(), plan.occupancy.end(), plan.cells.begin(),
                 [&](std::int8_t occupancy) { return cell_of(occupancy, shading); });
  return plan;
}

FloorPlan load_map_yaml(Bytes bytes, const std::filesystem::path& path, const ImageScale& scale) {
  const std::string name = path.string();
  if (scale.resolution_m || scale.size_m)
    throw SceneError(name + ": resolution_m, size_m: are said by the yaml itself and must not be given beside it");
  if (bytes.size() > kMostYamlBytes) throw SceneError(name + ": is larger than 1 MiB");
  const MapYaml yaml = read_map_yaml(bytes, path);
  const std::vector<std::byte> image = read_bytes(yaml.image, kMostBytes);
  ImageScale whole = scale;
  whole.resolution_m = yaml.resolution_m;
  if (!whole.origin) whole.origin = yaml.origin;
  return place(read_image(image, yaml.image, yaml.shading), yaml.shading, whole, yaml.resolution_m);
}

}  // namespace

std::vector<std::byte> read_bytes(const std::filesystem::path& path, std::uintmax_t most) {
  namespace fs = std::filesystem;
  const std::string name = path.string();
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw SceneError(name + ": there is no such file");
  // A device or a pipe could go on for ever.
  if (!fs::is_regular_file(status)) throw SceneError(name + ": is not a regular file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw SceneError(name + ": cannot be read");
  if (size == 0) throw SceneError(name + ": is empty");
  if (size > most) throw SceneError(name + ": is larger than " + std::to_string(most >> 20) + " MiB");
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  std::ifstream in(path, std::ios::binary);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!in || static_cast<std::uintmax_t>(in.gcount()) != size) throw SceneError(name + ": cannot be read");
  return bytes;
}

FloorPlan load_plan_bytes(std::span<const std::byte> bytes, const std::filesystem::path& name,
                          const ImageScale& scale) {
  const std::string extension = extension_of(name);
  check_scale(scale, name.string());
  if (bytes.empty()) throw SceneError(name.string() + ": is empty");
  if (is_yaml(extension)) return load_map_yaml(bytes, name, scale);
  if (extension == ".map") return place(read_movingai(bytes, name.string()), {}, scale, 1);
  const Shading shading{scale.negate, scale.occupied_threshold, scale.free_threshold, ShadeMode::trinary};
  if (extension != ".pgm" && extension != ".png" && extension != ".bmp")
    throw SceneError(name.string() +
                     ": format: is not known by its extension; plans are .yaml, .yml, .map, .pgm, .png or .bmp");
  if (!scale.resolution_m && !scale.size_m)
    throw SceneError(name.string() + ": resolution_m: is missing: an image alone does not say its scale");
  return place(read_image(bytes, name, shading), shading, scale, 0);
}

FloorPlan load_plan(const std::filesystem::path& file, const ImageScale& scale) {
  return load_plan_bytes(read_bytes(file, is_yaml(extension_of(file)) ? kMostYamlBytes : kMostBytes), file, scale);
}

}  // namespace evigrid::scenes
