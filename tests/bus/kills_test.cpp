// What is killed, by SIGKILL and at any moment, comes back: the simulating server, edges and NATS, while
// people edit at both edges. Afterwards all show one world, nothing that was saved is lost, and no mass is.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>
#include <utility>

#include "client/cache/join_server.h"
#include "client/session/client.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"
#include "shared/field/material_window.h"
#include "tests/bus/nats_process.h"

namespace scree {
namespace {

/// How often each of the three is killed; SCREE_KILLS in the environment for more.
int kills_of_each() {
  const char* const wish = std::getenv("SCREE_KILLS");
  return wish == nullptr ? 3 : std::max(1, std::atoi(wish));
}

/// A place for each edit, which nobody else paints.
glm::vec3 place_of(uint32_t edit) {
  return {static_cast<float>(edit % 80) - 40.0F, -2.0F - static_cast<float>(edit / 6400),
          static_cast<float>(edit / 80 % 80) - 40.0F};
}

/// Who watches a world at a door, and joins again by himself. One thread.
class Watcher {
 public:
  explicit Watcher(uint16_t port)
      : client_(std::make_unique<ServerConnector>(ServerEndpoint{.port = port}, std::chrono::seconds(5))) {}

  /// Takes in what has come.
  void step() {
    const double now_s = steady_now_s();
    if (!client_.connected() && !client_.joining() && now_s >= next_try_s_) {
      client_.join({protocol_version, "watcher", {0.0F, 2.0F, 0.0F}, 64.0F}, now_s);
      next_try_s_ = now_s + 0.1;
    }
    client_.poll(now_s);
    while (const std::optional<Client::Event> event = client_.next()) {
      if (const auto* lost = std::get_if<Client::Lost>(&*event)) {
        asked_.clear();
        lost_ = lost->end.message;
      }
      if (const auto* applied = std::get_if<Client::Applied>(&*event)) take(applied->received.message, now_s);
    }
    if (client_.mirror() == nullptr) return;
    if (client_.mirror()->tick() != tick_) {
      if (news_s_ > 0.0) longest_s_ = std::max(longest_s_, now_s - news_s_);
      tick_ = client_.mirror()->tick();
      news_s_ = now_s;
    }
  }
  void paint(uint32_t edit) {
    if (!client_.connected()) return;
    asked_[edit] = true;
    PaintMessage message;
    message.shape = sphere(place_of(edit), 0.4F);
    message.material = material::ice;
    message.request = edit;
    client_.send(message);
  }
  void strike(uint32_t seed) {
    if (!client_.connected()) return;
    CarveMessage message;
    message.shape = sphere(
        {static_cast<float>(seed % 21) - 10.0F, 0.0F, static_cast<float>(seed / 21 % 21) - 10.0F}, 0.8F);
    message.seeds = 4;
    message.random_seed = seed;
    message.impact_m = centre_of(message.shape);
    message.request = strikes_from + seed;
    client_.send(message);
  }
  /// Edits that were acknowledged since the last call.
  std::vector<uint32_t> take_accepted() { return std::exchange(accepted_, {}); }

  bool has_news_since(double s) const { return news_s_ > s; }
  double longest_without_news_s() const { return longest_s_; }
  /// For who reads a failure.
  std::string words() const {
    return fmt::format("{}, tick {}, {:.1f} s without news; lost last: {}",
                       client_.connected() ? "connected" : "not connected", tick_, steady_now_s() - news_s_,
                       lost_);
  }
  Tick tick() const { return tick_; }
  Tick saved_tick() const { return status_.saved_tick; }
  const StatusMessage& status() const { return status_; }
  uint64_t hash() { return client_.mirror()->field().hash(); }
  Material material_of(uint32_t edit) { return material_at(client_.mirror()->field(), place_of(edit)); }

 private:
  static constexpr uint32_t strikes_from = 1U << 30U;

  void take(const ServerMessage& message, double now_s) {
    if (const auto* reply = std::get_if<ReplyMessage>(&message)) {
      if (asked_.erase(reply->request) == 1 && reply->refusal.empty()) accepted_.push_back(reply->request);
    } else if (const auto* status = std::get_if<StatusMessage>(&message)) {
      status_ = *status;
      news_s_ = now_s;
    }
  }

  Client client_;
  std::string lost_;
  std::map<uint32_t, bool> asked_;
  std::vector<uint32_t> accepted_;
  StatusMessage status_;
  Tick tick_ = 0;
  double next_try_s_ = 0.0, news_s_ = 0.0, longest_s_ = 0.0;
};

class KillsTest : public ::testing::Test {
 protected:
  KillsTest() {
    for (const int i : {0, 1, 2}) start(i);
    for (const uint16_t port : ports) watchers.emplace_back(std::make_unique<Watcher>(port));
  }

  /// 0: the simulating server; 1 and 2: edges.
  void start(int which) {
    std::vector<std::string> command{SCREE_SERVER_PROGRAM,
                                     "--nats",
                                     nats.url(),
                                     "--world-name",
                                     "quarry",
                                     "--port",
                                     std::to_string(ports[static_cast<size_t>(which)]),
                                     "--web",
                                     "off",
                                     "--anonymous",
                                     "builder",
                                     "--reach",
                                     "0",
                                     "--requests-per-second",
                                     "1000"};
    const std::vector<std::string> more =
        which == 0
            ? std::vector<std::string>{"--terrain", "flat", "--world", folder / "w", "--durability", "tick"}
            : std::vector<std::string>{"--edge", "--edge-name", fmt::format("edge{}", which)};
    command.insert(command.end(), more.begin(), more.end());
    programs[static_cast<size_t>(which)] =
        std::make_unique<BackgroundProgram>(command, folder / fmt::format("said{}-{}", which, ++starts));
    last_start[static_cast<size_t>(which)] = starts;
  }
  void kill(int which) {
    if (which == 3)
      nats.kill();
    else
      programs[static_cast<size_t>(which)].reset();
  }
  void revive(int which) {
    if (which == 3)
      nats.start();
    else
      start(which);
  }

  /// What the programs said last, and how the watchers are.
  std::string words() const {
    std::string words;
    for (const auto& watcher : watchers) words += watcher->words() + "\n";
    for (const int which : {0, 1, 2}) {
      std::ifstream file(folder / fmt::format("said{}-{}", which, last_start[static_cast<size_t>(which)]));
      std::ostringstream said;
      said << file.rdbuf();
      words += said.str();
    }
    return words;
  }
  void step() {
    for (const auto& watcher : watchers) watcher->step();
    note_saved();
    std::this_thread::sleep_for(std::chrono::milliseconds(4));
  }
  /// People edit at both edges for a while.
  void edit_for(double seconds) {
    const double end_s = steady_now_s() + seconds;
    while (steady_now_s() < end_s) {
      if (++turn % 8 == 0) watchers[1 + turn / 8 % 2]->paint(++edits);
      if (turn % 200 == 0) watchers[1]->strike(turn / 200);
      step();
    }
  }
  template <typename Condition>
  bool comes(const Condition& condition) {
    const Within patience_over(std::chrono::duration<double>(patience).count());
    while (!condition()) {
      if (patience_over.over()) return false;
      step();
    }
    return true;
  }

  /// An edit that an edge acknowledged is saved when the file has a tick that the simulating server told
  /// afterwards.
  void note_saved() {
    Watcher& direct = *watchers[0];
    const double now_s = steady_now_s();
    for (const size_t edge : {size_t{1}, size_t{2}})
      for (const uint32_t edit : watchers[edge]->take_accepted())
        if (now_s > under_way_until_s) told.push_back({edit, now_s});
    for (Told& one : told)
      if (one.tick == 0 && now_s > one.at_s + 0.3) one.tick = direct.tick();
    std::erase_if(told, [&](const Told& one) {
      const bool is_saved = one.tick > 0 && direct.saved_tick() >= one.tick;
      if (is_saved) saved.push_back(one.edit);
      return is_saved;
    });
  }

  struct Told {
    uint32_t edit = 0;
    double at_s = 0.0;
    Tick tick = 0;  ///< by which it had happened; 0: not known yet
  };

  const TestFolder folder;
  NatsProcess nats;
  const std::array<uint16_t, 3> ports{free_port(), free_port(), free_port()};
  std::array<std::unique_ptr<BackgroundProgram>, 3> programs;
  std::vector<std::unique_ptr<Watcher>> watchers;
  std::vector<Told> told;
  std::vector<uint32_t> saved;
  uint32_t edits = 0, turn = 0;
  double under_way_until_s = 0.0;
  int starts = 0;
  std::array<int, 3> last_start{};
};

TEST_F(KillsTest, nothing_that_was_saved_is_lost_whatever_is_killed) {
  const auto all_have_news = [&](double since_s) {
    return std::ranges::all_of(watchers,
                               [&](const auto& watcher) { return watcher->has_news_since(since_s); });
  };
  ASSERT_TRUE(comes([&] { return all_have_news(0.0); }));
  std::vector<int> victims;
  for (const int which : {0, 1, 3})
    victims.insert(victims.end(), static_cast<size_t>(kills_of_each()), which);
  Random random(7);
  for (size_t i = victims.size(); i > 1; --i)
    std::swap(victims[i - 1], victims[static_cast<size_t>(random.unit() * static_cast<float>(i))]);
  double slowest_s = 0.0;
  for (int which : victims) {
    if (which == 1) which += random.unit() < 0.5F ? 1 : 0;
    edit_for(0.3 + 0.9 * static_cast<double>(random.unit()));
    kill(which);
    if (which == 0) {  // whether these were saved nobody knows, and of answers that are under way neither
      told.clear();
      under_way_until_s = steady_now_s() + 0.5;
    }
    edit_for(0.4 * static_cast<double>(random.unit()));
    revive(which);
    const double back_s = steady_now_s();
    ASSERT_TRUE(comes([&] { return all_have_news(back_s + 0.1); })) << "victim " << which << "\n" << words();
    slowest_s = std::max(slowest_s, steady_now_s() - back_s);
  }
  edit_for(2.0);
  const auto agree = [&] {
    return told.empty() && watchers[0]->status().pieces == 0 && watchers[0]->hash() == watchers[1]->hash() &&
           watchers[0]->hash() == watchers[2]->hash();
  };
  ASSERT_TRUE(comes(agree)) << watchers[0]->hash() << ' ' << watchers[1]->hash() << ' '
                            << watchers[2]->hash();
  EXPECT_GT(saved.size(), victims.size());
  size_t lost = 0;
  for (const auto& watcher : watchers)
    for (const uint32_t edit : saved) lost += watcher->material_of(edit) == material::ice ? 0 : 1;
  EXPECT_EQ(lost, 0U) << "of " << saved.size();
  const StatusMessage& status = watchers[0]->status();
  EXPECT_EQ(status.ledger_terrain + status.ledger_pieces + status.ledger_dust + status.ledger_stored -
                status.ledger_poured,
            0);
  fmt::print(
      "{} kills; {} edits were saved; news again after {:.2f} s at most, and no edge was without for more "
      "than {:.2f} s\n",
      victims.size(), saved.size(), slowest_s,
      std::max(watchers[1]->longest_without_news_s(), watchers[2]->longest_without_news_s()));
}

}  // namespace
}  // namespace scree
