#include "export/mesh_export.h"

#include <array>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <unistd.h>
#include <unordered_map>

#include "export/limits.h"
#include "shared/base/check.h"
#include "shared/surface/surface_nets.h"

namespace scree {

namespace {

/// A point in 1/256 voxel.
using Point = std::array<int32_t, 3>;

struct PointHash {
  size_t operator()(const Point& p) const { return CoordHash()(VoxelCoord{p[0], p[1], p[2]}); }
};

struct Welded {
  std::vector<Point> points;
  std::vector<std::array<uint32_t, 3>> triangles;
};

class Welder {
 public:
  /// A vertex of a chunk's mesh is the same as its neighbour's, bit for bit. Several at one place within a
  /// chunk, of sheets that touch there, stay apart as the triangles around them say.
  void add(const SurfaceMesh& mesh) {
    std::vector<uint32_t> place_of;
    place_of.reserve(mesh.vertices.size());
    for (const SurfaceVertex& vertex : mesh.vertices) {
      const Point point{mesh.origin.x * surface_steps + vertex.position[0],
                        mesh.origin.y * surface_steps + vertex.position[1],
                        mesh.origin.z * surface_steps + vertex.position[2]};
      const auto [found, is_new] = places_.try_emplace(point, static_cast<uint32_t>(welded_.points.size()));
      if (is_new) welded_.points.push_back(point);
      place_of.push_back(found->second);
    }
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const std::array<uint32_t, 3> t{place_of[mesh.indices[i]], place_of[mesh.indices[i + 1]],
                                      place_of[mesh.indices[i + 2]]};
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) welded_.triangles.push_back(t);
    }
  }
  const Welded& welded() const { return welded_; }

 private:
  Welded welded_;
  std::unordered_map<Point, uint32_t, PointHash> places_;
};

/// The field's codes in the box, and air around it.
Window cut_window(Field& field, const VoxelBox& part, const VoxelBox& box) {
  Window window(part);
  const VoxelBox inside = common(part, box);
  if (!inside.empty()) put(gather(field, inside), window);
  return window;
}

double volume_of(const Welded& mesh, float voxel_size_m) {
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

using Metres = std::array<float, 3>;
Metres metres_of(const Point& p, float step_m) {
  return {static_cast<float>(p[0]) * step_m, static_cast<float>(p[1]) * step_m,
          static_cast<float>(p[2]) * step_m};
}

void write_ply(std::ostream& out, const Welded& mesh, float step_m) {
  out << fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment metres, y up\nelement vertex {}\nproperty float x\n"
      "property float y\nproperty float z\nelement face {}\nproperty list uchar int "
      "vertex_indices\nend_header\n",
      mesh.points.size(), mesh.triangles.size());
  for (const Point& point : mesh.points) {
    const Metres p = metres_of(point, step_m);
    out.write(reinterpret_cast<const char*>(p.data()), sizeof p);
  }
  for (const auto& t : mesh.triangles) {
    out.put(3);
    out.write(reinterpret_cast<const char*>(t.data()), sizeof t);
  }
}

void write_obj(std::ostream& out, const Welded& mesh, float step_m) {
  out << "# metres, y up\no rock\n";
  for (const Point& point : mesh.points) {
    const Metres p = metres_of(point, step_m);
    out << fmt::format("v {} {} {}\n", p[0], p[1], p[2]);
  }
  for (const auto& t : mesh.triangles) out << fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
}

Result<uint64_t> write(const Welded& mesh, const std::string& path, float step_m) {
  const std::string unfinished = path + "." + std::to_string(getpid()) + ".unfinished";
  std::ofstream out(unfinished, std::ios::binary | std::ios::trunc);
  if (path.ends_with(".ply"))
    write_ply(out, mesh, step_m);
  else
    write_obj(out, mesh, step_m);
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(unfinished, path, error);
  if (!out || error) {
    std::filesystem::remove(unfinished, error);
    return fail(path + ": it cannot be written: " + std::strerror(errno));
  }
  return std::filesystem::file_size(path);
}

}  // namespace

bool is_mesh_name(const std::string& path) {
  return path.ends_with(".ply") || path.ends_with(".obj");
}

Result<MeshExported> export_mesh(Field& field, const ChunkBox& box, const std::string& path,
                                 const std::function<void(double)>& progress) {
  CHECK(is_mesh_name(path));
  const VoxelBox voxels = box.voxels();
  Welder welder;
  size_t done = 0;
  // One voxel more below: the walls there are the quads of edges whose lower voxel lies outside.
  for_each_chunk({voxels.lo - VoxelCoord{1, 1, 1}, voxels.hi}, [&](ChunkCoord chunk) {
    ++done;
    const VoxelCoord first = first_voxel(chunk);
    const VoxelBox owned{first, first + VoxelCoord{chunk_size, chunk_size, chunk_size}};
    if (welder.welded().triangles.size() > limits::export_triangles_max) return;
    welder.add(surface_nets(cut_window(field, owned.grown(surface_nets_apron), voxels), owned));
    progress(std::min(1.0, static_cast<double>(done) / static_cast<double>(box.count())));
  });
  const Welded& mesh = welder.welded();
  if (mesh.triangles.size() > limits::export_triangles_max)
    return fail(fmt::format("more than {} triangles (limits.export_triangles_max): --box makes them fewer",
                            limits::export_triangles_max));
  if (mesh.triangles.empty()) return fail("there is no rock in the box, or nothing else");
  const float voxel_m = field.source().voxel_size_m;
  const auto bytes = write(mesh, path, voxel_m / surface_steps_per_voxel);
  if (!bytes) return tl::unexpected(bytes.error());
  return MeshExported{mesh.points.size(), mesh.triangles.size(), *bytes, volume_of(mesh, voxel_m)};
}

}  // namespace scree
