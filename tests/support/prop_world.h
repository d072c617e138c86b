// A world with props, stepped by hand.
#pragma once

#include <gtest/gtest.h>

#include "server/world/world.h"
#include "shared/prop/prop.h"

namespace scree {

inline Prop prop_of(PropPart part, float mass_kg) {
  Prop prop;
  prop.parts.push_back(std::move(part));
  prop.mass_kg = mass_kg;
  return prop;
}
inline Prop crate(float half_m = 0.5F, float mass_kg = 200.0F) {
  return prop_of({.kind = PropPartKind::box, .half_m = glm::vec3(half_m)}, mass_kg);
}
inline Prop ball(float radius_m, float mass_kg) {
  return prop_of({.kind = PropPartKind::sphere, .half_m = glm::vec3(radius_m)}, mass_kg);
}

class PropWorld {
 public:
  explicit PropWorld(const WorldConfig& config, size_t threads = 1) : world_(config, threads) {}

  World& world() { return world_; }
  const TickDelta& last() const { return *last_; }

  const TickDelta& step(const std::vector<Command>& commands = {}) {
    last_ = world_.step(commands);
    EXPECT_EQ(last_->ledger.error(), 0);
    return *last_;
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  /// The reply to a request, carried out in a tick of its own.
  Reply ask(const Request& request) {
    step({{0, 1, request}});
    EXPECT_EQ(last_->replies.size(), 1U);
    return last_->replies.empty() ? Reply() : last_->replies.front();
  }
  PieceId add(const Prop& prop, glm::vec3 place_m, glm::vec3 velocity_m_s = glm::vec3(0.0F)) {
    const Reply reply = ask(AddPropRequest{prop, place_m, {1.0F, 0.0F, 0.0F, 0.0F}, velocity_m_s});
    EXPECT_EQ(reply.refusal, "");
    EXPECT_TRUE(reply.prop.has_value());
    return reply.prop.value_or(0);
  }
  bool has(PieceId id) const {
    return std::ranges::any_of(last_->props, [&](const PieceState& prop) { return prop.id == id; });
  }
  Pose pose(PieceId id) const {
    for (const PieceState& prop : last_->props)
      if (prop.id == id) return dequantise(prop.pose);
    ADD_FAILURE() << "no prop " << id;
    return {};
  }
  glm::vec3 place_m(PieceId id) const { return pose(id).position_m; }

 private:
  World world_;
  std::shared_ptr<const TickDelta> last_;
};

}  // namespace scree
