// Palettes and images on request: in parts, each once, within a budget; and nothing that the server does not
// have.
#include "server/publish/content_stream.h"

#include <gtest/gtest.h>

#include "content/builtin_palette.h"
#include "crypto/sha256.h"
#include "proto/codec.h"
#include "proto/palette_codec.h"
#include "server/publish/limits.h"
#include "tests/support/net_server_fixture.h"

namespace scree {
namespace {

constexpr size_t image_bytes = 300'000;

class ContentStreamTest : public ::testing::Test {
 protected:
  ContentStreamTest() {
    for (size_t i = 0; i < image_.size(); ++i) image_[i] = static_cast<uint8_t>(i * 7 + i / 256);
    auto files = std::make_shared<ContentFiles>();
    (*files)[sha256(image_)] = image_;
    stream_ = std::make_unique<ContentStream>(shared_builtin_palette(), std::move(files));
  }
  /// What a tick sends to session 1.
  std::vector<ContentMessage> serve(size_t room = limits::content_part_bytes_max) {
    std::vector<ContentMessage> sent;
    stream_->serve([room](uint64_t) { return room; },
                   [&](uint64_t session, const SharedBytes& bytes) {
                     const auto message = decode_server(std::span(*bytes).subspan(length_prefix_bytes));
                     EXPECT_TRUE(message.has_value());
                     if (message && session == 1) sent.push_back(std::get<ContentMessage>(*message));
                     return true;
                   });
    return sent;
  }
  std::vector<uint8_t> fetched(const Digest& digest) {
    std::vector<uint8_t> bytes;
    for (int tick = 0; stream_->waiting(1) > 0 && tick < 10000; ++tick)
      for (const ContentMessage& part : serve()) {
        EXPECT_EQ(part.digest, digest);
        EXPECT_EQ(part.offset, bytes.size());
        bytes.insert(bytes.end(), part.part.begin(), part.part.end());
      }
    return bytes;
  }
  bool ask(const Digest& digest, uint64_t session = 1) { return stream_->ask(session, session, {{digest}}); }

  std::vector<uint8_t> image_ = std::vector<uint8_t>(image_bytes);
  std::unique_ptr<ContentStream> stream_;
};

TEST_F(ContentStreamTest, palette_and_image_come_in_parts_and_once) {
  ASSERT_TRUE(ask(*stream_->palette()));
  EXPECT_EQ(fetched(*stream_->palette()), encode_palette(builtin_palette()));
  ASSERT_TRUE(ask(sha256(image_)));
  ASSERT_TRUE(ask(sha256(image_)));
  EXPECT_EQ(fetched(sha256(image_)), image_);
  ASSERT_TRUE(ask(sha256(image_)));
  EXPECT_EQ(stream_->waiting(1), 0U);
  ASSERT_TRUE(ask(sha256(image_), 2));  // another session gets it, too
  EXPECT_EQ(stream_->waiting(2), 1U);
}

TEST_F(ContentStreamTest, a_tick_sends_no_more_than_its_bytes_and_one_part) {
  ASSERT_TRUE(ask(sha256(image_)));
  size_t bytes = 0;
  for (size_t tick = 1; stream_->waiting(1) > 0; ++tick) {
    for (const ContentMessage& part : serve()) bytes += part.part.size();
    EXPECT_LE(bytes, tick * limits::content_bytes_per_tick + limits::content_part_bytes_max);
  }
  EXPECT_EQ(bytes, image_.size());
}

TEST_F(ContentStreamTest, a_slow_link_gets_parts_of_its_room) {
  ASSERT_TRUE(ask(sha256(image_)));
  for (const ContentMessage& part : serve(2000)) EXPECT_EQ(part.part.size(), 2000U);
  for (const ContentMessage& part : serve(1)) EXPECT_EQ(part.part.size(), limits::content_part_bytes_min);
  EXPECT_TRUE(serve(0).empty());
}

TEST_F(ContentStreamTest, what_is_not_there_is_answered_so) {
  const Digest unknown{1, 2, 3};
  ASSERT_TRUE(ask(unknown));
  const std::vector<ContentMessage> sent = serve();
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].digest, unknown);
  EXPECT_EQ(sent[0].total, 0U);
}

TEST_F(ContentStreamTest, more_than_may_wait_are_refused_together) {
  const AskContentMessage many{std::vector<Digest>(limits::contents_wanted_max)};
  ASSERT_TRUE(stream_->ask(1, 1, many));
  EXPECT_FALSE(ask(*stream_->palette()));
  EXPECT_EQ(stream_->waiting(1), limits::contents_wanted_max);
  stream_->leave(1);
  EXPECT_EQ(stream_->waiting(1), 0U);
}

TEST_F(ContentStreamTest, settings_of_materials_make_another_palette) {
  const Digest before = *stream_->palette();
  EXPECT_FALSE(stream_->take_settings({{"impacts", "false"}}));
  ASSERT_TRUE(stream_->take_settings({{"material.rock.strength", "77"}}));
  EXPECT_NE(*stream_->palette(), before);
  ASSERT_TRUE(ask(*stream_->palette()));
  const auto changed = decode_palette(fetched(*stream_->palette()));
  ASSERT_TRUE(changed.has_value());
  EXPECT_EQ(changed->row(*changed->named("rock")).strength_m_s, 77.0F);
  ASSERT_TRUE(ask(before));  // the one before is gone
  EXPECT_EQ(serve().at(0).total, 0U);
  ASSERT_TRUE(stream_->take_settings({}));
  EXPECT_EQ(*stream_->palette(), before);
}

TEST_F(ContentStreamTest, a_slow_session_may_ask_for_each_of_many_palettes) {
  for (size_t change = 0; change < 4 * limits::contents_wanted_max; ++change) {
    const Digest before = *stream_->palette();
    ASSERT_TRUE(stream_->take_settings({{"material.rock.strength", std::to_string(100 + change)}}));
    if (change % 3 == 0) {
      ASSERT_TRUE(ask(before)) << "the news of the next one is on its way";
    }
    ASSERT_TRUE(ask(*stream_->palette())) << change;
    if (change == 10) {
      EXPECT_FALSE(serve(1).empty()) << "one is begun";
    }
    EXPECT_LE(stream_->waiting(1), 3U) << change;
  }
  std::map<Digest, size_t> sent;
  for (int tick = 0; stream_->waiting(1) > 0 && tick < 10000; ++tick)
    for (const ContentMessage& part : serve()) sent[part.digest] += part.part.size();
  EXPECT_GT(sent[*stream_->palette()], 1000U);
}

using ContentServerTest = NetServerTest;

TEST_F(ContentServerTest, a_welcome_names_the_palette_and_the_server_has_it) {
  start();
  RawClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  const auto welcome = client.receive_as<WelcomeMessage>();
  ASSERT_TRUE(welcome && welcome->palette);
  EXPECT_EQ(*welcome->palette, sha256(encode_palette(builtin_palette())));
  ASSERT_TRUE(client.send(AskContentMessage{{*welcome->palette}}));
  await(*server, &NetStats::sessions_joined, uint64_t{2});
  std::vector<uint8_t> bytes;
  for (int tries = 0; tries < 100 && bytes.empty(); ++tries) {
    tick();
    if (const auto part = client.receive_as<ContentMessage>()) bytes = part->part;
  }
  EXPECT_EQ(bytes, encode_palette(builtin_palette()));
}

TEST_F(ContentServerTest, who_asks_for_more_than_may_wait_is_refused) {
  start();
  RawClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  ASSERT_TRUE(client.receive_as<WelcomeMessage>().has_value());
  const AskContentMessage many{std::vector<Digest>(limits::contents_wanted_max)};
  ASSERT_TRUE(client.send(many) && client.send(many));
  expect_refused(client, "limits.contents_wanted_max");
}

}  // namespace
}  // namespace scree
