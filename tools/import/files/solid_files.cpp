#include "tools/import/files/solid_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>

#include "tools/import/assimp/mesh_file.h"
#include "tools/import/mesh/mesh_solid.h"
#include "tools/import/vdb/vdb_file.h"

namespace scree {

namespace {

constexpr std::array<std::string_view, 8> mesh_endings = {".obj", ".ply", ".stl", ".gltf",
                                                          ".glb", ".off", ".dae", ".3ds"};

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

Result<void> read_vdb_file(const std::string& file, const SolidsImport& how, bool alone, SolidsRead& read) {
  auto vdb = read_vdb(file, {how.grid, how.density, how.place, how.voxel_size_m});
  TRY(vdb);
  read.said.push_back(fmt::format(
      "{}: grid '{}', {}", file, vdb->grid,
      vdb->is_level_set ? "a level set" : fmt::format("a fog volume, rock above {}", how.density)));
  read.solids.push_back(std::move(vdb->solid));
  if (!alone) return {};
  read.exact = vdb->exact;
  read.level_m = vdb->level_m;
  read.layers = vdb->layers;
  if (read.exact) read.said.push_back(file + ": exported from a world: its distances are taken as they are");
  return {};
}

Result<void> add_mesh(const std::string& file, TriangleMesh mesh, float voxel_size_m, SolidsRead& read) {
  const MeshRepair repair = turn_inside_in(mesh);
  const double volume = volume_m3(mesh);
  std::string words = fmt::format("{}: mesh '{}', {} triangles", file, mesh.name, mesh.triangles.size());
  if (repair.open_edges == 0) words += fmt::format(", closed, {:.6g} m³", volume);
  if (repair.open_edges > 0)
    words += fmt::format(", not closed: {} open edges; its holes are closed by winding numbers",
                         repair.open_edges);
  if (repair.turned_parts > 0)
    words += fmt::format("; {} of {} parts had their inside outside and were turned", repair.turned_parts,
                         repair.parts);
  read.said.push_back(std::move(words));
  read.meshes_volume_m3 += volume;
  const std::string name = mesh.name;
  auto solid = solid_of_mesh(std::move(mesh), repair.open_edges == 0, voxel_size_m);
  if (!solid) return fail(fmt::format("{}: mesh '{}': {}", file, name, solid.error().message));
  read.solids.push_back(std::move(*solid));
  return {};
}

}  // namespace

bool is_solid_file(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".vdb" || std::ranges::find(mesh_endings, ending) != mesh_endings.end();
}

Result<SolidsRead> read_solids(const std::vector<std::string>& files, const SolidsImport& how) {
  SolidsRead read;
  for (const std::string& file : files) {
    if (ending_of(file) == ".vdb") {
      TRY(read_vdb_file(file, how, files.size() == 1, read));
      continue;
    }
    auto meshes = TRY(read_meshes(file, how.place));
    for (TriangleMesh& mesh : meshes) TRY(add_mesh(file, std::move(mesh), how.voxel_size_m, read));
  }
  return read;
}

}  // namespace scree
