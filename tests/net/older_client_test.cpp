// Clients that carry out fewer kinds of operation than the server: they get no operation that they do not
// know, and have the server's bricks and pieces all the same.
#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "tests/support/publisher_fixture.h"

namespace scree {
namespace {

class OlderClientTest : public PublisherTest {
 protected:
  void join_knowing(size_t operations) {
    publisher.join(session, {0.0F, 2.0F, 0.0F}, 64.0F, operations);
    followers.try_emplace(session);
  }
  /// Some operations of every kind that a tick source makes.
  std::vector<Operation> any_operations(Random& random) {
    const auto place = [&](float y_m) {
      return glm::vec3(random.below(40), y_m, random.below(40)) - glm::vec3(20.0F, 0.0F, 20.0F);
    };
    std::vector<Operation> operations{source.carve(place(0.0F), 1.5F, 2 + random.below(6))};
    if (random.below(3) == 0) operations.push_back(FillOperation{sphere(place(1.0F), 1.0F)});
    if (random.below(3) == 0) operations.push_back(PaintOperation{sphere(place(0.0F), 2.0F), material::ice});
    for (const auto& [id, volume] : source.pieces()) {
      if (random.below(8) == 0)
        operations.push_back(source.stamp(id));
      else if (random.below(3) == 0)
        source.move(id, {0.0F, 0.25F, 0.0F});
    }
    return operations;
  }
};

TEST_F(OlderClientTest, whatever_it_knows_its_field_and_pieces_are_the_servers) {
  for (size_t known = 0; known <= operation_kinds; ++known) {
    SCOPED_TRACE(known);
    followers.erase(session);
    join_knowing(known);
    Random random(7);
    for (int i = 0; i < 30; ++i) tick(any_operations(random));
    for (int i = 0; i < 60; ++i) tick();
    const TrustingClient& follower = followers.at(session);
    expect_held_equal(session);
    EXPECT_EQ(follower.mismatches, 0U);
    EXPECT_EQ(follower.pieces.size(), publisher.view(session)->known_pieces());
    EXPECT_LE(follower.operation_kinds_seen, known) << "it was told an operation that it does not know";
    EXPECT_EQ(follower.operations == 0, known == 0);
  }
}

}  // namespace
}  // namespace scree
