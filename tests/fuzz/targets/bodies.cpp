// A small world in which bodies are added, joined, moved, thrown, cut out and broken, in any order, and
// questions are asked about it.
//
// Holds: the ledger balances after every tick and agrees with the field as measured. Every body is at a
// finite place, at a finite speed. A request is refused with a reason or has an answer. A valid question has
// an answer, the same one twice. At the end a world that is restored from the snapshot has the same bytes and
// goes on with the same hashes as this one, renewed.
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "server/formats/world_codec.h"
#include "server/world/world.h"
#include "shared/base/check.h"
#include "tests/fuzz/support/any_body_request.h"
#include "tests/fuzz/support/any_question.h"
#include "tests/fuzz/support/target.h"

namespace scree {
namespace {

constexpr Tick ticks_most = 96;
constexpr uint64_t estimate_most_us = 20'000;
constexpr int ticks_after = 3;

WorldConfig small_config(FuzzInput& input) {
  WorldConfig config;
  config.terrain = {input.flag() ? TerrainKind::flat : TerrainKind::canyon, input.byte(),
                    input.flag() ? 1.0F : 0.5F};
  config.tick_rate_hz = input.below(4) == 3 ? 20 : 60;
  config.props_max = input.below(4) == 3 ? 3 : 200;
  config.pieces_max = input.below(4) == 3 ? 8 : 200;
  config.methods.support = input.flag();
  return config;
}

bool is_finite(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

class Watched {
 public:
  explicit Watched(const WorldConfig& config) : world_(config) {}

  const KnownBodies& known() const { return known_; }
  bool may_go_on() const { return world_.tick() < ticks_most && estimate_us_ < estimate_most_us; }

  void step(const std::vector<Command>& commands) {
    const auto delta = world_.step(commands);
    CHECK_EQ(delta->ledger.error(), 0);
    for (const Reply& reply : delta->replies) {
      CHECK(reply.refusal.empty() == !reply.reason.has_value());
      if (reply.joint) known_.joints.push_back(*reply.joint);
    }
    for (const EndedJoint& ended : delta->joints_removed) std::erase(known_.joints, ended.id);
    known_.bodies.clear();
    for (const auto* list : {&delta->pieces, &delta->props})
      for (const PieceState& body : *list) known_.bodies[body.id] = dequantise(body.pose);
    check_motions();
    estimate_us_ += delta->work.estimate_us;
    terrain_ = delta->ledger.terrain;
  }

  void ask(const Question& question) {
    const bool is_valid = validate(question).has_value();
    const HeldScene scene = world_.scene();
    const auto answer = scree::ask(scene.scene(), question);
    CHECK(answer.has_value() == is_valid);
    if (!is_valid) return;
    CHECK(scree::ask(scene.scene(), question)->answer == answer->answer);
    const auto* const hit = std::get_if<std::optional<Hit>>(&answer->answer);
    if (hit != nullptr && *hit) CHECK(is_finite((*hit)->place_m) && is_finite((*hit)->normal));
  }

  void check_end() {
    CHECK_EQ(world_.measure_terrain(), terrain_);
    const WorldSnapshot snapshot = world_.snapshot();
    const std::vector<uint8_t> bytes = encode(snapshot);
    const auto value = decode_world(bytes);
    CHECK(value.has_value());
    const auto restored = World::restore(*value);
    CHECK(restored.has_value());
    CHECK((*restored)->moment().tick == snapshot.moment.tick);
    CHECK(encode((*restored)->snapshot()) == bytes);
    world_.renew();
    for (int i = 0; i < ticks_after; ++i)
      CHECK((*restored)->step({})->state_hash == world_.step({})->state_hash);
  }

 private:
  void check_motions() const {
    for (const BodyMotion& body : world_.moment().motion.bodies) {
      CHECK(is_finite(body.origin_m) && is_finite(body.velocity_m_s) && is_finite(body.spin_rad_s));
      for (const glm::vec3& row : body.basis) CHECK(std::abs(glm::dot(row, row) - 1.0F) < 1e-2F);
    }
  }

  World world_;
  KnownBodies known_;
  uint64_t estimate_us_ = 0;
  MassUnits terrain_ = 0;
};

}  // namespace
}  // namespace scree

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace scree;
  FuzzInput input(data, size);
  Watched world(small_config(input));
  std::vector<Command> commands;
  uint32_t request = 0;
  while (!input.at_end() && world.may_go_on()) {
    if (input.below(8) == 7) {
      Question question{any_asked(input)};
      if (input.below(8) == 7) question.mask.except = {input.byte()};
      world.ask(question);
      continue;
    }
    commands.push_back({1 + input.below(2), ++request, any_body_request(input, world.known())});
    const uint32_t ticks = input.below(6);  // 0: with the next one
    for (uint32_t i = 0; i < ticks && world.may_go_on(); ++i) world.step(std::exchange(commands, {}));
  }
  world.step(commands);
  world.check_end();
  return 0;
}
