// Recordings whose operations and ledgers no world has made: each is refused by name, and nothing aborts.
#include <gtest/gtest.h>

#include "server/replay/replay_source.h"
#include "server/store/recording_writer.h"
#include "shared/recombine/stamp_plan.h"
#include "tests/support/holds.h"
#include "tests/support/recording_fixture.h"

namespace scree {
namespace {

class HostileMassesTest : public RecordingTest {
 protected:
  void SetUp() override {
    RecordingTest::SetUp();
    simulate(5);
    record();
  }
  std::string refusal_of_first_tick() const {
    auto source = ReplaySource::open(path);
    if (!source) return source.error().message;
    const auto delta = (*source)->next();
    return delta ? std::string() : delta.error().message;
  }
};

/// The piece lies in the air, and the stamp makes more of it than the piece and all dust have.
TEST_F(HostileMassesTest, a_stamp_that_gains_more_than_there_is_is_damage) {
  RecordedFrame frame = recorded_frame(1);
  CarveOperation carve{.shape = sphere({0.0F, 0.0F, 0.0F}, 1.0F), .impact_m = {0.0F, 1.0F, 0.0F}};
  carve.first_piece = 1;
  frame.operations = {carve};
  frame.operations.emplace_back(StampOperation{.piece = 1,
                                               .pose = quantise({{0.0F, 20.0F, 0.0F}}),
                                               .shift = stamp_shift_max,
                                               .method = StampMethod::sphere});
  put_recorded("frames", 1, encode(frame));
  const std::string refusal = refusal_of_first_tick();
  EXPECT_TRUE(holds(refusal, path)) << refusal;
  EXPECT_TRUE(holds(refusal, "at tick 1: an operation gains more than its pieces and all dust have"))
      << refusal;
}

}  // namespace
}  // namespace scree
