#include "tools/export/surface_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

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

void write_ply(std::ostream& out, const WeldedSurface& surface, const Palette& /*palette*/, float step_m) {
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

void write_obj(std::ostream& out, const WeldedSurface& surface, const Palette& palette, float step_m) {
  out << "# metres, y up\no terrain\n";
  for (const Point& point : surface.points) {
    const Metres p = metres_of(point, step_m);
    out << fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
  }
  std::optional<Material> last;
  for (const auto& t : surface.triangles) {
    if (const Material own = surface.materials[t[0]]; own != last) {
      out << "usemtl " << palette.row_or_first(own).name << "\n";
      last = own;
    }
    out << fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  }
}

/// Kd is linear, as the colours of rows are.
void write_mtl(std::ostream& out, const WeldedSurface& surface, const Palette& palette) {
  std::optional<Material> last;
  for (const auto& t : surface.triangles) {
    const Material own = surface.materials[t[0]];
    if (own == last) continue;
    last = own;
    const MaterialRow& row = palette.row_or_first(own);
    const auto& colour = row.look.colour;
    out << fmt::format("newmtl {}\nKd {} {} {}\n", row.name, colour[0], colour[1], colour[2]);
  }
}

// glTF 2.0 (Khronos, ISO/IEC 12113), "GLB File Format Specification": a header and two chunks, each as long
// as a multiple of four bytes.
constexpr uint32_t glb_magic = 0x46546C67, glb_version = 2, chunk_json = 0x4E4F534A, chunk_bin = 0x004E4942;
constexpr int type_u32 = 5125, type_f32 = 5126;
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

using Json = nlohmann::json;

/// Linear, as glTF's factors are.
Json material_json(const MaterialRow& row) {
  const auto& colour = row.look.colour;
  return {{"name", row.name},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", {colour[0], colour[1], colour[2], 1.0}},
            {"metallicFactor", 0.0},
            {"roughnessFactor", row.look.roughness}}}};
}

/// The triangles of a material, and where their corners begin among all.
struct GlbPart {
  Material material{};
  size_t triangles = 0;
  size_t first = 0;
};

std::vector<GlbPart> parts_of(const WeldedSurface& surface) {
  std::vector<GlbPart> parts;
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    const Material own = surface.materials[surface.triangles[i][0]];
    if (parts.empty() || parts.back().material != own) parts.push_back({own, 0, i});
    ++parts.back().triangles;
  }
  return parts;
}

Json glb_accessors(const WeldedSurface& surface, const std::vector<GlbPart>& parts, float step_m) {
  const size_t points = surface.points.size();
  const auto [lo, hi] = bounds_of(surface, step_m);
  Json accessors = Json::array({{{"bufferView", 0},
                                 {"componentType", type_f32},
                                 {"count", points},
                                 {"type", "VEC3"},
                                 {"min", lo},
                                 {"max", hi}}});
  for (const GlbPart& part : parts)
    accessors.push_back({{"bufferView", 1},
                         {"byteOffset", 12 * part.first},
                         {"componentType", type_u32},
                         {"count", 3 * part.triangles},
                         {"type", "SCALAR"}});
  return accessors;
}

std::string glb_json(const WeldedSurface& surface, const Palette& palette, const std::vector<GlbPart>& parts,
                     float step_m) {
  const size_t points = surface.points.size(), corners = 3 * surface.triangles.size();
  const size_t indices_at = 12 * points;
  const auto view = [](size_t at, size_t bytes, int target) {
    return Json{{"buffer", 0}, {"byteOffset", at}, {"byteLength", bytes}, {"target", target}};
  };
  Json materials = Json::array(), primitives = Json::array();
  for (const GlbPart& part : parts) {
    primitives.push_back({{"attributes", {{"POSITION", 0}}},
                          {"indices", 1 + materials.size()},
                          {"material", materials.size()}});
    materials.push_back(material_json(palette.row_or_first(part.material)));
  }
  const Json json{{"asset", {{"version", "2.0"}, {"generator", "scree-export"}}},
                  {"scene", 0},
                  {"scenes", Json::array({{{"nodes", {0}}}})},
                  {"nodes", Json::array({{{"mesh", 0}, {"name", "terrain"}}})},
                  {"materials", materials},
                  {"meshes", Json::array({{{"name", "terrain"}, {"primitives", primitives}}})},
                  {"accessors", glb_accessors(surface, parts, step_m)},
                  {"bufferViews", Json::array({view(0, 12 * points, target_vertices),
                                               view(indices_at, 4 * corners, target_indices)})},
                  {"buffers", Json::array({{{"byteLength", indices_at + 4 * corners}}})}};
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  return text;
}

void write_glb(std::ostream& out, const WeldedSurface& surface, const Palette& palette, float step_m) {
  const std::vector<GlbPart> parts = parts_of(surface);
  const std::string json = glb_json(surface, palette, parts, step_m);
  const size_t data = 12 * (surface.points.size() + surface.triangles.size());
  const size_t all = 12 + 8 + json.size() + 8 + data;
  CHECK(all <= std::numeric_limits<uint32_t>::max());  // limits::export_triangles_max
  for (const size_t word : {size_t{glb_magic}, size_t{glb_version}, all, json.size(), size_t{chunk_json}})
    put_bytes(out, static_cast<uint32_t>(word));
  out << json;
  put_bytes(out, static_cast<uint32_t>(data));
  put_bytes(out, chunk_bin);
  write_points(out, surface, step_m);
  for (const auto& t : surface.triangles) put_bytes(out, t);
}

struct SurfaceFormat {
  std::string_view ending;
  void (*write)(std::ostream& out, const WeldedSurface& surface, const Palette& palette, float step_m);
};
constexpr std::array<SurfaceFormat, 3> formats{
    {{".ply", write_ply}, {".obj", write_obj}, {".glb", write_glb}}};

const SurfaceFormat* format_of(const std::string& path) {
  const auto found =
      std::ranges::find_if(formats, [&](const auto& format) { return path.ends_with(format.ending); });
  return found == formats.end() ? nullptr : &*found;
}

Result<void> written(const std::string& path, const std::function<void(std::ostream&)>& write) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  write(out);
  out.close();
  if (!out) return fail(std::strerror(errno));
  return {};
}

}  // namespace

void order_by_material(WeldedSurface& surface) {
  std::ranges::sort(surface.triangles, [&](const auto& a, const auto& b) {
    return std::pair(surface.materials[a[0]], a) < std::pair(surface.materials[b[0]], b);
  });
}

bool is_surface_name(const std::string& path) {
  return format_of(path) != nullptr;
}

std::string materials_file_of(const std::string& path) {
  return path.ends_with(".obj") ? path.substr(0, path.size() - 4) + ".mtl" : "";
}

Result<uint64_t> write_surface(const WeldedSurface& surface, const Palette& palette, const std::string& path,
                               float step_m) {
  const SurfaceFormat* const format = format_of(path);
  CHECK(format != nullptr && !surface.points.empty() && surface.materials.size() == surface.points.size());
  const std::string beside = materials_file_of(path);
  if (!beside.empty())
    TRY(write_whole(beside, [&](const std::string& unfinished) {
      return written(unfinished, [&](std::ostream& out) { write_mtl(out, surface, palette); });
    }));
  return write_whole(path, [&](const std::string& unfinished) {
    return written(unfinished, [&](std::ostream& out) {
      if (!beside.empty()) out << "mtllib " << std::filesystem::path(beside).filename().string() << "\n";
      format->write(out, surface, palette, step_m);
    });
  });
}

}  // namespace scree
