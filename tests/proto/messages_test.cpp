// Messages as values: the samples have all kinds, and each kind's memory is counted.
#include "proto/messages.h"

#include <gtest/gtest.h>

#include "tests/support/wire_samples.h"

namespace scree {
namespace {

template <typename Variant>
void expect_one_of_each(const std::vector<Variant>& samples) {
  std::vector<bool> seen(std::variant_size_v<Variant>);
  for (const Variant& sample : samples) seen[sample.index()] = true;
  for (size_t kind = 0; kind < seen.size(); ++kind) EXPECT_TRUE(seen[kind]) << "no sample of kind " << kind;
}

TEST(Messages, every_kind_of_message_and_operation_has_a_sample) {
  expect_one_of_each(samples::server_messages());
  expect_one_of_each(samples::client_messages());
  expect_one_of_each(samples::frame().operations);
}

TEST(Messages, the_memory_of_a_message_counts_what_it_holds) {
  const size_t none = memory_bytes(FrameMessage{});
  FrameMessage frame;
  frame.patches.resize(100);
  EXPECT_GE(memory_bytes(frame), none + 100 * sizeof(BrickPatch));
  frame.operations.resize(10, FillOperation{});
  EXPECT_GE(memory_bytes(frame), none + 100 * sizeof(BrickPatch) + 10 * sizeof(Operation));
  PhysicsMessage physics;
  physics.bodies.push_back({1, true, false, std::vector<glm::vec3>(64)});
  EXPECT_GE(memory_bytes(physics), none + sizeof(BodyView) + 64 * sizeof(glm::vec3));
  ChunkMessage chunk;
  chunk.bricks.resize(64);
  EXPECT_GE(memory_bytes(chunk), none + 64 * sizeof(BrickPatch));
}

TEST(Messages, the_memory_of_materials_is_counted) {
  constexpr size_t voxels = 40 * 40 * 40;
  PieceMessage piece;
  piece.volume.window = Window(VoxelBox{{0, 0, 0}, {40, 40, 40}});
  const size_t of_one = memory_bytes(piece);
  EXPECT_GE(of_one, sizeof(ServerMessage) + voxels * sizeof(Code));
  piece.volume.materials.each.assign(voxels, material::ice);
  EXPECT_GE(memory_bytes(piece), of_one + voxels * sizeof(Material));
  piece.volume.masses.resize(200);
  EXPECT_GE(memory_bytes(piece), of_one + voxels * sizeof(Material) + 200 * sizeof(MaterialMass));

  VoxelMaterials mixed{};
  for (size_t i = 0; i < mixed.size(); ++i) mixed[i] = static_cast<VoxelMaterial>(i % 256);
  const BrickMaterials materials(mixed);
  ASSERT_GT(materials.bytes(), 512U);
  FrameMessage frame;
  ChunkMessage chunk;
  chunk.bricks.resize(64);
  frame.patches.resize(64);
  const size_t of_frame = memory_bytes(frame), of_chunk = memory_bytes(chunk);
  for (size_t i = 0; i < 64; ++i) chunk.bricks[i].materials = frame.patches[i].materials = materials;
  EXPECT_GE(memory_bytes(frame), of_frame + 64 * materials.bytes());
  EXPECT_GE(memory_bytes(chunk), of_chunk + 64 * materials.bytes());
}

}  // namespace
}  // namespace scree
