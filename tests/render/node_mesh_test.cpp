// Nodes of all levels, meshed one by one: do they make one surface?
#include "client/render/meshing/node_mesh.h"

#include <gtest/gtest.h>
#include <map>

#include "client/render/scene/mesh_place.h"
#include "shared/base/random.h"
#include "shared/operation/operation.h"
#include "tests/support/rounds.h"

namespace scree {
namespace {

/// Metres, as they are drawn (client/shaders/surface.vert).
using Position = std::array<float, 3>;

Position position_of(const NodeMesh& mesh, uint32_t index, float voxel_m) {
  const SurfaceVertex& v = mesh.mesh.vertices[index];
  const MeshPlace place = place_of(mesh.mesh.origin, mesh.level);
  const glm::vec3 at =
      (place.origin + glm::vec3(v.position[0], v.position[1], v.position[2]) * place.step) * voxel_m;
  return {at.x, at.y, at.z};
}

constexpr int levels = 4;

/// The same in voxels, whatever they measure.
ForestShape shape_of(float voxel_m) {
  return {levels, 16.0F * voxel_m, 64.0F * voxel_m, 280.0F * voxel_m, -20.0F, 36.0F};
}

class MeshedWorld {
 public:
  MeshedWorld(Polygoniser polygoniser, float voxel_m)
      : polygoniser_(polygoniser), field_(TerrainSource{TerrainKind::canyon, 1, voxel_m}) {}

  float voxel_m() const { return field_.source().voxel_size_m; }

  void set_eye(glm::vec3 eye_m) {
    while (!forest_.grow(eye_m, 1000).empty()) {
    }
  }

  /// A ball taken out, or put there.
  void edit(Random& random) {
    const float half_m = 100.0F * voxel_m();
    const glm::vec3 centre_m((random.unit() * 2.0F - 1.0F) * half_m, random.unit() * 24.0F - 4.0F,
                             (random.unit() * 2.0F - 1.0F) * half_m);
    const Shape ball = sphere(centre_m, (3.2F + random.unit() * 8.0F) * voxel_m());
    if (random.below(3) != 0) {
      apply(CarveOperation{ball, SeedPattern::uniform, 1, 1, centre_m, next_++}, field_, pieces_);
      pieces_.clear();
    } else {
      apply(FillOperation{ball}, field_, pieces_);
    }
  }

  struct Leaks {
    size_t edges = 0;
    size_t open = 0;
    std::map<int, size_t> triangles_of_level;
  };

  Leaks mesh_all() {
    std::map<std::pair<Position, Position>, int> uses;
    Leaks leaks;
    for (const SurfaceNode& node : forest_.leaves_around({{-900, -900, -900}, {900, 900, 900}}, 0)) {
      const auto job = gather_node(levels_, field_, node, forest_.neighbours(node), polygoniser_);
      if (!job) continue;
      const NodeMesh mesh = mesh_node(*job);
      leaks.triangles_of_level[node.level] += mesh.mesh.indices.size() / 3;
      for (size_t t = 0; t < mesh.mesh.indices.size(); t += 3)
        for (size_t i = 0; i < 3; ++i)
          ++uses[{position_of(mesh, mesh.mesh.indices[t + i], voxel_m()),
                  position_of(mesh, mesh.mesh.indices[t + (i + 1) % 3], voxel_m())}];
    }
    leaks.edges = uses.size();
    for (const auto& [edge, count] : uses) {
      const auto back = uses.find({edge.second, edge.first});
      // Two sheets may touch along an edge, and slivers whose edges are parted where looks meet lie on one.
      const bool closed = back != uses.end() && back->second == count;
      if (!closed && is_inside(edge.first)) ++leaks.open;
    }
    return leaks;
  }

 private:
  /// Not at the outermost border of all leaves.
  bool is_inside(const Position& p) const {
    constexpr int margin = 2 << (levels - 1);
    for (int i = 0; i < 8; ++i) {
      const auto at = [&](size_t axis, int bit) {
        return floor_to_int(p[axis] / voxel_m()) + ((i & bit) != 0 ? margin : -margin);
      };
      const VoxelCoord v{at(0, 4), at(1, 2), at(2, 1)};
      if (forest_.leaves_around({v, v + VoxelCoord{1, 1, 1}}, 0).empty()) return false;
    }
    return true;
  }

  Polygoniser polygoniser_;
  MapField field_;
  PieceTable pieces_;
  PieceId next_ = 1;
  SurfaceLevels levels_{field_.source(), levels};
  SurfaceForest forest_{shape_of(voxel_m())};
};

void expect_watertight(Polygoniser polygoniser, int edits, int every, float voxel_m) {
  MeshedWorld world(polygoniser, voxel_m);
  Random random(17);
  for (int edit = 1; edit <= edits; ++edit) {
    world.edit(random);
    if (edit % every != 0) continue;
    const float within_m = 80.0F * voxel_m;
    world.set_eye({random.unit() * within_m, random.unit() * 16.0F, random.unit() * within_m});
    const MeshedWorld::Leaks leaks = world.mesh_all();
    EXPECT_EQ(leaks.open, 0U) << "of " << leaks.edges << " edges, after edit " << edit;
    EXPECT_EQ(leaks.triangles_of_level.size(), static_cast<size_t>(levels));
    for (const auto& [level, triangles] : leaks.triangles_of_level)
      EXPECT_GT(triangles, 500U) << "level " << level;
  }
}

TEST(NodeMesh, nets_are_watertight_over_random_edits_and_all_levels) {
  expect_watertight(Polygoniser::nets, rounds(200, 50), rounds(20, 50), 0.25F);
}

TEST(NodeMesh, dual_is_watertight_over_random_edits_and_all_levels) {
  expect_watertight(Polygoniser::dual, rounds(200, 50), rounds(200, 50), 0.25F);
}

/// Sizes that no float holds exactly.
TEST(NodeMesh, all_are_watertight_whatever_a_voxel_measures) {
  expect_watertight(Polygoniser::nets, 40, 40, 0.1F);
  expect_watertight(Polygoniser::dual, 40, 40, 0.3F);
  expect_watertight(Polygoniser::cubes, 40, 40, 0.1F);
}

TEST(NodeMesh, cubes_are_watertight_over_random_edits_and_all_levels) {
  expect_watertight(Polygoniser::cubes, rounds(200, 50), rounds(20, 50), 0.25F);
}

}  // namespace
}  // namespace scree
