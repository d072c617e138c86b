#include "tools/import/assimp/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

#include "shared/base/regular_file.h"
#include "tools/import/assimp/scene_reader.h"
#include "tools/import/file_forms.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

/// Between 32-bit floats near a number, relative to it.
constexpr double float_step = 1.0 / 8'388'608.0;

glm::dvec3 placed(const std::array<double, 3>& own, const Placement& place) {
  const glm::dvec3 turned =
      place.z_up ? glm::dvec3(own[0], own[2], -own[1]) : glm::dvec3(own[0], own[1], own[2]);
  return turned * place.scale + glm::dvec3(place.at_m[0], place.at_m[1], place.at_m[2]);
}

/// Each triangle's: a row of the palette, or one of the file's own.
Result<void> take_materials(const std::vector<SceneMaterial>& materials, MeshFile& file) {
  file.mesh.materials.reserve(materials.size());
  file.foreign_of.reserve(materials.size());
  for (const SceneMaterial number : materials) {
    const size_t own = number < scene_own_first ? 0 : 1 + size_t{number} - scene_own_first;
    if (own > file.foreign.size() || (own == 0 && number > materials_max))
      return fail("it has a material without a name");
    if (own > 0) ++file.foreign[own - 1].colour.weight;
    file.mesh.materials.push_back(own > 0 ? ground_own : static_cast<VoxelMaterial>(number));
    file.foreign_of.push_back(static_cast<uint16_t>(own));
  }
  return {};
}

Result<void> receive_mesh(ReaderChannel& reader, const Placement& place, MeshFile& file) {
  const auto points = TRY(reader.get_list<std::array<double, 3>>(limits::import_triangles_max));
  file.mesh.triangles = TRY(reader.get_list<TriangleMesh::Triangle>(limits::import_triangles_max));
  const auto materials = TRY(reader.get_list<SceneMaterial>(limits::import_triangles_max));
  const auto colours = TRY(reader.get_list<SceneColour>(limits::scene_materials_max));
  if (file.mesh.triangles.empty()) return fail("it holds no triangle");
  if (materials.size() != file.mesh.triangles.size())
    return fail("its triangles and their materials do not agree");
  for (const TriangleMesh::Triangle& t : file.mesh.triangles)
    if (std::ranges::max(t) >= points.size()) return fail("it has a triangle without its points");
  for (const SceneColour& one : colours) {
    file.foreign.emplace_back().colour.linear = one.linear;
    file.foreign.back().has_colour = one.is_known != 0;
  }
  TRY(take_materials(materials, file));
  double largest = 0.0;
  for (const std::array<double, 3>& p : points) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      return fail("it has a point that is not a number");
    largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    file.mesh.points.push_back(placed(p, place));
  }
  file.step_m = largest * float_step * place.scale;
  return {};
}

Result<MeshFile> meshes_in(const std::string& path, const Placement& place, const ReaderLimits& bounds,
                           const MaterialMap& named) {
  TRY(check_is_file(path));
  const auto reader = TRY(ReaderProcess::start(
      "assimp", bounds,
      [&](ReaderChannel& channel) { return send_scene(channel, path, ending_of(path), named); },
      file_and_its_folder(path)));
  const auto head = TRY(reader->get<SceneHead>());
  if (head.foreign_materials > limits::scene_materials_max || head.warnings > scene_warnings_max ||
      head.named > named.size() || !std::isfinite(head.metres_a_unit))
    return fail("its form is unknown");
  MeshFile file;
  file.meshes = head.meshes;
  file.unread_textures = head.unread_textures;
  file.metres_a_unit = head.metres_a_unit;
  file.says_up = head.says_up != 0;
  file.mesh.name = std::filesystem::path(path).filename();
  TRY(receive_mesh(*reader, place, file));
  if (file.foreign.size() != head.foreign_materials)
    return fail("its materials and their colours do not agree");
  for (MeshFile::Foreign& one : file.foreign) one.colour.name = TRY(reader->get_text());
  for (uint64_t i = 0; i < head.warnings; ++i) file.warnings.push_back(TRY(reader->get_text()));
  for (uint64_t i = 0; i < head.named; ++i) file.map_used.insert(TRY(reader->get_text()));
  file.missing_materials = TRY(reader->get_text());
  return file;
}

}  // namespace

Result<MeshFile> read_meshes(const std::string& path, const Placement& place, const ReaderLimits& bounds,
                             const MaterialMap& named) {
  try {
    auto file = meshes_in(path, place, bounds, named);
    if (!file) return fail(path + ": " + file.error().message);
    return file;
  } catch (const std::bad_alloc&) {
    return fail(path + ": it does not fit into memory (--memory-max)");
  }
}

}  // namespace scree
