// The derived table of marching cubes: closed, and of the size that is known of it.
#include "shared/surface/cube_cases.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

#include "shared/surface/surface_cells.h"

namespace scree {
namespace {

bool is_rock(size_t signs, int corner) {
  return ((signs >> static_cast<unsigned>(corner)) & 1U) != 0;
}

using Segment = std::pair<int, int>;

/// Sides of triangles that no other triangle of the case has reversed.
std::set<Segment> outline(const CubeCase& cube) {
  std::set<Segment> sides;
  for (size_t t = 0; t < 3 * size_t{cube.triangles}; t += 3)
    for (size_t i = 0; i < 3; ++i) sides.insert({cube.edges[t + i], cube.edges[t + (i + 1) % 3]});
  std::set<Segment> open;
  for (const Segment& side : sides)
    if (!sides.contains({side.second, side.first})) open.insert(side);
  return open;
}

bool lies_in(int edge, int face) {
  const CellEdge& e = cell_tables().edges[static_cast<size_t>(edge)];
  const int bit = 4 >> (face / 2);
  const auto in = [&](int corner) { return ((corner & bit) != 0) == (face % 2 == 1); };
  return in(e.from) && in(e.to);
}

TEST(CubeCases, triangles_use_exactly_the_edges_that_are_crossed) {
  for (size_t signs = 0; signs < 256; ++signs) {
    const CubeCase& cube = cube_cases()[signs];
    std::set<int> used(cube.edges.begin(), cube.edges.begin() + 3 * cube.triangles);
    std::set<int> crossed;
    for (int e = 0; e < cell_edges; ++e) {
      const CellEdge& edge = cell_tables().edges[static_cast<size_t>(e)];
      if (is_rock(signs, edge.from) != is_rock(signs, edge.to)) crossed.insert(e);
    }
    EXPECT_EQ(used, crossed) << signs;
  }
}

/// Each corner that is rock alone among the four of a face is cut off there, from the air's side the same way
/// about: so two cells at a face have the same segments in it, in opposite directions.
TEST(CubeCases, what_is_open_lies_in_faces_and_depends_on_their_signs_alone) {
  std::map<std::pair<int, size_t>, std::set<Segment>> known;
  for (size_t signs = 0; signs < 256; ++signs) {
    const std::set<Segment> open = outline(cube_cases()[signs]);
    size_t in_faces = 0;
    for (int face = 0; face < cell_faces; ++face) {
      const int bit = 4 >> (face / 2);
      size_t face_signs = 0;
      for (int corner = 0; corner < cell_corners; ++corner)
        if (((corner & bit) != 0) == (face % 2 == 1) && is_rock(signs, corner))
          face_signs |= size_t{1} << static_cast<unsigned>(corner & ~bit);
      std::set<Segment> here;
      for (const Segment& side : open)
        if (lies_in(side.first, face) && lies_in(side.second, face)) here.insert(side);
      in_faces += here.size();
      const auto [before, is_new] = known.try_emplace({face, face_signs}, here);
      EXPECT_EQ(before->second, here) << "case " << signs << ", face " << face;
    }
    EXPECT_EQ(in_faces, open.size()) << "case " << signs;
  }
  const auto across = [](const Segment& side, int axis) {
    // The same edges seen from the neighbour: numbers differ by the axis' offset.
    const auto moved = [&](int e) {
      const CellEdge& edge = cell_tables().edges[static_cast<size_t>(e)];
      const int bit = 4 >> axis;
      for (int other = 0; other < cell_edges; ++other) {
        const CellEdge& there = cell_tables().edges[static_cast<size_t>(other)];
        if (there.from == (edge.from ^ bit) && there.to == (edge.to ^ bit)) return other;
      }
      return -1;
    };
    return Segment{moved(side.second), moved(side.first)};
  };
  for (const auto& [key, segments] : known) {
    if (key.first % 2 == 1) continue;
    std::set<Segment> mirrored;
    for (const Segment& side : segments) mirrored.insert(across(side, key.first / 2));
    EXPECT_EQ(mirrored, (known[{key.first + 1, key.second}])) << "face " << key.first;
  }
}

TEST(CubeCases, one_corner_makes_one_triangle_that_faces_the_air) {
  const CubeCase& cube = cube_cases()[1];
  ASSERT_EQ(cube.triangles, 1);
  // Corner 0 is rock: its edges along x, y and z, in that order, turn counter-clockwise seen from outside.
  std::array<int, 3> axes{cube.edges[0] / 4, cube.edges[1] / 4, cube.edges[2] / 4};
  std::ranges::rotate(axes, std::ranges::find(axes, 0));
  EXPECT_EQ(axes, (std::array<int, 3>{0, 1, 2}));
  int most = 0;
  for (const CubeCase& one : cube_cases()) most = std::max<int>(most, one.triangles);
  EXPECT_EQ(most, cube_triangles_max);
}

}  // namespace
}  // namespace scree
