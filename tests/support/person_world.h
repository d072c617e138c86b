// A world whose persons walk, stepped by hand.
#pragma once

#include <gtest/gtest.h>

#include "server/world/world.h"
#include "tests/support/flat_world.h"
#include "tests/support/prop_world.h"

namespace scree {

inline WorldConfig walking_world() {
  WorldConfig config = rock_world();
  config.service.persons = Persons::walk;
  return config;
}

class PersonWorld : public PropWorld {
 public:
  explicit PersonWorld(const WorldConfig& config = walking_world(), size_t threads = 1)
      : PropWorld(config, threads) {}

  const Reply& ask_as(uint64_t session, const Request& request, uint32_t number = 1) {
    static const Reply none;
    step({{session, number, request}});
    for (const Reply& reply : last().replies)
      if (reply.session == session) return reply;
    return none;
  }
  /// Returns the id of the body.
  PieceId stand(uint64_t session, glm::vec3 feet_m) {
    const Reply reply = ask_as(session, StandRequest{feet_m});
    EXPECT_EQ(reply.refusal, "");
    return reply.prop.value_or(0);
  }
  /// An input a tick.
  void walk(uint64_t session, const WalkInput& input, int ticks) {
    for (int i = 0; i < ticks; ++i) step({{session, ++number_, WalkRequest{input}}});
  }
  uint32_t number() const { return number_; }
  const PersonPlace& person(uint64_t session) const {
    static const PersonPlace nobody;
    for (const PersonPlace& one : last().persons)
      if (one.session == session) return one;
    ADD_FAILURE() << "session " << session << " is not on foot";
    return nobody;
  }
  bool is_on_foot(uint64_t session) const {
    return std::ranges::any_of(last().persons,
                               [&](const PersonPlace& one) { return one.session == session; });
  }
  glm::vec3 feet_m(uint64_t session) const { return person(session).walker.feet_m; }
  /// Events of that kind since the last call of clear().
  const TickDelta& step(const std::vector<Command>& commands = {}) {
    PropWorld::step(commands);
    told_.insert(told_.end(), last().told.begin(), last().told.end());
    return last();
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  std::vector<Event> told(EventKind kind) const {
    std::vector<Event> found;
    for (const Event& event : told_)
      if (event.kind == kind) found.push_back(event);
    return found;
  }

 private:
  std::vector<Event> told_;
  uint32_t number_ = 0;
};

}  // namespace scree
