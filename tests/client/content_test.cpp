// A client's palette and images: fetched once, kept for ever, and checked. A server that sends others costs
// nothing else.
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "client/bot/bot.h"
#include "client/cache/join_server.h"
#include "client/cache/limits.h"
#include "client/cache/received_content.h"
#include "client/session/join_and_wait.h"
#include "content/builtin_palette.h"
#include "crypto/sha256.h"
#include "proto/palette_codec.h"
#include "server/app/live_server.h"
#include "shared/base/timing.h"
#include "tests/support/holds.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

std::vector<uint8_t> small_image() {
  const std::string header("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1", 24);
  std::vector<uint8_t> bytes(header.begin(), header.end());
  bytes.resize(100'000, 7);
  return bytes;
}

Palette painted_palette(const std::vector<uint8_t>& image) {
  Palette palette = builtin_palette();
  palette.rows[2].look.albedo = sha256(image);
  return palette;
}

// ---- without a server

class ReceivedContentTest : public ::testing::Test {
 protected:
  ReceivedContent make(bool images = false) const {
    return ReceivedContent(TileFolder(folder_ / "cache", content_extension, limits::content_bytes_max),
                           images);
  }
  static ContentMessage whole(const Digest& digest, const std::vector<uint8_t>& bytes) {
    return {digest, static_cast<uint32_t>(bytes.size()), 0, bytes};
  }

  const TestFolder folder_;
  const std::vector<uint8_t> bytes_ = encode_palette(builtin_palette());
  const Digest digest_ = sha256(bytes_);
};

TEST_F(ReceivedContentTest, a_palette_comes_in_parts_and_is_asked_for_once) {
  ReceivedContent content = make();
  content.begin_session(digest_);
  EXPECT_EQ(content.next_request().wanted, std::vector{digest_});
  EXPECT_TRUE(content.next_request().wanted.empty());
  const auto total = static_cast<uint32_t>(bytes_.size());
  EXPECT_FALSE(content.accept({digest_, total, 0, {bytes_.begin(), bytes_.begin() + 100}}));
  EXPECT_EQ(content.palette(), plain_palette());
  EXPECT_EQ(content.accept({digest_, total, 100, {bytes_.begin() + 100, bytes_.end()}}), digest_);
  EXPECT_TRUE(content.is_current());
  EXPECT_EQ(*content.palette(), builtin_palette());
  content.begin_session(digest_);
  EXPECT_TRUE(content.is_current());
  EXPECT_TRUE(content.next_request().wanted.empty());
}

TEST_F(ReceivedContentTest, a_damaged_file_is_fetched_again) {
  {
    ReceivedContent content = make();
    content.begin_session(digest_);
    static_cast<void>(content.next_request());
    content.accept(whole(digest_, bytes_));
  }
  const std::string file = folder_ / "cache/" + hex_of(digest_) + content_extension;
  ASSERT_TRUE(std::filesystem::exists(file));
  ReceivedContent kept = make();
  kept.begin_session(digest_);
  EXPECT_TRUE(kept.is_current());
  std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(40).put('\x55').put('\x55');
  ReceivedContent damaged = make();
  damaged.begin_session(digest_);
  EXPECT_FALSE(damaged.is_current());
  EXPECT_EQ(damaged.next_request().wanted, std::vector{digest_});
}

TEST_F(ReceivedContentTest, what_a_hostile_server_sends_is_said_and_costs_nothing) {
  const auto fault_of = [&](const Digest& digest, const ContentMessage& message) {
    ReceivedContent content = make();
    content.begin_session(digest);
    static_cast<void>(content.next_request());
    EXPECT_FALSE(content.accept(message));
    EXPECT_EQ(content.palette(), plain_palette());
    EXPECT_FALSE(content.is_current());
    EXPECT_TRUE(content.is_settled());
    return content.fault();
  };
  const std::vector<uint8_t> nonsense(50, 0xFF);
  EXPECT_TRUE(holds(fault_of(digest_, whole(digest_, nonsense)), "does not have the hash that names it"));
  EXPECT_TRUE(holds(fault_of(sha256(nonsense), whole(sha256(nonsense), nonsense)), "palette cannot be used"));
  EXPECT_TRUE(holds(fault_of(digest_, {digest_, palette_bytes_max + 1, 0, {1}}), "too many bytes"));
  EXPECT_TRUE(holds(fault_of(digest_, {digest_}), "is not there"));
  ReceivedContent content = make();
  content.begin_session(digest_);
  EXPECT_FALSE(content.accept(whole(digest_, bytes_)));
  EXPECT_TRUE(holds(content.fault(), "not asked for"));
}

TEST_F(ReceivedContentTest, images_are_fetched_for_who_wants_them) {
  const std::vector<uint8_t> image = small_image(), bytes = encode_palette(painted_palette(image));
  for (const bool images : {false, true}) {
    ReceivedContent content(TileFolder(""), images);
    content.begin_session(sha256(bytes));
    static_cast<void>(content.next_request());
    content.accept(whole(sha256(bytes), bytes));
    EXPECT_EQ(content.next_request().wanted.size(), images ? 1U : 0U);
    EXPECT_EQ(content.find(sha256(image)), nullptr);
    if (!images) continue;
    EXPECT_EQ(content.accept(whole(sha256(image), image)), sha256(image));
    EXPECT_EQ(*content.find(sha256(image)), image);
    EXPECT_TRUE(content.is_settled());
  }
}

TEST_F(ReceivedContentTest, the_palette_before_stays_until_the_next_has_come) {
  ReceivedContent content = make();
  content.begin_session(digest_);
  static_cast<void>(content.next_request());
  content.accept(whole(digest_, bytes_));
  Palette next = builtin_palette();
  next.rows[0].strength_m_s = 33.0F;
  const std::vector<uint8_t> bytes = encode_palette(next);
  content.change_palette(sha256(bytes));
  EXPECT_FALSE(content.is_current());
  EXPECT_EQ(*content.palette(), builtin_palette());
  content.change_palette(digest_);  // and back, while the other is on its way
  static_cast<void>(content.next_request());
  EXPECT_TRUE(content.is_current());
  content.change_palette(sha256(bytes));
  EXPECT_EQ(content.next_request().wanted, std::vector{sha256(bytes)});
  content.accept(whole(sha256(bytes), bytes));
  EXPECT_EQ(*content.palette(), next);
  EXPECT_EQ(content.fault(), "");
}

/// Else a later palette could name it as an image, and it would be drawn unseen.
TEST_F(ReceivedContentTest, what_came_as_a_palette_is_never_taken_for_an_image) {
  const std::vector<uint8_t> nonsense(50, 0xFF);
  ReceivedContent content = make(true);
  content.begin_session(sha256(nonsense));
  static_cast<void>(content.next_request());
  EXPECT_FALSE(content.accept(whole(sha256(nonsense), nonsense)));
  EXPECT_EQ(content.find(sha256(nonsense)), nullptr);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "cache/" + hex_of(sha256(nonsense)) + content_extension));
  const std::vector<uint8_t> next = encode_palette(painted_palette(nonsense));
  content.change_palette(sha256(next));
  static_cast<void>(content.next_request());
  EXPECT_EQ(content.accept(whole(sha256(next), next)), sha256(next));
  EXPECT_EQ(content.find(sha256(nonsense)), nullptr);

  // A palette that is one is no image, either.
  ReceivedContent other = make(true);
  other.begin_session(digest_);
  static_cast<void>(other.next_request());
  other.accept(whole(digest_, bytes_));
  const std::vector<uint8_t> named = encode_palette(painted_palette(bytes_));
  other.change_palette(sha256(named));
  static_cast<void>(other.next_request());
  other.accept(whole(sha256(named), named));
  EXPECT_TRUE(other.is_current());
  EXPECT_EQ(other.find(digest_), nullptr);
}

TEST_F(ReceivedContentTest, a_kept_file_that_is_no_image_is_not_taken_for_one) {
  const std::vector<uint8_t> nonsense(50, 0xFF), bytes = encode_palette(painted_palette(nonsense));
  TileFolder(folder_ / "cache", content_extension, limits::content_bytes_max)
      .write(sha256(nonsense), nonsense);
  ReceivedContent content = make(true);
  content.begin_session(sha256(bytes));
  static_cast<void>(content.next_request());
  EXPECT_EQ(content.accept(whole(sha256(bytes), bytes)), sha256(bytes));
  EXPECT_EQ(content.find(sha256(nonsense)), nullptr);
  EXPECT_TRUE(holds(content.fault(), "an image of the server's palette cannot be used")) << content.fault();
}

/// Each is as large as a palette may be: together more than a client holds.
TEST_F(ReceivedContentTest, palettes_that_cannot_be_used_take_no_memory) {
  const std::vector<uint8_t> image = small_image(), bytes = encode_palette(painted_palette(image));
  ReceivedContent content(TileFolder(""), true);
  std::vector<uint8_t> nonsense(palette_bytes_max, 0xFF);
  for (size_t i = 0; i * nonsense.size() <= limits::content_memory_max; ++i) {
    std::memcpy(nonsense.data() + sizeof i, &i, sizeof i);
    i == 0 ? content.begin_session(sha256(nonsense)) : content.change_palette(sha256(nonsense));
    ASSERT_EQ(content.next_request().wanted.size(), 1U);
    EXPECT_FALSE(content.accept(whole(sha256(nonsense), nonsense)));
  }
  content.change_palette(sha256(bytes));
  static_cast<void>(content.next_request());
  EXPECT_EQ(content.accept(whole(sha256(bytes), bytes)), sha256(bytes)) << content.fault();
}

// ---- with a server

class ContentJoinTest : public ::testing::Test {
 protected:
  void SetUp() override {
    LiveConfig config;
    config.world.palette = std::make_shared<const Palette>(painted_palette(image_));
    config.images = std::make_shared<const ContentFiles>(ContentFiles{{sha256(image_), image_}});
    config.pacing = Pacing::by_hand;
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    server_ = std::move(*started);
  }
  std::unique_ptr<Client> join(bool images) {
    ServerEndpoint endpoint;
    endpoint.port = server_->port();
    auto client =
        std::make_unique<Client>(std::make_unique<ServerConnector>(endpoint, std::chrono::milliseconds(5000)),
                                 ClientOptions{.cache = {folder_ / "cache", size_t{1} << 24U, images}});
    EXPECT_TRUE(join_and_wait(*client, {protocol_version, "test", {0.0F, 2.0F, 0.0F}, 8.0F}));
    return client;
  }
  /// Ticks until nothing more is to come. Counts the events that say so.
  void settle(Client& client) {
    const double until_s = steady_now_s() + 30.0;
    for (bool more = true; more && steady_now_s() < until_s;) {
      server_->step_once();
      client.wait(std::chrono::milliseconds(5));
      client.poll(steady_now_s());
      while (const auto event = client.next())
        if (const auto* applied = std::get_if<Client::Applied>(&*event)) {
          palettes_ += applied->changes.palette ? 1 : 0;
          images_ += applied->changes.image ? 1 : 0;
        }
      more = !client.rejoin().content().is_settled();
    }
  }

  const TestFolder folder_;
  const std::vector<uint8_t> image_ = small_image();
  std::unique_ptr<LiveServer> server_;
  int palettes_ = 0, images_ = 0;
};

TEST_F(ContentJoinTest, a_second_join_takes_no_bytes_of_it) {
  {
    const auto client = join(true);
    settle(*client);
    EXPECT_EQ(*client->mirror()->palette(), painted_palette(image_));
    ASSERT_NE(client->content(sha256(image_)), nullptr);
    EXPECT_EQ(*client->content(sha256(image_)), image_);
    EXPECT_GT(client->rejoin().content().bytes_received(), image_.size());
    EXPECT_EQ(palettes_, 1);
    EXPECT_EQ(images_, 1);
  }
  const auto client = join(true);
  EXPECT_EQ(*client->mirror()->palette(), painted_palette(image_)) << "from the welcome on";
  settle(*client);
  ASSERT_NE(client->content(sha256(image_)), nullptr);
  EXPECT_EQ(client->rejoin().content().bytes_received(), 0U);
}

TEST_F(ContentJoinTest, a_changed_number_comes_to_who_is_there) {
  const auto client = join(false);
  settle(*client);
  EXPECT_EQ(client->content(sha256(image_)), nullptr);
  ASSERT_TRUE(server_->push({0, 0, SettingsRequest{{{"material.rock.strength", "77"}}}}));
  for (int tries = 0; tries < 500 && palettes_ < 2; ++tries) settle(*client);
  const Palette& palette = *client->mirror()->palette();
  EXPECT_EQ(palette.row(*palette.named("rock")).strength_m_s, 77.0F);
}

TEST_F(ContentJoinTest, a_bot_that_paints_with_what_the_world_lacks_says_what_it_has) {
  BotConfig config;
  config.port = server_->port();
  config.paint = "brik";
  Bot bot(config);
  ASSERT_TRUE(bot.join());
  Result<void> going;
  for (int tries = 0; tries < 500 && going; ++tries) {
    server_->step_once();
    going = bot.step(std::chrono::milliseconds(2));
  }
  ASSERT_FALSE(going);
  EXPECT_TRUE(holds(bot.report().failure, "no material 'brik'; did you mean brick?")) << bot.report().failure;
}

}  // namespace
}  // namespace scree
