#include "shared/surface/creases.h"

#include <gtest/gtest.h>
#include <map>
#include <set>

#include "shared/surface/surface_nets.h"
#include "tests/support/edge_uses.h"
#include "tests/support/edged_shapes.h"

namespace scree {
namespace {

glm::vec3 position_in(const SurfaceMesh& mesh, const SurfaceVertex& vertex) {
  return glm::vec3(mesh.origin.x, mesh.origin.y, mesh.origin.z) +
         glm::vec3(vertex.position[0], vertex.position[1], vertex.position[2]) / surface_steps_per_voxel;
}

VoxelCoord cell_around(glm::vec3 p) {
  return {floor_to_int(p.x), floor_to_int(p.y), floor_to_int(p.z)};
}

/// How far the vertices of the cells through which the shape's edges run are from these edges.
std::vector<float> edge_errors(const EdgedShape& shape, const ShapePlace& place, bool sharp) {
  const Window window = codes_of(shape, place);
  SurfaceMesh mesh = surface_nets(window, window.box.grown(-surface_nets_apron));
  std::map<VoxelCoord, size_t> vertex_of;
  for (size_t i = 0; i < mesh.vertices.size(); ++i)
    vertex_of[cell_around(position_in(mesh, mesh.vertices[i]))] = i;
  if (sharp) sharpen_creases(window, mesh);
  std::vector<float> errors;
  for (const auto& [from, to] : shape.edges) {
    const glm::vec3 a = place.out(from), b = place.out(to), along = glm::normalize(b - a);
    std::set<VoxelCoord> cells;
    for (float way = 0.0F; way < glm::distance(a, b); way += 0.01F)
      cells.insert(cell_around(a + along * way));
    for (const VoxelCoord& cell : cells) {
      const auto found = vertex_of.find(cell);
      if (found == vertex_of.end()) continue;
      const glm::vec3 off = position_in(mesh, mesh.vertices[found->second]) - a;
      errors.push_back(glm::length(off - along * glm::dot(off, along)));
    }
  }
  std::ranges::sort(errors);
  return errors;
}

TEST(Creases, edges_of_cubes_wedges_stairs_and_reveals_are_within_a_tenth_of_a_voxel) {
  for (const EdgedShape& shape : edged_shapes()) {
    std::vector<float> sharp, rounded;
    for (int i = 0; i < 8; ++i) {
      std::ranges::copy(edge_errors(shape, shape_place(i), true), std::back_inserter(sharp));
      std::ranges::copy(edge_errors(shape, shape_place(i), false), std::back_inserter(rounded));
    }
    std::ranges::sort(sharp);
    std::ranges::sort(rounded);
    ASSERT_GT(sharp.size(), 30U);
    const auto at = [](const std::vector<float>& errors, double share) {
      return errors[static_cast<size_t>(share * static_cast<double>(errors.size() - 1))];
    };
    std::printf("%s: median %.3f, 95 of 100 within %.3f voxels (nets: %.3f, %.3f)\n", shape.name.c_str(),
                at(sharp, 0.5), at(sharp, 0.95), at(rounded, 0.5), at(rounded, 0.95));
    EXPECT_LT(at(sharp, 0.95), 0.1F) << shape.name;
    EXPECT_GT(at(rounded, 0.5), 0.3F) << shape.name;
  }
}

TEST(Creases, vertices_on_an_edge_are_marked_and_those_beside_it_have_their_face_s_normal) {
  const EdgedShape shape = cube_shape();
  const ShapePlace place = shape_place(3);
  const Window window = codes_of(shape, place);
  SurfaceMesh mesh = surface_nets(window, window.box.grown(-surface_nets_apron));
  sharpen_creases(window, mesh);
  size_t marked = 0, faces = 0, off = 0;
  for (const SurfaceVertex& vertex : mesh.vertices) {
    const glm::vec3 n(vertex.normal[0], vertex.normal[1], vertex.normal[2]);
    const glm::vec3 home = place.in(position_in(mesh, vertex));
    const glm::vec3 to_face = glm::abs(glm::abs(home) - 6.3F);
    std::array<float, 3> by_distance{to_face.x, to_face.y, to_face.z};
    std::ranges::sort(by_distance);
    if (glm::length(n) < 70.0F) {
      ++marked;
      EXPECT_LT(by_distance[1], 0.15F) << "on two faces";
    } else if (by_distance[1] > 0.4F) {
      ++faces;
      const glm::vec3 turned = glm::abs(glm::inverse(place.turn) * glm::normalize(n));
      off += std::max({turned.x, turned.y, turned.z}) < 0.98F ? 1 : 0;
    }
  }
  EXPECT_GT(marked, 100U);
  EXPECT_GT(faces, 500U);
  EXPECT_LT(off, faces / 50);
}

/// A beam two voxels high in front of a pane of one voxel, as what people build lies between voxels.
Window beam_and_pane() {
  Window window({{-16, -16, -16}, {16, 16, 16}});
  for (int x = -16; x < 16; ++x)
    for (int y = -16; y < 16; ++y)
      for (int z = -16; z < 16; ++z) {
        const glm::vec3 p(x, y, z);
        const float beam = box_distance(p + glm::vec3(0.0F, 0.5F, 0.5F), {20.0F, 1.0F, 1.0F});
        const float pane = box_distance(p + glm::vec3(0.0F, 0.0F, 1.0F), {20.0F, 20.0F, 0.5F});
        window.at(x, y, z) = encode(std::min(beam, pane));
      }
  return window;
}

TEST(Creases, faces_of_two_voxels_and_steps_of_one_are_flat_and_sharp) {
  const Window window = beam_and_pane();
  SurfaceMesh mesh = surface_nets(window, window.box.grown(-surface_nets_apron));
  sharpen_creases(window, mesh);
  size_t on_beam = 0;
  for (const SurfaceVertex& vertex : mesh.vertices) {
    const glm::vec3 p = position_in(mesh, vertex);
    if (p.z < -0.6F || std::abs(p.y + 0.5F) > 1.3F) continue;
    ++on_beam;
    const bool in_front = std::abs(p.z - 0.5F) < 0.02F;
    const bool beside = std::abs(std::abs(p.y + 0.5F) - 1.0F) < 0.02F;
    EXPECT_TRUE(in_front || beside) << p.x << " " << p.y << " " << p.z;
    const glm::vec3 n = glm::vec3(vertex.normal[0], vertex.normal[1], vertex.normal[2]) / 127.0F;
    if (beside) {
      EXPECT_LT(glm::length(n), 0.6F) << "an edge";
    } else {
      EXPECT_GT(n.z, 0.98F) << "in the middle of the beam's front";
    }
  }
  EXPECT_GT(on_beam, 60U);
}

TEST(Creases, round_rock_stays_as_it_is) {
  const EdgedShape ball{"ball", [](glm::vec3 p) { return glm::length(p) - 9.3F; }, {}};
  const Window window = codes_of(ball, shape_place(2));
  SurfaceMesh mesh = surface_nets(window, window.box.grown(-surface_nets_apron));
  const SurfaceMesh before = mesh;
  sharpen_creases(window, mesh);
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    EXPECT_EQ(position_in(mesh, mesh.vertices[i]), position_in(before, before.vertices[i]));
    EXPECT_EQ(mesh.vertices[i].normal, before.vertices[i].normal);
  }
  EXPECT_EQ(mesh.indices, before.indices);
}

/// A block meshed as a whole, and in eight parts: the same vertices, and no edge is open.
TEST(Creases, parts_that_share_cells_meet) {
  for (const EdgedShape& shape : edged_shapes()) {
    const Window window = codes_of(shape, shape_place(5));
    using Place = std::array<int, 3>;
    EdgeUses<Place> uses;
    for (int i = 0; i < 8; ++i) {
      const VoxelCoord lo{(i & 4) != 0 ? 1 : -12, (i & 2) != 0 ? 1 : -12, (i & 1) != 0 ? 1 : -12};
      const VoxelBox owned{lo, {lo.x < 0 ? 1 : 12, lo.y < 0 ? 1 : 12, lo.z < 0 ? 1 : 12}};
      const Window part = part_of(window, owned.grown(surface_nets_apron));
      SurfaceMesh mesh = surface_nets(part, owned);
      sharpen_creases(part, mesh);
      count_edges(
          std::span<const uint32_t>(mesh.indices),
          [&](uint32_t index) {
            const auto& at = mesh.vertices[index].position;
            return Place{mesh.origin.x * surface_steps + at[0], mesh.origin.y * surface_steps + at[1],
                         mesh.origin.z * surface_steps + at[2]};
          },
          uses);
    }
    EXPECT_EQ(open_edges(uses), 0) << shape.name;
  }
}

}  // namespace
}  // namespace scree
