// A client of a world in this process, which a publisher serves from memory.
#pragma once

#include <gtest/gtest.h>
#include <span>
#include <vector>

#include "client/mirror/mirror.h"
#include "proto/codec.h"
#include "server/publish/publisher.h"
#include "server/world/world.h"

namespace scree {

inline WelcomeMessage welcome_of(const World& world) {
  WelcomeMessage welcome;
  welcome.terrain = world.config().terrain;
  welcome.interest_radius_m = 64.0F;
  return welcome;
}

/// A client that a publisher serves from memory.
class Follower {
 public:
  Follower(World& world, glm::vec3 eye_m, bool has_kernels = true)
      : publisher_({.terrain = world.config().terrain}, workers_), mirror_(welcome_of(world)) {
    publisher_.begin(world.keyframe());
    publisher_.join(session, eye_m, 32.0F, has_kernels ? operation_kinds : 0);
  }

  void follow(const TickDelta& delta) {
    const auto backlog = [](uint64_t) { return Backlog(); };
    receive(publisher_.publish(delta, backlog));
    receive(publisher_.answer(delta, [](const Reply&) { return ServerLatency(); }));
    receive(publisher_.stream(backlog));
  }
  Mirror& mirror() { return mirror_; }
  Publisher& publisher() { return publisher_; }
  static constexpr uint64_t session = 1;

 private:
  void receive(const std::vector<Outgoing>& outgoing) {
    for (const Outgoing& one : outgoing) {
      const auto message = decode_server(std::span(*one.bytes).subspan(length_prefix_bytes));
      ASSERT_TRUE(message) << message.error().message;
      const auto applied = mirror_.apply(*message);
      ASSERT_TRUE(applied) << applied.error().message;
    }
  }

  Workers workers_{1};
  Publisher publisher_;
  Mirror mirror_;
};

}  // namespace scree
