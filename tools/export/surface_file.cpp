#include "tools/export/surface_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "ground/whole_file.h"
#include "shared/base/check.h"

namespace scree {

namespace {

using Point = WeldedSurface::Point;
using Metres = std::array<float, 3>;

Metres metres_of(const Point& p, float step_m) {
  return {static_cast<float>(p[0]) * step_m, static_cast<float>(p[1]) * step_m,
          static_cast<float>(p[2]) * step_m};
}

template <typename T>
void put_bytes(std::ostream& out, const T& value) {
  out.write(reinterpret_cast<const char*>(&value), sizeof value);
}

void write_points(std::ostream& out, const WeldedSurface& surface, float step_m) {
  for (const Point& point : surface.points) put_bytes(out, metres_of(point, step_m));
}

void write_ply(std::ostream& out, const WeldedSurface& surface, float step_m) {
  out << fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment metres, y up\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\nelement face {}\nproperty list uchar int "
      "vertex_indices\nend_header\n",
      surface.points.size(), surface.triangles.size());
  write_points(out, surface, step_m);
  for (const auto& t : surface.triangles) {
    out.put(3);
    put_bytes(out, t);
  }
}

void write_obj(std::ostream& out, const WeldedSurface& surface, float step_m) {
  out << "# metres, y up\no rock\n";
  for (const Point& point : surface.points) {
    const Metres p = metres_of(point, step_m);
    out << fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
  }
  for (const auto& t : surface.triangles) out << fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
}

// glTF 2.0 (Khronos, ISO/IEC 12113), "GLB File Format Specification": a header and two chunks, each as long
// as a multiple of four bytes.
constexpr uint32_t glb_magic = 0x46546C67, glb_version = 2, chunk_json = 0x4E4F534A, chunk_bin = 0x004E4942;
constexpr int type_u8 = 5121, type_u32 = 5125, type_f32 = 5126;
constexpr int target_vertices = 34962, target_indices = 34963;

struct Bounds {
  Metres lo;
  Metres hi;
};

Bounds bounds_of(const WeldedSurface& surface, float step_m) {
  Bounds bounds{metres_of(surface.points.front(), step_m), metres_of(surface.points.front(), step_m)};
  for (const Point& point : surface.points) {
    const Metres p = metres_of(point, step_m);
    for (size_t i = 0; i < 3; ++i) {
      bounds.lo[i] = std::min(bounds.lo[i], p[i]);
      bounds.hi[i] = std::max(bounds.hi[i], p[i]);
    }
  }
  return bounds;
}

std::string glb_json(const WeldedSurface& surface, float step_m) {
  using Json = nlohmann::json;
  const size_t points = surface.points.size(), corners = 3 * surface.triangles.size();
  const size_t colours_at = 12 * points, indices_at = 16 * points;
  const auto [lo, hi] = bounds_of(surface, step_m);
  const auto view = [](size_t at, size_t bytes, int target) {
    return Json{{"buffer", 0}, {"byteOffset", at}, {"byteLength", bytes}, {"target", target}};
  };
  const Json json{
      {"asset", {{"version", "2.0"}, {"generator", "scree-export"}}},
      {"scene", 0},
      {"scenes", Json::array({{{"nodes", {0}}}})},
      {"nodes", Json::array({{{"mesh", 0}, {"name", "rock"}}})},
      {"materials",
       Json::array({{{"name", "terrain"},
                     {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}}}})},
      {"meshes", Json::array({{{"name", "rock"},
                               {"primitives", Json::array({{{"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}},
                                                            {"indices", 2},
                                                            {"material", 0}}})}}})},
      {"accessors",
       Json::array(
           {{{"bufferView", 0},
             {"componentType", type_f32},
             {"count", points},
             {"type", "VEC3"},
             {"min", lo},
             {"max", hi}},
            {{"bufferView", 1},
             {"componentType", type_u8},
             {"normalized", true},
             {"count", points},
             {"type", "VEC4"}},
            {{"bufferView", 2}, {"componentType", type_u32}, {"count", corners}, {"type", "SCALAR"}}})},
      {"bufferViews",
       Json::array({view(0, 12 * points, target_vertices), view(colours_at, 4 * points, target_vertices),
                    view(indices_at, 4 * corners, target_indices)})},
      {"buffers", Json::array({{{"byteLength", indices_at + 4 * corners}}})}};
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return text;
}

/// Linear, as glTF's colours of points are.
std::array<uint8_t, 4> colour_of(Material material) {
  const auto byte = [](float part) { return static_cast<uint8_t>(std::lround(255.0F * part)); };
  const auto& albedo = row_of(material).albedo;
  return {byte(albedo[0]), byte(albedo[1]), byte(albedo[2]), 255};
}

void write_glb(std::ostream& out, const WeldedSurface& surface, float step_m) {
  const std::string json = glb_json(surface, step_m);
  const size_t data = 16 * surface.points.size() + 12 * surface.triangles.size();
  const size_t all = 12 + 8 + json.size() + 8 + data;
  CHECK(all <= std::numeric_limits<uint32_t>::max());  // limits::export_triangles_max
  for (const size_t word : {size_t{glb_magic}, size_t{glb_version}, all, json.size(), size_t{chunk_json}})
    put_bytes(out, static_cast<uint32_t>(word));
  out << json;
  put_bytes(out, static_cast<uint32_t>(data));
  put_bytes(out, chunk_bin);
  write_points(out, surface, step_m);
  for (const Material material : surface.materials) put_bytes(out, colour_of(material));
  for (const auto& t : surface.triangles) put_bytes(out, t);
}

struct SurfaceFormat {
  std::string_view ending;
  void (*write)(std::ostream& out, const WeldedSurface& surface, float step_m);
};
constexpr std::array<SurfaceFormat, 3> formats{
    {{".ply", write_ply}, {".obj", write_obj}, {".glb", write_glb}}};

const SurfaceFormat* format_of(const std::string& path) {
  const auto found =
      std::ranges::find_if(formats, [&](const auto& format) { return path.ends_with(format.ending); });
  return found == formats.end() ? nullptr : &*found;
}

}  // namespace

bool is_surface_name(const std::string& path) {
  return format_of(path) != nullptr;
}

Result<uint64_t> write_surface(const WeldedSurface& surface, const std::string& path, float step_m) {
  const SurfaceFormat* const format = format_of(path);
  CHECK(format != nullptr && !surface.points.empty() && surface.materials.size() == surface.points.size());
  return write_whole(path, [&](const std::string& unfinished) -> Result<void> {
    std::ofstream out(unfinished, std::ios::binary | std::ios::trunc);
    format->write(out, surface, step_m);
    out.close();
    if (!out) return fail(std::strerror(errno));
    return {};
  });
}

}  // namespace scree
