#include "tools/import/files/mesh_words.h"

#include <fmt/format.h>

#include "shared/base/text.h"

namespace scree {

namespace {

/// Rounding of coordinates that is worth a word: this part of a voxel.
constexpr double rounding_said_voxels = 0.125;

/// Bytes of a file's name in a sentence.
constexpr size_t shown_bytes_max = 200;

std::string parts(size_t count) {
  return fmt::format("{} part{}", count, count == 1 ? "" : "s");
}

std::string assumptions(const MeshFile& file, const SolidsImport& how) {
  std::string words = "taken: ";
  if (file.metres_a_unit > 0.0 && how.place.scale == 1.0)
    words += file.metres_a_unit == 1.0 ? "metres" : fmt::format("a unit of {:.4g} m", file.metres_a_unit);
  else if (how.place.scale == 1.0)
    words += "a unit as a metre (--scale says another)";
  else
    words += fmt::format("a unit as {:.6g} m (--scale)", how.place.scale);
  if (how.place.z_up)
    words += file.says_up ? ", turned although the file says which way is up (--z-up)" : ", z up (--z-up)";
  else
    words += file.says_up ? ", up as the file says" : ", y up (--z-up says otherwise)";
  return words;
}

std::string surfaces(const MeshBodies& bodies) {
  std::string words;
  const auto add = [&](const std::string& more) { words += (words.empty() ? "" : "; ") + more; };
  if (bodies.whole.parts > 0)
    add(fmt::format("{}, closed, {:.6g} m³", parts(bodies.whole.parts), bodies.whole.volume_m3));
  if (bodies.holed.parts > 0)
    add(fmt::format(
        "{} not closed: {} open edges, {:.2g} % of the surface is missing; holes are closed by winding "
        "numbers, {:.6g} m³ with flat caps",
        parts(bodies.holed.parts), bodies.open_edges, 100.0 * bodies.missing, bodies.holed.volume_m3));
  if (bodies.filled.parts > 0)
    add(fmt::format("{} with a surface of {:.6g} m², open sheets, filled down to y = {:.4g} m, {:.6g} m³",
                    parts(bodies.filled.parts), bodies.filled.area_m2, bodies.bottom_m,
                    bodies.filled.volume_m3));
  if (bodies.dropped.parts > 0)
    add(fmt::format("{} with a surface of {:.6g} m², open sheets, left out", parts(bodies.dropped.parts),
                    bodies.dropped.area_m2));
  return words;
}

std::string repairs(const MeshBodies& bodies, size_t all_parts) {
  std::string words;
  const auto add = [&](const std::string& more) { words += (words.empty() ? "" : "; ") + more; };
  if (bodies.turned.turned_parts > 0)
    add(fmt::format("{} of {} parts had their inside outside and were turned", bodies.turned.turned_parts,
                    all_parts));
  if (bodies.turned.turned_triangles > 0)
    add(bodies.turned.turned_triangles == 1
            ? "a triangle stood against its neighbours and was turned"
            : fmt::format("{} triangles stood against their neighbours and were turned",
                          bodies.turned.turned_triangles));
  if (bodies.turned.cavities > 0)
    add(fmt::format("{} within others are cavities", parts(bodies.turned.cavities)));
  if (bodies.welded.joined_points > 0)
    add(fmt::format("{} points of torn seams were joined", bodies.welded.joined_points));
  if (bodies.welded.two_sided_triangles > 0)
    add(fmt::format("{} triangles are the second sides of others and were left out",
                    bodies.welded.two_sided_triangles));
  return words;
}

}  // namespace

std::vector<std::string> words_on(const MeshFile& file, const MeshBodies& bodies, const SolidsImport& how,
                                  const std::string& materials) {
  const size_t all_parts =
      bodies.whole.parts + bodies.holed.parts + bodies.filled.parts + bodies.dropped.parts;
  std::vector<std::string> said;
  said.push_back(fmt::format("{} triangles in {}, {}", bodies.triangles,
                             file.meshes == 1 ? "one mesh" : fmt::format("{} meshes", file.meshes),
                             surfaces(bodies)));
  said.push_back(assumptions(file, how) + materials);
  if (std::string words = repairs(bodies, all_parts); !words.empty()) said.push_back(std::move(words));
  if (!file.missing_materials.empty())
    said.push_back("it names '" + showable(file.missing_materials, shown_bytes_max) +
                   "', which is not there: its materials have no colours of their own, and become grey");
  for (const std::string& warning : file.warnings) said.push_back("assimp warns: " + warning);
  const auto voxel_m = static_cast<double>(how.voxel_size_m);
  if (bodies.thin.parts > 0)
    said.push_back(
        fmt::format("{} with {:.3g} m³ {} thinner than a voxel of {} m, the thinnest about {:.3g} m: some "
                    "of their rock may be lost (--voxel-size)",
                    parts(bodies.thin.parts), bodies.thin.volume_m3, bodies.thin.parts == 1 ? "is" : "are",
                    how.voxel_size_m, bodies.thinnest_m));
  if (bodies.slim.parts > 0)
    said.push_back(fmt::format(
        "{} with {:.3g} m³ {} thinner than two voxels of {} m{}: voxels round off a "
        "part of such rock (--voxel-size)",
        parts(bodies.slim.parts), bodies.slim.volume_m3, bodies.slim.parts == 1 ? "is" : "are",
        how.voxel_size_m,
        bodies.thin.parts > 0 ? "" : fmt::format(", the thinnest about {:.3g} m", bodies.thinnest_m)));
  if (file.step_m > rounding_said_voxels * voxel_m)
    said.push_back(
        fmt::format("its coordinates are so large that they are read in steps of {:.3g} m: move the mesh "
                    "near its origin before the import",
                    file.step_m));
  return said;
}

}  // namespace scree
