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

}  // namespace
}  // namespace scree
