#include "tools/import/files/solid_files.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "content/builtin_palette.h"
#include "tools/import/assimp/mesh_file.h"
#include "tools/import/file_forms.h"
#include "tools/import/files/mesh_materials.h"
#include "tools/import/files/mesh_words.h"
#include "tools/import/mesh/mesh_solid.h"
#include "tools/import/vdb/vdb_file.h"
#include "tools/import/vox/vox_file.h"

namespace scree {

namespace {

/// A difference of volumes that is worth a word, relative.
constexpr double difference_said = 0.01;

/// Meshes with less than this part of the rock enclose nothing: it is rounding.
constexpr double nothing_share = 1.0e-6;

Result<void> read_vdb_file(const std::string& file, const SolidsImport& how, bool alone,
                           ImportPalette& palette, SolidsRead& read) {
  const size_t had = palette.added();
  auto vdb = read_vdb(
      file, {how.grid, how.density, how.place, how.voxel_size_m, how.reader, &palette, how.material_map});
  TRY(vdb);
  std::string words = fmt::format(
      "{}: taken: grid '{}', {}, in metres, {} up", file, vdb->grid,
      vdb->is_level_set ? "a level set" : fmt::format("a fog volume, rock above {} (--density)", how.density),
      how.place.z_up ? "z" : "y");
  if (!vdb->all_grids.empty()) words += "; the file holds " + vdb->all_grids + " (--grid)";
  if (const size_t added = palette.added() - had; added > 0) {
    words += fmt::format("; {} of its materials became rows of the palette: ", added);
    const auto names = palette.palette().names();
    for (size_t i = names.size() - added; i < names.size(); ++i)
      words += (i > names.size() - added ? ", " : "") + std::string(names[i]);
    words += " (--material-map)";
  }
  read.said.push_back(std::move(words));
  read.map_used.merge(vdb->map_used);
  read.solids.push_back(std::move(vdb->solid));
  ++read.volumes;
  read.volumes_volume_m3 += vdb->own_volume_m3;
  if (!alone) return {};
  read.exact = vdb->exact;
  read.level_m = vdb->level_m;
  read.layers = vdb->layers;
  if (read.exact) read.said.push_back(file + ": exported from a world: its distances are taken as they are");
  return {};
}

Result<void> read_vox_file(const std::string& file, const SolidsImport& how, ImportPalette& palette,
                           SolidsRead& read) {
  const VoxImport vox_import{.place = how.place,
                             .has_scale = how.has_scale,
                             .voxel_size_m = how.voxel_size_m,
                             .map = how.material_map,
                             .material = how.material,
                             .colour_rows_max = how.colour_rows_max,
                             .reader = how.reader};
  auto vox = TRY(read_vox(file, vox_import, palette));
  std::string words =
      fmt::format("{}: {} voxels in {} cop{} of models; taken: {}, z up as in all such files", file,
                  vox.voxels, vox.copies, vox.copies == 1 ? "y" : "ies",
                  how.has_scale ? fmt::format("a voxel as {:.6g} m (--scale)", how.place.scale)
                                : "a voxel as one of the world (--scale says another size)");
  if (vox.hidden > 0)
    words += fmt::format("; {} hidden part{} left out", vox.hidden, vox.hidden == 1 ? "" : "s");
  read.said.push_back(words + vox.materials);
  read.map_used.merge(vox.map_used);
  read.solids.push_back(std::move(vox.solid));
  ++read.volumes;
  read.volumes_volume_m3 += vox.own_volume_m3;
  return {};
}

Result<void> read_mesh_file(const std::string& path, const SolidsImport& how, ImportPalette& palette,
                            SolidsRead& read) {
  MeshFile file =
      TRY(read_meshes(path, how.place, how.reader, names_of(palette.palette(), how.material_map)));
  const auto voxel_m = static_cast<double>(how.voxel_size_m);
  if (file.step_m > voxel_m)
    return fail(fmt::format(
        "{}: its coordinates are so large that they are read in steps of {:.3g} m, more than a voxel: "
        "move the mesh near its origin first",
        path, file.step_m));
  const auto materials = give_materials(file, how, palette);
  if (!materials) return fail(path + ": " + materials.error().message);
  auto bodies = bodies_of(std::move(file.mesh), {how.sheet, voxel_m, how.level_m});
  if (!bodies) return fail(path + ": " + bodies.error().message);
  for (const std::string& words : words_on(file, *bodies, how, *materials))
    read.said.push_back(path + ": " + words);
  read.map_used.insert(file.map_used.begin(), file.map_used.end());
  ++read.meshes;
  const size_t parts = bodies->whole.parts + bodies->holed.parts + bodies->filled.parts;
  read.parts += parts - std::min(parts, bodies->turned.cavities);
  read.meshes_volume_m3 += bodies->volume_m3();
  read.thin_volume_m3 += bodies->thin.volume_m3;
  read.holed_volume_m3 += bodies->holed.volume_m3;
  if (bodies->closed.triangles.empty() && bodies->open.empty() && bodies->dropped.parts == 0)
    return fail(path +
                ": nothing of it is left: none of its triangles has an area, or each has its other side");
  if (bodies->closed.triangles.empty() && bodies->open.empty())
    return fail(path + ": nothing of it is left: it holds open sheets alone (--sheet)");
  const auto add = [&](TriangleMesh mesh, const std::vector<OpenBody::Edge>& edges) -> Result<void> {
    auto solid = solid_of_mesh(std::move(mesh), edges, how.voxel_size_m);
    if (!solid) return fail(path + ": " + solid.error().message);
    read.solids.push_back(std::move(*solid));
    return {};
  };
  if (!bodies->closed.triangles.empty()) TRY(add(std::move(bodies->closed), {}));
  for (OpenBody& body : bodies->open) TRY(add(std::move(body.mesh), body.edges));
  return {};
}

}  // namespace

bool is_solid_file(const std::string& path) {
  return is_volume_file(path) || is_voxels_file(path) || is_mesh_file(path);
}

std::optional<std::string> words_on_difference(const SolidsRead& read, double imported_m3) {
  const double own_m3 = read.meshes_volume_m3 + read.volumes_volume_m3;
  if (read.exact) return std::nullopt;
  if (std::abs(own_m3) < nothing_share * imported_m3)
    return fmt::format(
        "the rock has {:.6g} m³, and the meshes enclose none by themselves: winding numbers close open "
        "sheets around it (--sheet)",
        imported_m3);
  if (std::abs(imported_m3 - own_m3) <= difference_said * std::abs(own_m3)) return std::nullopt;
  const bool less = imported_m3 < own_m3;
  std::string words =
      fmt::format("the rock has {:.6g} m³, {:.2g} % {} than the {} by themselves; ", imported_m3,
                  100.0 * std::abs(imported_m3 - own_m3) / std::abs(own_m3), less ? "less" : "more",
                  read.volumes == 0  ? "meshes"
                  : read.meshes == 0 ? "volumes' voxels"
                                     : "files");
  if (read.thin_volume_m3 > 0.0) words += "parts thinner than a voxel are lost in part (--voxel-size), ";
  if (read.holed_volume_m3 != 0.0) words += "holes are not closed by flat caps, ";
  return words +
         (less && read.parts + read.volumes > 1
              ? "where parts overlap, their rock counts once, and voxels round edges off (--voxel-size)"
              : "voxels round edges off (--voxel-size)");
}

double least_volume_m3(const SolidsRead& read) {
  return read.thin_volume_m3 > 0.5 * read.meshes_volume_m3 ? 0.5 * read.meshes_volume_m3 : 0.0;
}

Result<SolidsRead> read_solids(const std::vector<std::string>& files, const SolidsImport& how) {
  SolidsRead read;
  ImportPalette palette(how.palette == nullptr ? shared_builtin_palette() : how.palette);
  for (const std::string& file : files) {
    if (is_volume_file(file))
      TRY(read_vdb_file(file, how, files.size() == 1, palette, read));
    else if (is_voxels_file(file))
      TRY(read_vox_file(file, how, palette, read));
    else
      TRY(read_mesh_file(file, how, palette, read));
  }
  read.palette = palette.result();
  return read;
}

}  // namespace scree
