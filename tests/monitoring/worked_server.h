// A server that has done a bit of everything that it has figures of, stepped by hand, and its page of them.
#pragma once

#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "server/app/live_server.h"
#include "server/rules/rules.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/net_server_fixture.h"
#include "tests/support/test_folder.h"
#include "tests/support/web_client.h"

namespace scree {

/// The samples of a page: values by name and labels, as in `scree_chunks{place="file"}`.
using Samples = std::map<std::string, double>;

inline Samples samples_of(const std::string& page) {
  Samples samples;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    const size_t space = line.rfind(' ');
    samples[line.substr(0, space)] = std::stod(line.substr(space + 1));
  }
  return samples;
}

inline std::set<std::string> names_in(const Samples& samples) {
  std::set<std::string> names;
  for (const auto& [sample, value] : samples) names.insert(sample.substr(0, sample.find('{')));
  return names;
}

class WorkedServer {
 public:
  static constexpr Tick ticks = 150;

  WorkedServer() {
    config.pacing = Pacing::by_hand;
    config.world.terrain = flat_terrain;
    config.world_path = folder_ / "hill.world";
    config.record_path = folder_ / "hill.scree";
    config.events_path = folder_ / "events.jsonl";
    std::filesystem::create_directories(folder_ / "shop");
    std::ofstream(folder_ / "shop/init.lua") << "on.tick(function(e) end)\non.carve(function(e) end)\n"
                                                "on.say(function(e) error('no') end)\n";
    RulesOptions options;
    options.folders = {folder_ / "shop"};
    rules_ = std::move(*Rules::load(options));
    config.hooks = rules_->hooks();
  }

  /// A client joins, carves, and is refused a carve; a carve's pieces merge.
  void work() {
    server = *LiveServer::start(config);
    person_ = std::make_unique<RawClient>(server->port());
    ASSERT_TRUE(person_->send(hello()));
    ASSERT_TRUE(person_->receive_as<WelcomeMessage>());
    CarveMessage hole = carve(1);
    hole.seeds = 6;
    ASSERT_TRUE(person_->send(hole));
    CarveMessage too_large = carve(2);
    too_large.shape = sphere({}, 50.0F);
    ASSERT_TRUE(person_->send(too_large));
    await_requests(2);
    while (server->report().ticks < ticks) ASSERT_TRUE(server->step_once());
    await_files();
  }

  std::string page() {
    const HttpAnswer answer = HttpClient(server->port()).get("/metrics");
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.field("Content-Type"), "text/plain; version=0.0.4; charset=utf-8");
    return answer.body;
  }
  const TestFolder& folder() const { return folder_; }

 private:
  TestFolder folder_;
  std::unique_ptr<Rules> rules_;
  std::unique_ptr<RawClient> person_;

 public:
  LiveConfig config;
  std::unique_ptr<LiveServer> server;  ///< ends before its files go

 private:
  void await_requests(uint64_t count) {
    const auto deadline = std::chrono::steady_clock::now() + patience;
    while (server->report().net.requests < count && std::chrono::steady_clock::now() < deadline)
      ASSERT_TRUE(server->step_once());
  }
  /// The storage threads write when they have the time.
  void await_files() {
    const auto has_all = [](const ServerReport& report) {
      return report.saving.saves > 0 && report.record_size.disk_free_bytes > 0 && report.events.written > 0;
    };
    const auto deadline = std::chrono::steady_clock::now() + patience;
    while (!has_all(server->report()) && std::chrono::steady_clock::now() < deadline)
      std::this_thread::sleep_for(milliseconds(5));
    ASSERT_TRUE(has_all(server->report()));
  }
};

}  // namespace scree
