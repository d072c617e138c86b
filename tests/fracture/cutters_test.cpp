// The cutters that work on polygons: parts that add up to the whole, whatever grazes what, and pieces that
// are the solid they came from.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "shared/base/limits.h"
#include "shared/base/random.h"
#include "shared/field/edit.h"
#include "shared/field/field.h"
#include "shared/field/terrain.h"
#include "shared/fracture/conform_cutter.h"
#include "shared/fracture/polygon_codes.h"
#include "shared/fracture/seeds.h"
#include "shared/fracture/slice_cutter.h"
#include "shared/fracture/voronoi_cells.h"
#include "tests/support/rounds.h"

namespace scree {
namespace {

constexpr PolygonCutting polygon_cutters[] = {slice_cutting, conform_cutting};

struct Scene {
  Window before, after, volume;

  Scene(TerrainKind kind, const Shape& shape) {
    MapField field({kind, 7, 0.25F});
    before = gather(field, band_box(shape));
    const Window solid = codes_of(shape, before.box);
    after = before;
    carve(after, solid);
    volume = extract(before, solid);
  }
};

glm::vec3 on_the_ground(TerrainKind kind) {
  const TerrainSource source{kind, 7, 0.25F};
  return glm::vec3(12.0F, ground_height_m(source, 3.0F, 11.0F) / 0.25F - 3.0F, 44.0F);
}

double parts_volume(const PolygonParts& cut) {
  double sum = 0.0;
  for (const PolygonMesh& part : cut.parts) sum += moments_of(part).volume;
  return sum;
}

void expect_conserved(const PolygonParts& cut, const std::string& what) {
  const double whole = moments_of(cut.whole).volume;
  EXPECT_NEAR(parts_volume(cut), whole, whole * 1e-6) << what;
  for (const PolygonMesh& part : cut.parts) EXPECT_GE(moments_of(part).volume, -1e-6) << what;
}

TEST(Slicer, halves_of_a_cube_are_closed_and_add_up) {
  PolygonBounds unit;
  unit.add(glm::dvec3(0.0));
  unit.add(glm::dvec3(1.0));
  const glm::dvec3 diagonal = glm::normalize(glm::dvec3(1.0));
  // Through the middle; through three corners; through an edge; through a face; past it all.
  const std::vector<std::pair<Plane, double>> cuts = {
      {{diagonal, std::sqrt(0.75)}, 0.5},
      {{diagonal, std::sqrt(1.0 / 3.0)}, 1.0 / 6.0},
      {{{1.0, 0.0, 0.0}, 0.25}, 0.25},
      {{glm::normalize(glm::dvec3(1.0, 1.0, 0.0)), 0.0}, 0.0},
      {{{0.0, 1.0, 0.0}, 0.0}, 0.0},
      {{{0.0, 1.0, 0.0}, 1.0}, 1.0},
      {{{0.0, 0.0, 1.0}, 2.0}, 1.0},
      {{{0.0, 0.0, 1.0}, -2.0}, 0.0},
      {{glm::normalize(glm::dvec3(1.0, -1.0, 0.0)), 0.0}, 0.5}};
  Slicer slicer;
  for (const auto& [plane, volume] : cuts) {
    PolygonMesh low = box_mesh(unit), high = low;
    slicer.slice(low, plane, 1);
    slicer.slice(high, {-plane.normal, -plane.offset}, 2);
    EXPECT_TRUE(is_closed(low));
    EXPECT_TRUE(is_closed(high));
    EXPECT_NEAR(moments_of(low).volume, volume, 1e-12);
    EXPECT_NEAR(moments_of(high).volume, 1.0 - volume, 1e-12);
  }
}

TEST(Slicer, a_cap_may_have_a_hole_or_be_of_two_islands) {
  // A shell: a ball within a ball, and two balls.
  Window shell(VoxelBox{{-12, -12, -12}, {13, 13, 13}}), pair(shell.box);
  for (int x = -12; x <= 12; ++x)
    for (int y = -12; y <= 12; ++y)
      for (int z = -12; z <= 12; ++z) {
        const float r = glm::length(glm::vec3(x, y, z));
        shell.at(x, y, z) = encode(std::max(r - 10.0F, 5.0F - r));
        pair.at(x, y, z) =
            encode(std::min(glm::length(glm::vec3(x - 6, y, z)), glm::length(glm::vec3(x + 6, y, z))) - 4.0F);
      }
  for (const Window* window : {&shell, &pair}) {
    const PolygonMesh whole = polygonise(*window);
    ASSERT_TRUE(is_closed(whole));
    Slicer slicer;
    PolygonMesh low = whole, high = whole;
    const Plane plane{glm::normalize(glm::dvec3(0.1, 1.0, 0.2)), 0.3};
    slicer.slice(low, plane, 1);
    slicer.slice(high, {-plane.normal, -plane.offset}, 2);
    EXPECT_TRUE(is_closed(low));
    EXPECT_NEAR(moments_of(low).volume + moments_of(high).volume, moments_of(whole).volume, 1e-6);
    EXPECT_NEAR(moments_of(low).volume / moments_of(whole).volume, 0.5, 0.1);
    // A second cut across the cap.
    PolygonMesh near = low, far = low;
    slicer.slice(near, {{1.0, 0.0, 0.0}, 0.5}, 3);
    slicer.slice(far, {{-1.0, 0.0, 0.0}, -0.5}, 4);
    EXPECT_TRUE(is_closed(near));
    EXPECT_NEAR(moments_of(near).volume + moments_of(far).volume, moments_of(low).volume, 1e-6);
  }
}

TEST(VoronoiCells, fill_their_box_and_skip_duplicates) {
  PolygonBounds room;
  room.add(glm::dvec3(-1.0));
  room.add(glm::dvec3(9.0));
  std::vector<glm::vec3> seeds;
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y)
      for (int z = 0; z < 5; ++z) seeds.emplace_back(2 * x, 2 * y, 2 * z);
  seeds.push_back(seeds[17]);
  seeds.emplace_back(50.0F, 0.0F, 0.0F);
  const std::vector<PolygonMesh> cells = voronoi_cells(seeds, room);
  double sum = 0.0;
  for (const PolygonMesh& cell : cells) {
    EXPECT_TRUE(is_closed(cell));
    sum += moments_of(cell).volume;
  }
  EXPECT_NEAR(sum, 1000.0, 1e-6);
  EXPECT_FALSE(cells[17].empty());
  EXPECT_TRUE(cells[125].empty()) << "coincides with 17";
  EXPECT_TRUE(cells[126].empty()) << "every place in the box is nearer to others";
}

TEST(Cutters, parts_add_up_to_the_whole) {
  for (const TerrainKind kind : {TerrainKind::flat, TerrainKind::noise, TerrainKind::canyon}) {
    const glm::vec3 c = on_the_ground(kind);
    const Scene scene(kind, sphere(c, 8.0F));
    for (const SeedPattern pattern : {SeedPattern::uniform, SeedPattern::radial})
      for (const uint32_t count : {1U, 2U, 64U, rounds(300U, 65U)})
        for (const PolygonCutting& cutting : polygon_cutters) {
          const auto seeds = scatter_seeds(scene.volume, pattern, count, 5, c);
          expect_conserved(
              cut_polygons(cutting, scene.volume, seeds),
              std::string(cutting.closed ? "slice" : "conform") + " of " + std::to_string(count));
        }
  }
}

TEST(Cutters, parts_add_up_where_planes_lie_in_the_surface) {
  // Flat ground and a box: the planes between seeds on a lattice lie in their faces, edges and corners.
  const glm::vec3 c = glm::round(on_the_ground(TerrainKind::flat));
  const Scene scene(TerrainKind::flat, box(c, {6.0F, 5.0F, 4.0F}));
  std::vector<glm::vec3> seeds;
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = -3; z <= 3; ++z) seeds.push_back(c + glm::vec3(x, y, z) * 2.0F);
  for (const PolygonCutting& cutting : polygon_cutters) {
    const PolygonParts cut = cut_polygons(cutting, scene.volume, seeds);
    expect_conserved(cut, "lattice");
    for (const PolygonMesh& part : cut.parts) EXPECT_TRUE(!cutting.closed || is_closed(part));
  }
}

TEST(Cutters, slice_and_conform_make_the_same_parts) {
  const glm::vec3 c = on_the_ground(TerrainKind::canyon);
  const Scene scene(TerrainKind::canyon, sphere(c, 8.0F));
  const auto seeds = scatter_seeds(scene.volume, SeedPattern::radial, 64, 5, c);
  const PolygonParts a = cut_polygons(slice_cutting, scene.volume, seeds);
  const PolygonParts b = cut_polygons(conform_cutting, scene.volume, seeds);
  size_t drawn_otherwise = 0;
  for (size_t i = 0; i < seeds.size(); ++i) {
    EXPECT_NEAR(moments_of(a.parts[i]).volume, moments_of(b.parts[i]).volume, 1e-6) << "cell " << i;
    drawn_otherwise += a.parts[i].vertices != b.parts[i].vertices ? 1 : 0;
  }
  EXPECT_GT(drawn_otherwise, seeds.size() / 2) << "two ways to the same parts, not one";
}

TEST(Cutters, mass_is_shared_out_to_the_unit) {
  for (const Cutter cutter : {Cutter::field, Cutter::slice, Cutter::conform})
    for (const uint32_t count : {1U, 7U, 64U, 1000U}) {
      const glm::vec3 c = on_the_ground(TerrainKind::noise);
      const Scene scene(TerrainKind::noise, capsule(c, c + glm::vec3(9.0F, -3.0F, 2.0F), 5.0F));
      MassUnits lost = 0;
      for (size_t i = 0; i < scene.before.codes.size(); ++i)
        lost += occupancy(scene.before.codes[i]) - occupancy(scene.after.codes[i]);
      const auto seeds = scatter_seeds(scene.volume, SeedPattern::uniform, count, 9, c);
      const Cut cut = cut_volume(cutter, scene.volume, scene.before, scene.after, seeds);
      MassUnits sum = cut.dust;
      std::vector<uint32_t> of_pieces;
      for (const CutPiece& piece : cut.pieces) {
        sum += piece.volume.mass;
        EXPECT_GE(piece.volume.mass, limits::piece_mass_min);
        of_pieces.insert(of_pieces.end(), piece.seeds.begin(), piece.seeds.end());
      }
      EXPECT_EQ(sum, lost);
      std::ranges::sort(of_pieces);
      ASSERT_EQ(of_pieces.size(), seeds.size());
      for (uint32_t i = 0; i < of_pieces.size(); ++i) EXPECT_EQ(of_pieces[i], i);
    }
}

TEST(Cutters, pieces_are_where_the_field_cutter_puts_them) {
  const glm::vec3 c = on_the_ground(TerrainKind::canyon);
  const Scene scene(TerrainKind::canyon, sphere(c, 8.0F));
  const auto seeds = scatter_seeds(scene.volume, SeedPattern::uniform, 24, 3, c);
  const Cut field = cut_volume(Cutter::field, scene.volume, scene.before, scene.after, seeds);
  for (const Cutter cutter : {Cutter::slice, Cutter::conform}) {
    const Cut cut = cut_volume(cutter, scene.volume, scene.before, scene.after, seeds);
    ASSERT_EQ(cut.pieces.size(), field.pieces.size());
    for (size_t i = 0; i < cut.pieces.size(); ++i) {
      const Volume &one = cut.pieces[i].volume, &other = field.pieces[i].volume;
      EXPECT_LT(glm::distance(one.centre_voxels, other.centre_voxels), 0.25F);
      EXPECT_NEAR(static_cast<double>(one.mass), static_cast<double>(other.mass), 0.08 * other.mass);
      int solid = 0, differ = 0;
      const VoxelBox& box = other.window.box;
      for (int x = box.lo.x; x < box.hi.x; ++x)
        for (int y = box.lo.y; y < box.hi.y; ++y)
          for (int z = box.lo.z; z < box.hi.z; ++z) {
            const Code theirs = other.window.at(x, y, z);
            const Code ours = one.window.box.holds({x, y, z}) ? one.window.at(x, y, z) : code_air;
            solid += theirs < 0 ? 1 : 0;
            if ((theirs < -20 && ours > 0) || (theirs > 20 && ours < 0)) ++differ;
          }
      EXPECT_LE(differ * 50, solid) << "piece " << i;
    }
  }
}

TEST(Cutters, codes_are_distances_to_the_polygons) {
  PolygonBounds bounds;
  bounds.add(glm::dvec3(2.3, 2.6, 2.1));
  bounds.add(glm::dvec3(8.4, 7.2, 9.9));
  const PolygonMesh brick = box_mesh(bounds);
  const VoxelBox room{{0, 0, 0}, {12, 12, 12}};
  PolygonDistances distances(room);
  for (const PolygonFace& face : brick.faces) distances.add(brick, face);
  std::vector<uint8_t> inside(Window::count(room));
  mark_inside(brick, room, inside);
  const Window codes = distances.codes(inside);
  const glm::vec3 half(3.05F, 2.3F, 3.9F);
  const Shape shape = box(glm::vec3(2.3F, 2.6F, 2.1F) + half, half);
  for (int x = 0; x < 12; ++x)
    for (int y = 0; y < 12; ++y)
      for (int z = 0; z < 12; ++z)
        EXPECT_NEAR(codes.at(x, y, z), encode(distance(shape, glm::vec3(x, y, z))), 1) << x << y << z;
}

TEST(Cutters, a_volume_of_nothing_and_seeds_of_none_are_survived) {
  const glm::vec3 c = on_the_ground(TerrainKind::flat);
  const Scene air(TerrainKind::flat, sphere(c + glm::vec3(0.0F, 80.0F, 0.0F), 8.0F));
  const Scene ground(TerrainKind::flat, sphere(c, 4.0F));
  for (const Cutter cutter : {Cutter::slice, Cutter::conform}) {
    const Cut nothing = cut_volume(cutter, air.volume, air.before, air.after, {c});
    EXPECT_TRUE(nothing.pieces.empty());
    EXPECT_EQ(nothing.dust, 0);
    const Cut dust = cut_volume(cutter, ground.volume, ground.before, ground.after, {});
    EXPECT_TRUE(dust.pieces.empty());
    EXPECT_GT(dust.dust, 0);
    // Outside, twice the same, and all in one plane.
    const Cut odd = cut_volume(cutter, ground.volume, ground.before, ground.after,
                               {c, c, c + glm::vec3(100.0F, 0.0F, 0.0F), c + glm::vec3(2.0F, 0.0F, 0.0F)});
    MassUnits sum = odd.dust;
    for (const CutPiece& piece : odd.pieces) sum += piece.volume.mass;
    EXPECT_EQ(sum, dust.dust);
    EXPECT_EQ(odd.pieces.size(), 2U);
  }
}

}  // namespace
}  // namespace scree
