// A program in C with one client, and a live server for it.
#pragma once

#include <array>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "client/library/include/scree/client.h"
#include "server/app/live_server.h"
#include "tests/support/flat_world.h"
#include "tests/support/patience.h"

namespace scree {

template <typename Struct>
Struct sized() {
  Struct value{};
  value.size = sizeof value;
  return value;
}

/// A program with one client, and what its events said.
class LibraryTest : public ::testing::Test {
 protected:
  void SetUp() override { start(0); }
  void TearDown() override { scree_client_destroy(client); }

  void start(uint16_t port) {
    LiveConfig config;
    config.world = rock_world();
    config.net.port = port;
    config.net.access.anonymous = Role::director;
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started.has_value()) << started.error().message;
    server = std::move(*started);
  }
  void connect(uint32_t flags = 0, const scree_allocator& allocator = {}) {
    scree_options options;
    ASSERT_EQ(scree_options_init(&options, sizeof options), SCREE_OK);
    options.port = server->port();
    options.flags = flags;
    options.eye_m[1] = 3.0F;
    options.radius_m = 64.0F;
    options.allocator = allocator;
    ASSERT_EQ(scree_client_create(&options, &client), SCREE_OK) << scree_error();
  }
  /// Takes events until `done`, which is asked after each.
  template <typename Done>
  void follow_until(Done&& done, const char* what) {
    const Within in(std::chrono::duration<double>(patience).count());
    while (!done()) {
      ASSERT_FALSE(in.over()) << what;
      auto event = sized<scree_event>();
      ASSERT_EQ(scree_client_poll(client, 10), SCREE_OK);
      while (scree_client_next(client, &event) == SCREE_OK) {
        ++seen[event.kind];
        if (event.kind == SCREE_EVENT_REPLY) refusals.emplace_back(event.name);
        if (event.kind == SCREE_EVENT_LOST) ends.push_back(event.flags);
      }
    }
  }
  scree_status status() const {
    auto status = sized<scree_status>();
    EXPECT_EQ(scree_client_status(client, &status), SCREE_OK);
    return status;
  }
  void join(uint32_t flags = 0) {
    connect(flags);
    follow_until([&] { return status().loaded != 0; }, "the world around");
  }
  static scree_request crater(float x_m = 0.0F) {
    scree_request request;
    EXPECT_EQ(scree_request_init(&request, sizeof request, SCREE_CARVE), SCREE_OK);
    request.shape.a_m[0] = request.place_m[0] = x_m;
    request.shape.radius_m = 1.5F;
    request.random_seed = 5;
    return request;
  }
  uint32_t ask(const scree_request& request) {
    uint32_t number = 0;
    EXPECT_EQ(scree_client_request(client, &request, nullptr, nullptr, &number), SCREE_OK) << scree_error();
    return number;
  }
  float ground_below(float x_m) const {
    auto hit = sized<scree_hit>();
    const float from[3] = {x_m, 20.0F, 0.0F}, down[3] = {0.0F, -1.0F, 0.0F};
    EXPECT_EQ(scree_client_cast(client, from, down, 100.0F, 0.0F, SCREE_MASK_TERRAIN, &hit), SCREE_OK);
    return hit.place_m[1];
  }

  std::unique_ptr<LiveServer> server;
  scree_client* client = nullptr;
  std::array<int, 32> seen{};  ///< events, by kind
  std::vector<std::string> refusals;
  std::vector<uint32_t> ends;  ///< flags of SCREE_EVENT_LOST
};

}  // namespace scree
