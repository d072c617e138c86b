// Misuse of the cutters aborts, in every build; open meshes are found.
#include <gtest/gtest.h>

#include "shared/base/limits.h"
#include "shared/fracture/cell_groups.h"
#include "shared/fracture/cutter.h"
#include "shared/fracture/polygon_mesh.h"
#include "shared/fracture/seeds.h"

namespace scree {
namespace {

constexpr VoxelBox room{{0, 0, 0}, {12, 12, 12}};
constexpr VoxelBox elsewhere{{1, 0, 0}, {13, 12, 12}};

TEST(FractureDeathTest, windows_of_one_cut_have_the_same_box) {
  const Window rock(room, code_solid), air(room), other(elsewhere);
  const std::vector<glm::vec3> seeds{{3.0F, 6.0F, 6.0F}, {9.0F, 6.0F, 6.0F}};
  for (const Cutter cutter : {Cutter::field, Cutter::slice, Cutter::conform})
    EXPECT_DEATH(cut_volume(cutter, rock, rock, other, seeds), "CHECK failed: volume.box == before.box");
}

TEST(FractureDeathTest, a_cut_has_no_more_seeds_than_the_limit) {
  const Window rock(room, code_solid), air(room);
  const std::vector<glm::vec3> seeds(limits::seeds_max + 1, glm::vec3(6.0F));
  EXPECT_DEATH(cut_volume(Cutter::field, rock, rock, air, seeds), "CHECK failed");
  EXPECT_DEATH(scatter_seeds(rock, SeedPattern::uniform, limits::seeds_max + 1, 1, glm::vec3(0.0F)),
               "CHECK failed: count > 0");
}

TEST(FractureDeathTest, a_box_without_volume_has_no_mesh) {
  EXPECT_DEATH(box_mesh({glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 1.0)}), "CHECK failed");
}

TEST(FractureDeathTest, a_mesh_is_closed_when_every_edge_has_its_reverse) {
  PolygonMesh mesh = box_mesh({glm::dvec3(0.0), glm::dvec3(1.0)});
  EXPECT_TRUE(is_closed(mesh));
  std::swap(mesh.edges[3].from, mesh.edges[3].to);
  EXPECT_FALSE(is_closed(mesh));
}

TEST(FractureDeathTest, groups_of_cells_need_a_cell) {
  EXPECT_DEATH(CellGroups({}, {}), "CHECK failed: !cells.empty()");
}

}  // namespace
}  // namespace scree
