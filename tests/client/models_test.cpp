// Models of props: a server with a folder of them gives them to who sees their props, and takes no prop whose
// model it does not have.
#include <fstream>
#include <gtest/gtest.h>

#include "client/cache/join_server.h"
#include "client/cache/received_content.h"
#include "client/session/join_and_wait.h"
#include "content/files/model_folder.h"
#include "content/model/glb.h"
#include "crypto/sha256.h"
#include "server/app/live_server.h"
#include "shared/base/timing.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/holds.h"
#include "tests/support/prop_world.h"
#include "tests/support/test_folder.h"
#include "tests/support/written_glb.h"

namespace scree {
namespace {

class PropModelsTest : public ::testing::Test {
 protected:
  void start(bool with_models, const std::string& world = "") {
    LiveConfig config;
    config.world.terrain = flat_terrain;
    config.world_path = world;
    config.pacing = Pacing::by_hand;
    std::ofstream(folder_ / "box.glb", std::ios::binary)
        .write(reinterpret_cast<const char*>(box_.data()), static_cast<std::streamsize>(box_.size()));
    if (with_models) {
      const auto models = read_model_folder(folder_ / "");
      ASSERT_TRUE(models) << models.error().message;
      config.models = models->contents;
    }
    server_.reset();
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    server_ = std::move(*started);
  }
  std::unique_ptr<Client> join(bool models = true) {
    ServerEndpoint endpoint;
    endpoint.port = server_->port();
    CacheConfig cache{folder_ / "cache", size_t{1} << 24U};
    cache.models = models;
    auto client =
        std::make_unique<Client>(std::make_unique<ServerConnector>(endpoint, std::chrono::milliseconds(5000)),
                                 ClientOptions{.cache = cache});
    EXPECT_TRUE(join_and_wait(*client, {protocol_version, "test", {0.0F, 2.0F, 0.0F}, 16.0F}));
    return client;
  }
  /// Until `done`.
  template <typename Done>
  bool run(Client& client, const Done& done) {
    for (const double until_s = steady_now_s() + 30.0; steady_now_s() < until_s;) {
      server_->step_once();
      client.wait(std::chrono::milliseconds(2));
      client.poll(steady_now_s());
      while (client.next()) {
      }
      if (done()) return true;
    }
    return false;
  }
  /// By the host: the reply.
  Reply add(const std::optional<Digest>& model, uint32_t request) {
    AddPropRequest add;
    add.prop = crate();
    add.prop.model = model;
    add.place_m = {0.0F, 3.0F, 0.0F};
    EXPECT_TRUE(server_->push({0, request, add}));
    server_->step_once();
    for (const Reply& reply : server_->last_delta()->replies)
      if (reply.request == request) return reply;
    ADD_FAILURE() << "no reply";
    return {};
  }

  const TestFolder folder_;
  const std::vector<uint8_t> box_ = box_glb({0.1F, 0.2F, 0.3F}, {0.5F, 0.5F, 0.5F});
  const Digest digest_ = sha256(box_);
  std::unique_ptr<LiveServer> server_;
};

TEST_F(PropModelsTest, who_sees_a_prop_gets_its_model_once) {
  start(true);
  EXPECT_EQ(add(digest_, 1).refusal, "");
  {
    const auto client = join();
    ASSERT_TRUE(run(*client, [&] { return client->model(digest_) != nullptr; }));
    EXPECT_EQ(*client->model(digest_), box_);
    const auto mesh = read_glb(*client->model(digest_));
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->triangles(), 12U);
  }
  const auto again = join();
  ASSERT_TRUE(run(*again, [&] { return again->model(digest_) != nullptr; }));
  EXPECT_EQ(again->rejoin().content().bytes_received(), 0U) << "it was kept";
  const auto other = join(false);
  ASSERT_TRUE(run(*other, [&] { return other->mirror()->props().size() == 1; }));
  EXPECT_EQ(other->model(digest_), nullptr);
}

TEST_F(PropModelsTest, a_model_that_is_not_there_is_refused_with_what_to_do) {
  start(true);
  const Digest strange{1, 2, 3};
  const Reply reply = add(strange, 1);
  EXPECT_EQ(reply.reason, Refusal::model_missing);
  EXPECT_TRUE(holds(reply.refusal, hex_of(strange)) && holds(reply.refusal, "--models")) << reply.refusal;
  EXPECT_EQ(add(std::nullopt, 2).refusal, "");
  start(false);
  EXPECT_EQ(add(digest_, 3).reason, Refusal::model_missing);
}

TEST_F(PropModelsTest, a_world_whose_models_are_gone_opens_and_a_client_has_the_parts) {
  start(true, folder_ / "kept.world");
  EXPECT_EQ(add(digest_, 1).refusal, "");
  ASSERT_TRUE(server_->stop());
  start(false, folder_ / "kept.world");
  const auto client = join();
  ASSERT_TRUE(run(*client, [&] {
    return client->mirror()->props().size() == 1 && holds(client->rejoin().content().fault(), "is not there");
  })) << client->rejoin().content().fault();
  EXPECT_EQ(client->model(digest_), nullptr);
  EXPECT_EQ(client->mirror()->props().begin()->second.prop->model, digest_);
}

TEST_F(PropModelsTest, what_a_hostile_server_sends_for_a_model_costs_nothing_else) {
  ReceivedContent content(TileFolder(""), false);
  content.begin_session(std::nullopt);
  const std::vector<uint8_t> nonsense(50, 7);
  content.want_model(digest_);
  content.want_model(digest_);
  EXPECT_EQ(content.next_request().wanted, std::vector{digest_});
  EXPECT_FALSE(content.accept({digest_, 50, 0, nonsense}));
  EXPECT_TRUE(holds(content.fault(), "the model of a prop does not have the hash")) << content.fault();
  content.want_model(digest_);
  EXPECT_TRUE(content.next_request().wanted.empty()) << "it was given up";
  for (uint32_t i = 0; i < 5000; ++i)
    content.want_model({static_cast<uint8_t>(i), static_cast<uint8_t>(i >> 8U), 9});
  size_t asked = 0;
  for (AskContentMessage next = content.next_request(); !next.wanted.empty(); next = content.next_request()) {
    asked += next.wanted.size();
    for (const Digest& one : next.wanted) EXPECT_FALSE(content.accept({one}));
  }
  EXPECT_EQ(asked, 511U);
  EXPECT_TRUE(content.is_settled());
}

}  // namespace
}  // namespace scree
