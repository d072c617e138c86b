// A session from end to end: one server that records, clients that stay, join late, see little, or are cut
// off and come back; then its recording, played to a client and simulated again. The session is played once,
// the tests look at what came of it: they run in one process, in order.
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "bench/support/scenes.h"
#include "server/replay/verify.h"
#include "server/world/limits.h"
#include "tests/support/rounds.h"
#include "tests/support/session_support.h"

namespace scree {
namespace {

namespace fs = std::filesystem;

constexpr int carves = rounds(50, 12);
constexpr int ticks_per_carve = 30;
constexpr Tick ticks_min = 40 * carves;

constexpr float half_width_m = 40.0F;
constexpr float all_m = 256.0F;   ///< sees the whole session
constexpr float small_m = 16.0F;  ///< sees a part of it, and walks from one side to the other
constexpr float stride_m = 2.0F * half_width_m / static_cast<float>(carves);

struct Played {
  fs::path folder;
  std::string recording;
  std::unique_ptr<LoopbackSession> session;
  SessionClient* stays = nullptr;  ///< from the first tick to the last
  SessionClient* late = nullptr;   ///< joined after half of the carves
  SessionClient* small = nullptr;  ///< a small radius of interest that moves
  SessionClient* back = nullptr;   ///< was cut off, and came back
  uint32_t asked = 0;
};

class SessionTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    played = new Played;
    played->folder = fs::temp_directory_path() / ("scree_session_" + std::to_string(::getpid()));
    fs::create_directories(played->folder);
    played->recording = (played->folder / "session.scree").string();
    LiveConfig config;                                   // the canyon
    config.world.service.reach_m = limits::reach_max_m;  // everybody strikes everywhere
    config.record_path = played->recording;
    played->session = std::make_unique<LoopbackSession>(config);
    play(*played);
  }
  static void TearDownTestSuite() {
    played->session.reset();
    fs::remove_all(played->folder);
    delete played;
  }

  static glm::vec3 above_ground(float x_m, float z_m) {
    return {x_m, ground_height_m(TerrainSource{}, x_m, z_m) + 2.0F, z_m};
  }
  static void play(Played& p);
  static bool come_and_go(Played& p, int carve);
  static const Field& server_field() { return played->session->field(); }

  static Played* played;
};

Played* SessionTest::played = nullptr;

/// Who joins, leaves and moves before a carve.
bool SessionTest::come_and_go(Played& p, int carve) {
  LoopbackSession& session = *p.session;
  const glm::vec3 centre = above_ground(0.0F, 0.0F);
  if (carve == 0) {
    p.stays = &session.join(centre, all_m);
    p.small = &session.join(above_ground(-half_width_m, 0.0F), small_m);
    p.back = &session.join(centre, all_m);
  }
  if (carve == carves / 3) session.abort(*p.back);
  if (carve == carves / 2) p.late = &session.join(centre, all_m);
  if (carve == carves * 2 / 3) p.back = &session.join(centre, all_m);
  const float walked_m = stride_m * static_cast<float>(carve);
  p.small->set_eye(above_ground(-half_width_m + walked_m, 0.0F));
  return session.failure.empty();
}

void SessionTest::play(Played& p) {
  LoopbackSession& session = *p.session;
  if (!session.failure.empty()) return;
  ScatteredBlows blows(TerrainSource{}, half_width_m, 1.5F, 12, 1);
  for (int carve = 0; carve < carves; ++carve) {
    if (!come_and_go(p, carve)) return;
    // Everybody who is there asks in turn.
    const auto& clients = session.clients();
    clients[static_cast<size_t>(carve) % clients.size()]->send(carve_message(blows.next(), ++p.asked));
    if (!session.steps(ticks_per_carve)) return;
  }
  if (!session.settle()) return;
  while (session.tick() < ticks_min && session.step()) {
  }
}

TEST_F(SessionTest, every_client_ends_with_the_servers_field) {
  LoopbackSession& session = *played->session;
  ASSERT_EQ(session.failure, "");
  ASSERT_EQ(session.clients().size(), 4U);
  uint32_t replies = 0;
  for (const auto& client : session.clients()) {
    EXPECT_GT(client->mirror().held_chunks().size(), 0U);
    for (const ChunkCoord chunk : client->mirror().held_chunks())
      ASSERT_EQ(client->mirror().field().chunk_hash(chunk), server_field().chunk_hash(chunk));
    EXPECT_TRUE(client->mirror().pieces().empty());
    EXPECT_EQ(client->mirror().tick(), session.tick());
    for (const auto& [request, reply] : client->replies) EXPECT_EQ(reply.refusal, "");
    replies += static_cast<uint32_t>(client->replies.size());
  }
  const ServerReport report = session.server().report();
  EXPECT_GE(report.operations.of<CarveOperation>(), static_cast<uint64_t>(carves))
      << "a dent is a carve, too";
  EXPECT_GE(replies, static_cast<uint32_t>(carves) * 2 / 3) << "the others went to the one that was cut off";
  EXPECT_GT(report.pieces_made, static_cast<uint64_t>(carves));
  EXPECT_EQ(report.ledger.error(), 0);
  EXPECT_GE(session.tick(), ticks_min);
}

TEST_F(SessionTest, every_client_holds_every_edited_chunk_within_its_interest) {
  ASSERT_EQ(played->session->failure, "");
  for (SessionClient* client : {played->stays, played->late, played->back})
    EXPECT_EQ(client->mirror().field().hash(), server_field().hash());
  size_t beyond = 0;
  for (const auto& client : played->session->clients()) {
    const float dx = client->mirror().terrain().voxel_size_m;
    for (const ChunkCoord chunk : server_field().edited_chunks()) {
      const float distance_m = distance_to_chunk_m(client->client().eye_m(), chunk, dx);
      const bool held = client->mirror().held_chunks().contains(chunk);
      if (held) {
        EXPECT_LE(distance_m, client->client().radius_m() * 1.25F);
      } else {
        EXPECT_GT(distance_m, client->client().radius_m());
      }
      beyond += held ? 0 : 1;
    }
  }
  EXPECT_GT(beyond, 0U) << "the small one holds everything: its interest has not been tried";
}

TEST_F(SessionTest, no_chunk_was_sent_again_on_a_clean_link) {
  ASSERT_EQ(played->session->failure, "");
  for (const auto& client : played->session->clients()) {
    EXPECT_GT(client->mirror().counters().checks, 0U);
    EXPECT_EQ(client->mirror().counters().mismatches, 0U);
    EXPECT_EQ(client->mirror().counters().repairs_asked, 0U);
    EXPECT_EQ(client->mirror().counters().resets, 0U);
  }
  const NetStats net = played->session->server().report().net;
  EXPECT_EQ(net.published.repairs, 0U);
  EXPECT_EQ(net.published.resets, 0U);
  EXPECT_EQ(net.sessions_refused, 0U);
}

/// The session went every way that an edit can take to a client.
TEST_F(SessionTest, operations_chunks_and_pieces_have_all_been_tried) {
  ASSERT_EQ(played->session->failure, "");
  const uint64_t all = played->session->server().report().operations.of<CarveOperation>();
  const MirrorCounters& stays = played->stays->mirror().counters();
  EXPECT_EQ(stays.operations.of<CarveOperation>(), all);
  EXPECT_EQ(stays.chunks + stays.patched_bricks, 0U) << "who saw everything needs operations alone";
  for (SessionClient* client : {played->late, played->back}) {
    EXPECT_GT(client->mirror().counters().chunks, 0U);
    EXPECT_LT(client->mirror().counters().operations.of<CarveOperation>(), all);
  }
  const MirrorCounters& small = played->small->mirror().counters();
  EXPECT_GT(small.operations.of<CarveOperation>(), 0U);
  EXPECT_LT(small.operations.of<CarveOperation>(), all);
  EXPECT_GT(small.chunks, 0U);
  EXPECT_GT(small.dropped_chunks, 0U);
}

TEST_F(SessionTest, replay_gives_a_client_the_hash_of_every_tick) {
  ASSERT_EQ(played->session->failure, "");
  const uint64_t last_hash = server_field().hash();
  const auto stopped = played->session->server().stop();
  ASSERT_TRUE(stopped.has_value()) << stopped.error().message;
  auto reader = RecordingReader::open(played->recording);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  EXPECT_EQ((*reader)->last_tick(), played->session->tick());
  LiveConfig config;
  config.replay.path = played->recording;
  config.replay.at_end = AtEnd::end;
  LoopbackSession replay(config);
  ASSERT_EQ(replay.failure, "");
  SessionClient& viewer = replay.join(above_ground(0.0F, 0.0F), all_m);
  for (Tick tick = 1; tick <= (*reader)->last_tick(); ++tick) {
    ASSERT_TRUE(replay.step()) << replay.failure;
    const auto frame = (*reader)->frame(tick);
    ASSERT_TRUE(frame.has_value()) << frame.error().message;
    ASSERT_EQ(viewer.mirror().tick(), tick);
    ASSERT_EQ(viewer.mirror().field().hash(), frame->field_hash) << "tick " << tick;
  }
  EXPECT_EQ(viewer.mirror().field().hash(), last_hash);
  EXPECT_EQ(viewer.mirror().counters().mismatches, 0U);
  EXPECT_TRUE(viewer.mirror().pieces().empty());
  EXPECT_FALSE(replay.server().step_once()) << "the recording goes on";
}

TEST_F(SessionTest, verify_agrees_twice_in_this_process_and_in_another) {
  ASSERT_EQ(played->session->failure, "");
  ASSERT_TRUE(played->session->server().stop().has_value());
  const std::string command = std::string(SCREE_REPLAY_PROGRAM) + " verify --json " + played->recording;
  std::FILE* other = ::popen(command.c_str(), "r");
  ASSERT_NE(other, nullptr);
  for (int i = 0; i < 2; ++i) {
    auto reader = RecordingReader::open(played->recording);
    ASSERT_TRUE(reader.has_value()) << reader.error().message;
    const auto report = verify(**reader);
    ASSERT_TRUE(report.has_value()) << report.error().message;
    EXPECT_TRUE(report->agrees()) << report->first_difference << ": " << report->difference;
    EXPECT_EQ(report->ticks, played->session->tick());
    EXPECT_EQ(report->commands, static_cast<uint64_t>(carves));
  }
  std::string said;
  for (int c = std::fgetc(other); c != EOF; c = std::fgetc(other)) said += static_cast<char>(c);
  EXPECT_EQ(::pclose(other), 0) << said;
  const auto json = nlohmann::json::parse(said);
  EXPECT_EQ(json.at("agrees"), true);
  EXPECT_EQ(json.at("ticks"), played->session->tick());
}

}  // namespace
}  // namespace scree
