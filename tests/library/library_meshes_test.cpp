// Meshes and memory of scree/client.h: what a program uploads, and where it comes from.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>

#include "tests/support/library_fixture.h"

namespace scree {
namespace {

/// What a mesher's meshes must be.
void check_mesh(const scree_mesh& mesh) {
  ASSERT_GT(mesh.vertex_count, 0U);
  ASSERT_EQ(mesh.index_count % 3, 0U);
  for (size_t i = 0; i < mesh.index_count; ++i) ASSERT_LT(mesh.indices[i], mesh.vertex_count);
  for (size_t v = 0; v < mesh.vertex_count; ++v) {
    const float* const n = mesh.normals + 3 * v;
    ASSERT_NEAR(std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), 1.0F, 0.02F);
    for (int axis = 0; axis < 3; ++axis) ASSERT_TRUE(std::isfinite(mesh.positions[3 * v + axis]));
  }
}

TEST_F(LibraryTest, a_mesher_has_the_ground_around_and_replaces_what_a_carve_changes) {
  join();
  scree_mesher_options options;
  ASSERT_EQ(scree_mesher_options_init(&options, sizeof options), SCREE_OK);
  options.radius_m = 32.0F;
  scree_mesher* mesher = nullptr;
  ASSERT_EQ(scree_mesher_create(client, &options, &mesher), SCREE_OK) << scree_error();
  const float eye[3] = {0.0F, 3.0F, 0.0F}, far[3] = {7e6F, 0.0F, 0.0F}, high[3] = {0.0F, 1e7F, 0.0F};
  EXPECT_EQ(scree_mesher_update(mesher, far), SCREE_INVALID);
  EXPECT_EQ(scree_mesher_update(mesher, high), SCREE_INVALID);
  std::set<std::array<int, 4>> nodes;
  int pieces = 0, updates = 0;
  float lowest_m = 0.0F;
  const auto take = [&] {
    if (scree_mesher_update(mesher, eye) != SCREE_OK) return;
    ++updates;
    auto mesh = sized<scree_mesh>();
    uint32_t flags = 0;
    while (scree_mesher_next(mesher, &mesh) == SCREE_OK) {
      flags = mesh.flags;
      if ((mesh.flags & 1U) == 0) check_mesh(mesh);
      if (mesh.kind == 1) pieces += (mesh.flags & 1U) == 0 ? 1 : 0;
      if (mesh.kind == 1) continue;
      const std::array<int, 4> node{mesh.level, mesh.node[0], mesh.node[1], mesh.node[2]};
      if ((mesh.flags & 1U) != 0) nodes.erase(node);
      if ((mesh.flags & 1U) != 0) continue;
      nodes.insert(node);
      for (size_t v = 0; v < mesh.vertex_count; ++v)
        lowest_m = std::min(lowest_m, mesh.origin_m[1] + mesh.positions[3 * v + 1]);
    }
    EXPECT_EQ(flags & 2U, 2U) << "the last says so";
  };
  const auto complete = [&] {
    take();
    uint32_t whole = 0;
    EXPECT_EQ(scree_mesher_complete(mesher, &whole), SCREE_OK);
    return whole != 0;
  };
  follow_until(complete, "the ground's meshes");
  EXPECT_GT(nodes.size(), 8U);
  EXPECT_GT(lowest_m, -0.05F);
  ask(crater());
  follow_until([&] { return complete() && pieces > 0 && lowest_m < -0.2F; }, "the hole and its pieces");
  scree_mesher_destroy(mesher);
}

TEST_F(LibraryTest, one_chunk_and_one_piece_are_meshed_on_demand_and_lie_where_they_are) {
  join();
  auto mesh = sized<scree_mesh>();
  const int32_t in_air[3] = {0, 3, 0};
  EXPECT_EQ(scree_client_mesh_chunk(client, in_air, &mesh), SCREE_NOTHING);
  bool found = false;
  for (int32_t y = -1; y <= 0; ++y) {
    const int32_t chunk[3] = {0, y, 0};
    if (scree_client_mesh_chunk(client, chunk, &mesh) != SCREE_OK) continue;
    found = true;
    check_mesh(mesh);
    EXPECT_NEAR(mesh.origin_m[1] + mesh.positions[1], 0.0F, 0.05F);
    scree_mesh_release(client, &mesh);
  }
  EXPECT_TRUE(found);
  scree_request request = crater();
  ask(request);
  follow_until([&] { return status().pieces != 0; }, "a piece");
  std::vector<scree_body> bodies(status().pieces);
  size_t count = 0;
  ASSERT_EQ(scree_client_bodies(client, -1.0, bodies.data(), bodies.size(), &count), SCREE_OK);
  ASSERT_EQ(scree_client_mesh_body(client, bodies[0].id, &mesh), SCREE_OK) << scree_error();
  check_mesh(mesh);
  std::array<float, 3> sum{};
  for (size_t v = 0; v < mesh.vertex_count; ++v)
    for (size_t axis = 0; axis < 3; ++axis) sum.at(axis) += mesh.positions[3 * v + axis];
  for (const float all : sum) EXPECT_LT(std::abs(all / static_cast<float>(mesh.vertex_count)), 0.5F);
  scree_mesh_release(client, &mesh);
  EXPECT_EQ(scree_client_mesh_body(client, 4'000'000'000U, &mesh), SCREE_NOTHING);
}

/// Memory by a program's own functions, which may run out of it.
struct CountedMemory {
  std::atomic<int64_t> blocks{0}, bytes{0}, left{std::numeric_limits<int64_t>::max()};

  scree_allocator allocator() {
    return {this,
            [](void* user, size_t bytes, size_t) -> void* {
              auto& self = *static_cast<CountedMemory*>(user);
              if (self.left.fetch_sub(1) <= 0) return nullptr;
              ++self.blocks;
              self.bytes += static_cast<int64_t>(bytes);
              return std::malloc(bytes);
            },
            [](void* user, void* memory, size_t bytes) {
              auto& self = *static_cast<CountedMemory*>(user);
              --self.blocks;
              self.bytes -= static_cast<int64_t>(bytes);
              std::free(memory);
            }};
  }
};

TEST_F(LibraryTest, a_body_of_the_game_is_told_with_its_tag_and_has_a_mesh) {
  join();
  scree_request request;
  ASSERT_EQ(scree_request_init(&request, sizeof request, SCREE_ADD_BODY), SCREE_OK);
  request.shape.kind = SCREE_BOX;
  request.shape.b_m[0] = request.shape.b_m[1] = request.shape.b_m[2] = 0.5F;
  request.place_m[1] = 4.0F;
  request.mass_kg = 20.0F;
  request.tag = 77;
  ask(request);
  follow_until([&] { return seen[SCREE_EVENT_BODY_ADDED] != 0; }, "the body");
  scree_body body{};
  size_t count = 0;
  ASSERT_EQ(scree_client_bodies(client, -1.0, &body, 1, &count), SCREE_OK);
  EXPECT_EQ(body.kind, 1U);
  auto prop = sized<scree_prop>();
  ASSERT_EQ(scree_client_prop(client, body.id, &prop), SCREE_OK);
  EXPECT_EQ(prop.tag, 77U);
  EXPECT_EQ(prop.session, 0U);
  EXPECT_FLOAT_EQ(prop.mass_kg, 20.0F);
  auto mesh = sized<scree_mesh>();
  ASSERT_EQ(scree_client_mesh_body(client, body.id, &mesh), SCREE_OK) << scree_error();
  EXPECT_EQ(mesh.kind, 2U);
  EXPECT_EQ(mesh.index_count, 36U);
  check_mesh(mesh);
  for (size_t i = 0; i < 3 * mesh.vertex_count; ++i) EXPECT_FLOAT_EQ(std::abs(mesh.positions[i]), 0.5F);
  scree_mesh_release(client, &mesh);
  EXPECT_EQ(scree_client_prop(client, body.id + 1, &prop), SCREE_NOTHING);
}

TEST_F(LibraryTest, arrays_come_of_the_programs_memory_all_go_back_and_none_is_an_error) {
  CountedMemory memory;
  connect(0, memory.allocator());
  follow_until([&] { return status().loaded != 0; }, "the world around");
  auto mesh = sized<scree_mesh>();
  const int32_t chunk[3] = {0, -1, 0}, above[3] = {0, 0, 0};
  const bool below = scree_client_mesh_chunk(client, chunk, &mesh) == SCREE_OK;
  if (!below) {
    ASSERT_EQ(scree_client_mesh_chunk(client, above, &mesh), SCREE_OK);
  }
  EXPECT_EQ(memory.blocks, 1);
  scree_mesh_release(client, &mesh);
  EXPECT_EQ(memory.blocks, 0);
  EXPECT_EQ(memory.bytes, 0);
  memory.left = 0;
  EXPECT_EQ(scree_client_mesh_chunk(client, below ? chunk : above, &mesh), SCREE_NO_MEMORY);
  EXPECT_STRNE(scree_error(), "");
  memory.left = std::numeric_limits<int64_t>::max();
  scree_mesher_options options;
  ASSERT_EQ(scree_mesher_options_init(&options, sizeof options), SCREE_OK);
  options.radius_m = 16.0F;
  scree_mesher* mesher = nullptr;
  ASSERT_EQ(scree_mesher_create(client, &options, &mesher), SCREE_OK);
  const float eye[3] = {0.0F, 3.0F, 0.0F};
  int meshes = 0;
  follow_until(
      [&] {
        if (scree_mesher_update(mesher, eye) == SCREE_OK)
          while (scree_mesher_next(mesher, &mesh) == SCREE_OK) ++meshes;
        return meshes > 4;
      },
      "meshes");
  scree_client_destroy(client);  // and the mesher
  client = nullptr;
  EXPECT_EQ(memory.blocks, 0);
}

}  // namespace
}  // namespace scree
