#include "tools/export/mesh_export.h"

#include <fmt/format.h>
#include <unordered_map>

#include "shared/field/material_window.h"
#include "shared/surface/surface_nets.h"
#include "tools/export/limits.h"
#include "tools/export/pinches.h"
#include "tools/export/surface_file.h"

namespace scree {

namespace {

using Point = WeldedSurface::Point;

struct PointHash {
  size_t operator()(const Point& p) const { return CoordHash()(VoxelCoord{p[0], p[1], p[2]}); }
};

class Welder {
 public:
  explicit Welder(Field& field) : field_(field) {}

  /// A vertex of a chunk's mesh is the same as its neighbour's, bit for bit. Several at one place become one:
  /// split_pinches() knows what belongs together.
  void add(const SurfaceMesh& mesh) {
    std::vector<uint32_t> place_of;
    place_of.reserve(mesh.vertices.size());
    for (const SurfaceVertex& vertex : mesh.vertices) {
      const Point point{mesh.origin.x * surface_steps + vertex.position[0],
                        mesh.origin.y * surface_steps + vertex.position[1],
                        mesh.origin.z * surface_steps + vertex.position[2]};
      const auto [found, is_new] = places_.try_emplace(point, static_cast<uint32_t>(welded_.points.size()));
      if (is_new) {
        welded_.points.push_back(point);
        welded_.materials.push_back(material_beneath(point, vertex));
      }
      place_of.push_back(found->second);
    }
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const std::array<uint32_t, 3> t{place_of[mesh.indices[i]], place_of[mesh.indices[i + 1]],
                                      place_of[mesh.indices[i + 2]]};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) welded_.triangles.push_back(t);
    }
  }
  WeldedSurface& welded() { return welded_; }

 private:
  /// The material of the rock half a voxel below the surface.
  Material material_beneath(const Point& point, const SurfaceVertex& vertex) const {
    const glm::vec3 out = glm::vec3(vertex.normal[0], vertex.normal[1], vertex.normal[2]) / 127.0F;
    const glm::vec3 at = glm::vec3(point[0], point[1], point[2]) / surface_steps_per_voxel - 0.5F * out;
    return material_at(field_, at * field_.source().voxel_size_m);
  }

  Field& field_;
  WeldedSurface welded_;
  std::unordered_map<Point, uint32_t, PointHash> places_;
};

/// The field's codes in the box, and air around it.
Window clipped_window(Field& field, const VoxelBox& part, const VoxelBox& box) {
  Window window(part);
  const VoxelBox inside = common(part, box);
  if (!inside.empty()) put(gather(field, inside), window);
  return window;
}

double volume_of(const WeldedSurface& mesh, float voxel_size_m) {
  double sum = 0.0;
  const auto at = [&](uint32_t i, size_t axis) {
    return static_cast<double>(mesh.points[i][axis] - mesh.points.front()[axis]);
  };
  for (const auto& [a, b, c] : mesh.triangles)
    sum += at(a, 0) * (at(b, 1) * at(c, 2) - at(b, 2) * at(c, 1)) +
           at(a, 1) * (at(b, 2) * at(c, 0) - at(b, 0) * at(c, 2)) +
           at(a, 2) * (at(b, 0) * at(c, 1) - at(b, 1) * at(c, 0));
  const double step_m = static_cast<double>(voxel_size_m) / surface_steps;
  return sum / 6.0 * step_m * step_m * step_m;
}

}  // namespace

Result<MeshExported> export_mesh(Field& field, const Palette& palette, const ChunkBox& box,
                                 const std::string& path, const std::function<void(double)>& progress) {
  const VoxelBox voxels = box.voxels();
  Welder welder(field);
  size_t done = 0;
  // One voxel more below: the walls there are the quads of edges whose lower voxel lies outside.
  for_each_chunk({voxels.lo - VoxelCoord{1, 1, 1}, voxels.hi}, [&](ChunkCoord chunk) {
    ++done;
    const VoxelCoord first = first_voxel(chunk);
    const VoxelBox owned{first, first + VoxelCoord{chunk_size, chunk_size, chunk_size}};
    if (welder.welded().triangles.size() > limits::export_triangles_max) return;
    welder.add(surface_nets(clipped_window(field, owned.grown(surface_nets_apron), voxels), owned));
    progress(std::min(1.0, static_cast<double>(done) / static_cast<double>(box.count())));
  });
  WeldedSurface& mesh = welder.welded();
  if (mesh.triangles.size() > limits::export_triangles_max)
    return fail(fmt::format("more than {} triangles (limits.export_triangles_max): --box makes them fewer",
                            limits::export_triangles_max));
  if (mesh.triangles.empty()) return fail("there is no rock in the box, or nothing else");
  split_pinches(mesh);
  order_by_material(mesh);
  const float voxel_m = field.source().voxel_size_m;
  const auto bytes = TRY(write_surface(mesh, palette, path, voxel_m / surface_steps_per_voxel));
  return MeshExported{mesh.points.size(), mesh.triangles.size(), bytes, volume_of(mesh, voxel_m)};
}

}  // namespace scree
