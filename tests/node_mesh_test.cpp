// Nodes of all levels, meshed one by one: do they make one surface?
#include "client/render/node_mesh.h"

#include <gtest/gtest.h>
#include <map>

#include "shared/base/random.h"
#include "shared/field/operation.h"

namespace scree {
namespace {

using Position = std::array<int64_t, 3>;

/// In 1/256 voxel of level 0.
Position position_of(const NodeMesh& mesh, uint32_t index) {
  const SurfaceVertex& v = mesh.mesh.vertices[index];
  const VoxelCoord& o = mesh.mesh.origin;
  const auto steps = [&](int origin, uint16_t inside) {
    return (int64_t{origin} * 256 + inside) * (int64_t{1} << mesh.level);
  };
  return {steps(o.x, v.position[0]), steps(o.y, v.position[1]), steps(o.z, v.position[2])};
}

constexpr ForestShape shape{4, 4.0F, 16.0F, 70.0F, -20.0F, 36.0F};

class World {
 public:
  explicit World(Polygoniser polygoniser) : polygoniser_(polygoniser) {}

  void look_from(glm::vec3 eye_m) {
    while (!forest_.grow(eye_m, 1000).empty()) {
    }
  }

  /// A ball taken out, or put there.
  void edit(Random& random) {
    const glm::vec3 centre_m((random.unit() - 0.5F) * 50.0F, random.unit() * 24.0F - 4.0F,
                             (random.unit() - 0.5F) * 50.0F);
    const Shape ball = sphere(centre_m, 0.8F + random.unit() * 2.0F);
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
    for (const SurfaceNode& node : forest_.leaves_around({{-400, -400, -400}, {400, 400, 400}}, 0)) {
      const auto job = gather_node(levels_, field_, node, forest_.neighbours(node), polygoniser_);
      if (!job) continue;
      const NodeMesh mesh = mesh_node(*job);
      leaks.triangles_of_level[node.level] += mesh.mesh.indices.size() / 3;
      for (size_t t = 0; t < mesh.mesh.indices.size(); t += 3)
        for (size_t i = 0; i < 3; ++i)
          ++uses[{position_of(mesh, mesh.mesh.indices[t + i]),
                  position_of(mesh, mesh.mesh.indices[t + (i + 1) % 3])}];
    }
    leaks.edges = uses.size();
    for (const auto& [edge, count] : uses) {
      const auto back = uses.find({edge.second, edge.first});
      const bool closed = count == 1 && back != uses.end() && back->second == 1;
      if (!closed && is_inside(edge.first)) ++leaks.open;
    }
    return leaks;
  }

 private:
  /// Not at the outermost border of all leaves.
  bool is_inside(const Position& p) const {
    constexpr int margin = 2 << (shape.levels - 1);
    for (int i = 0; i < 8; ++i) {
      const auto at = [&](size_t axis, int bit) {
        return static_cast<int>(p[axis] >> 8) + ((i & bit) != 0 ? margin : -margin);
      };
      const VoxelCoord v{at(0, 4), at(1, 2), at(2, 1)};
      if (forest_.leaves_around({v, v + VoxelCoord{1, 1, 1}}, 0).empty()) return false;
    }
    return true;
  }

  Polygoniser polygoniser_;
  MapField field_{TerrainSource{TerrainKind::canyon, 1, 0.25F}};
  PieceTable pieces_;
  PieceId next_ = 1;
  SurfaceLevels levels_{field_.source(), shape.levels};
  SurfaceForest forest_{shape};
};

void expect_watertight(Polygoniser polygoniser, int edits, int every) {
  World world(polygoniser);
  Random random(17);
  for (int edit = 1; edit <= edits; ++edit) {
    world.edit(random);
    if (edit % every != 0) continue;
    world.look_from({random.unit() * 20.0F, random.unit() * 16.0F, random.unit() * 20.0F});
    const World::Leaks leaks = world.mesh_all();
    EXPECT_EQ(leaks.open, 0U) << "of " << leaks.edges << " edges, after edit " << edit;
    EXPECT_EQ(leaks.triangles_of_level.size(), static_cast<size_t>(shape.levels));
    for (const auto& [level, triangles] : leaks.triangles_of_level)
      EXPECT_GT(triangles, 500U) << "level " << level;
  }
}

TEST(NodeMesh, nets_are_watertight_over_random_edits_and_all_levels) {
  expect_watertight(Polygoniser::nets, 200, 100);
}

TEST(NodeMesh, dual_is_watertight_over_random_edits_and_all_levels) {
  expect_watertight(Polygoniser::dual, 200, 200);
}

}  // namespace
}  // namespace scree
