// What vertices say of their looks: how worn the ground is, and what they lie on.
#include <gtest/gtest.h>

#include "client/render/levels/block_windows.h"
#include "client/render/levels/level_bricks.h"
#include "client/render/levels/surface_looks.h"
#include "client/render/meshing/piece_mesh.h"
#include "client/render/scene/ground_tint.h"
#include "content/builtin_palette.h"
#include "shared/operation/operation.h"
#include "tests/support/edge_uses.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/mesh_position.h"

namespace scree {
namespace {

/// The shader's ground is of the built-in palette, which needs no tint.
TEST(GroundTints, are_the_colours_of_a_palette_over_those_of_the_built_in_one) {
  Palette palette = builtin_palette();
  const GroundTints none = ground_tints(palette);
  for (const glm::vec3& tint : {none.bulk, none.soil, none.cap}) EXPECT_EQ(tint, glm::vec3(1.0F));
  palette.rows[row_number(palette.ground.soil)].look.colour = {1.0F, 0.0F, 0.12F};
  EXPECT_EQ(ground_tints(palette).soil, glm::vec3(5.0F, 0.0F, 2.0F));
  EXPECT_EQ(ground_tints(palette).bulk, glm::vec3(1.0F));
}

constexpr Material brick{7}, concrete{6};  // of the built-in palette

glm::vec3 place_of(const SurfaceMesh& mesh, const SurfaceVertex& vertex) {
  return glm::vec3(mesh.origin.x, mesh.origin.y, mesh.origin.z) +
         glm::vec3(vertex.position[0], vertex.position[1], vertex.position[2]) / surface_steps_per_voxel;
}

/// A pit with walls along x = ±2 m in flat ground, whose uppermost metre is soil.
class Looks : public testing::Test {
 protected:
  void SetUp() override {
    PieceTable table;
    const CarveOperation pit{box({0.0F, 0.0F, 0.0F}, {2.0F, 3.0F, 6.0F}), {}, 1, 5, {}, 1};
    apply(Operation(pit), field_, table);
  }
  SurfaceMesh mesh() const {
    const std::optional<BlockWindows> windows = gather_windows(field_, {{0, -16, 0}, {16, 16, 16}});
    return windows ? windows->mesh(FaceEdges::sharp) : SurfaceMesh{};
  }
  /// Calls f(vertex, place in voxels) for each vertex of a block about one of the pit's edges.
  template <typename F>
  void for_each_vertex(F&& f) {
    const SurfaceMesh made = mesh();
    ASSERT_FALSE(made.empty());
    for (const SurfaceVertex& vertex : made.vertices) f(vertex, place_of(made, vertex));
  }

  MapField field_{flat_terrain};
};

TEST_F(Looks, a_wall_is_worn_up_to_the_ground_that_it_ends_at) {
  size_t walls = 0, ground = 0;
  for_each_vertex([&](const SurfaceVertex& vertex, glm::vec3 p) {
    const bool upright = std::abs(vertex.normal[0]) > 120;
    const bool flat = vertex.normal[1] > 126 && p.x > 12.5F;
    const int worn = unpacked_worn(vertex.before);
    // Two voxels below the ground's surface, at most.
    if (upright && p.y > -2.0F) {
      ++walls;
      EXPECT_LT(worn, -26) << p.x << " " << p.y;
    }
    if (flat && p.y > -1.0F) {
      ++ground;
      EXPECT_LE(std::abs(worn), 4) << p.x << " " << p.y;
    }
  });
  EXPECT_GT(walls, 10U);
  EXPECT_GT(ground, 10U);
}

TEST_F(Looks, a_cut_lays_soil_bare_as_deep_as_it_is_and_the_ground_above_stays_as_it_was) {
  const float depth = field_.source().rows.soil_depth_m / voxel_m;
  size_t walls = 0;
  for_each_vertex([&](const SurfaceVertex& vertex, glm::vec3 p) {
    const bool on_top = vertex.normal[1] > 126 && p.y > -1.0F && p.x > 12.5F;
    EXPECT_TRUE(!on_top || vertex.look == 0) << p.x;
    if (std::abs(vertex.normal[0]) < 120 || unpacked_worn(vertex.before) > -58) return;
    if (std::abs(-p.y - depth) < 1.0F || p.y > -0.6F) return;  // within a voxel of its end
    ++walls;
    EXPECT_EQ(vertex.look, -p.y < depth ? said(material::soil) : 0) << p.y;
  });
  EXPECT_GT(walls, 50U);
}

TEST_F(Looks, what_is_painted_looks_so_voxel_by_voxel_and_rubble_of_the_bulk_as_the_ground) {
  PieceTable table;
  const Shape half = box({2.0F, -2.0F, 1.0F}, {2.0F, 2.0F, 1.0F});
  apply(Operation(PaintOperation{half, material::ice}), field_, table);
  size_t painted = 0, other = 0;
  for_each_vertex([&](const SurfaceVertex& vertex, glm::vec3 p) {
    if (std::abs(vertex.normal[0]) < 120 || p.y < -6.0F || p.y > -5.0F) return;
    if (p.z < 1.0F || std::abs(p.z - 8.0F) < 1.6F) return;  // the paint's edges
    EXPECT_EQ(vertex.look, p.z < 8.0F ? said(material::ice) : 0) << p.z;
    ++(p.z < 8.0F ? painted : other);
  });
  EXPECT_GT(painted, 3U);
  EXPECT_GT(other, 3U);
  apply(Operation(PaintOperation{half, material::rock}), field_, table);
  for_each_vertex(
      [&](const SurfaceVertex& vertex, glm::vec3) { EXPECT_NE(vertex.look, said(material::ice)); });
}

TEST_F(Looks, no_triangle_lies_on_two_materials) {
  PieceTable table;
  for (const Material material : {material::ice, brick, concrete}) {
    const float z_m = 0.4F * static_cast<float>(row_number(material));
    apply(Operation(FillOperation{box({3.0F, 0.2F, z_m}, {0.7F, 0.5F, 0.5F}), material}), field_, table);
  }
  const SurfaceMesh made = mesh();
  std::vector<size_t> looks(256);
  for (size_t i = 0; i < made.indices.size(); i += 3) {
    const uint8_t look = made.vertices[made.indices[i]].look;
    ++looks[look];
    EXPECT_EQ(made.vertices[made.indices[i + 1]].look, look);
    EXPECT_EQ(made.vertices[made.indices[i + 2]].look, look);
  }
  for (const Material material : {brick, concrete}) EXPECT_GT(looks[said(material)], 10U);
}

TEST(PieceLooks, a_piece_of_two_materials_is_closed_and_has_both) {
  MapField field(flat_terrain);
  PieceTable table;
  apply(Operation(FillOperation{box({-0.5F, 1.0F, 0.0F}, {0.5F, 1.0F, 0.5F}), brick}), field, table);
  apply(Operation(FillOperation{box({0.5F, 1.0F, 0.0F}, {0.5F, 1.0F, 0.5F}), concrete}), field, table);
  const CarveOperation carve{box({0.0F, 1.4F, 0.0F}, {1.5F, 1.0F, 1.0F}), {}, 1, 5, {}, 1};
  apply(Operation(carve), field, table);
  ASSERT_EQ(table.size(), 1U);
  const PieceMesh made = mesh_piece(gather_piece(field, 1, {table.at(1), {}}));
  EdgeUses<MeshPosition> uses;
  count_edges(
      std::span<const uint32_t>(made.mesh.indices),
      [&](uint32_t index) { return position_of(made.mesh, index); }, uses);
  EXPECT_EQ(open_edges(uses), 0);
  for (const SurfaceVertex& vertex : made.mesh.vertices) {
    const float x = place_of(made.mesh, vertex).x;
    if (std::abs(x) < 1.0F) continue;
    EXPECT_EQ(vertex.look, said(x < 0.0F ? brick : concrete)) << x;
  }
}

TEST(PieceLooks, a_piece_of_the_ground_looks_as_the_ground_but_where_it_was_cut_in_a_layer) {
  MapField field(flat_terrain);
  PieceTable table;
  apply(Operation(CarveOperation{sphere({0.0F, 0.0F, 0.0F}, 1.5F), {}, 1, 5, {}, 1}), field, table);
  const PieceMesh made = mesh_piece(gather_piece(field, 1, {table.at(1), {}}));
  size_t on_top = 0, beneath = 0;
  for (const SurfaceVertex& vertex : made.mesh.vertices) {
    const glm::vec3 p = place_of(made.mesh, vertex);
    if (vertex.normal[1] > 126 && std::hypot(p.x, p.z) < 5.0F) {
      ++on_top;
      EXPECT_EQ(vertex.look, 0) << p.x << ' ' << p.y << ' ' << p.z;
    } else if (p.y < -1.5F && p.y > -3.0F) {
      ++beneath;
      EXPECT_EQ(vertex.look, said(material::soil)) << p.y;
    } else if (p.y < -5.2F) {
      EXPECT_EQ(vertex.look, 0) << p.y;
    }
  }
  EXPECT_GT(on_top, 10U);
  EXPECT_GT(beneath, 10U);
}

TEST(BrickLooksTest, untouched_ground_has_none_and_edited_bricks_have_those_of_their_rock) {
  MapField field(flat_terrain);
  LevelBricks bricks(flat_terrain, 0);
  const LevelBrick untouched = bricks.read(field, {0, -1, 0});
  EXPECT_EQ(untouched.looks.all, Look{});
  EXPECT_EQ(untouched.looks.each, nullptr);
  PieceTable table;
  apply(Operation(FillOperation{box({0.5F, 2.9F, 1.0F}, {0.5F, 0.5F, 1.5F}), brick}), field, table);
  const LevelBrick one = bricks.read(field, {0, 1, 0});
  EXPECT_EQ(one.looks.each, nullptr) << "the air about it says nothing";
  EXPECT_EQ(one.looks.all.shown, said(brick));
  apply(Operation(FillOperation{box({1.5F, 2.9F, 1.0F}, {0.5F, 0.5F, 1.5F}), concrete}), field, table);
  const LevelBrick two = bricks.read(field, {0, 1, 0});
  ASSERT_NE(two.looks.each, nullptr);
  const auto at = [&](int x, int y, int z) {
    return (*two.looks.each)[static_cast<size_t>((x * corner_brick_side + y) * corner_brick_side + z)].shown;
  };
  EXPECT_EQ(at(1, 3, 3), said(brick));
  EXPECT_EQ(at(6, 3, 3), said(concrete));
  EXPECT_EQ(at(8, 3, 3), said(concrete)) << "beside the last of its rock";
  LevelBricks coarse(flat_terrain, 1);
  const LevelBrick far = coarse.read(field, {0, 0, 0});
  ASSERT_NE(far.looks.each, nullptr);
  EXPECT_EQ((*far.looks.each)[static_cast<size_t>((1 * corner_brick_side + 6) * corner_brick_side + 1)].shown,
            said(brick));
}

/// A layer 3 codes higher than the ground, with one voxel of gravel in it.
TEST(HeapsTest, a_thin_layer_has_the_looks_of_the_heap_beside_it_where_the_surface_has_risen) {
  const VoxelBox box{{0, 0, 0}, {8, 8, 8}};
  Window now(box), before(box);
  LookWindow looks{box, std::vector<Look>(Window::count(box))};
  for (int x = 0; x < 8; ++x)
    for (int y = 0; y < 8; ++y)
      for (int z = 0; z < 8; ++z) {
        before.at(x, y, z) = encode(static_cast<float>(y) - 3.4F);
        now.at(x, y, z) = encode(static_cast<float>(y) - (x < 5 ? 3.9F : 3.4F));
      }
  constexpr uint8_t gravel = 9;
  now.at(3, 4, 3) = encode(-0.2F);
  looks.each[looks.index({3, 4, 3})] = {gravel, gravel};
  spread_heaps(now, before, box.grown(-1), looks);
  EXPECT_EQ(looks.at({2, 3, 3}).shown, gravel) << "beneath it the surface has risen by half a voxel";
  EXPECT_EQ(looks.at({4, 3, 4}).shown, gravel);
  EXPECT_EQ(looks.at({5, 3, 3}).shown, 0) << "the ground here is as it was";
  EXPECT_EQ(looks.at({1, 3, 3}).shown, 0) << "two voxels away";
}

TEST(PackedWorn, keeps_what_has_gone_and_what_has_come_within_a_step) {
  for (int worn = -127; worn <= 127; ++worn) {
    const int kept = std::clamp(worn, -worn_all, worn_all);
    EXPECT_NEAR(unpacked_worn(packed_worn(worn)), kept, 3) << worn;
  }
  EXPECT_EQ(packed_worn(0), 0);
}

}  // namespace
}  // namespace scree
