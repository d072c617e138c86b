// NATS as docker/nats.conf has it: encrypted, with a user for each, who can do what he needs and no more.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <mutex>
#include <sstream>

#include "tests/bus/edge_client.h"
#include "tests/support/certificates.h"

namespace scree {
namespace {

/// What a subscription got.
class Heard {
 public:
  Bus::Handler handler() {
    return [this](const std::string& subject, std::span<const uint8_t> bytes) {
      const std::scoped_lock lock(mutex_);
      heard_.emplace_back(subject, std::vector<uint8_t>(bytes.begin(), bytes.end()));
    };
  }
  bool has(const std::string& subject, const std::vector<uint8_t>& bytes) const {
    const std::scoped_lock lock(mutex_);
    return std::ranges::find(heard_, std::pair(subject, bytes)) != heard_.end();
  }
  bool has_bytes(const std::vector<uint8_t>& bytes) const {
    const std::scoped_lock lock(mutex_);
    return std::ranges::any_of(heard_, [&](const auto& one) { return one.second == bytes; });
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::pair<std::string, std::vector<uint8_t>>> heard_;
};

class DockerNatsTest : public ::testing::Test {
 protected:
  DockerNatsTest() {
    const TestCertificate authority("DNS:authority"), issued("IP:127.0.0.1", &authority);
    authority.write(folder / "ca.pem", folder / "ca.key");
    issued.write(folder / "fullchain.pem", folder / "privkey.pem");
    std::ostringstream text;
    text << std::ifstream(SCREE_SOURCE_DIR "/docker/nats.conf").rdbuf();
    std::string conf = text.str();
    for (size_t at = 0; (at = conf.find("/etc/certificates/")) != std::string::npos;)
      conf.replace(at, std::string("/etc/certificates").size(), folder / "");
    // Where streams lie is said by NatsProcess.
    const size_t streams = conf.find("store_dir:");
    conf.erase(streams, conf.find('\n', streams) - streams);
    std::ofstream(folder / "nats.conf") << conf;
    ::setenv("SIMULATOR_PASSWORD", "simulators-own", 1);
    ::setenv("EDGE_1_PASSWORD", "firsts-own", 1);
    ::setenv("EDGE_2_PASSWORD", "seconds-own", 1);
    nats = std::make_unique<NatsProcess>(std::vector<std::string>{"-c", folder / "nats.conf"});
  }
  std::string url(const std::string& user) const {
    std::string address = nats->url(user);
    return address.replace(0, std::string("nats").size(), "tls");
  }
  std::shared_ptr<Bus> bus(const std::string& user) const {
    BusConfig config = bus_at(url(user));
    config.ca_path = folder / "ca.pem";
    auto made = Bus::connect(config);
    EXPECT_TRUE(made) << made.error().message;
    return *made;
  }
  std::shared_ptr<Bus> connected(const std::string& user) const {
    auto made = bus(user);
    EXPECT_TRUE(comes([&] { return made->is_connected(); })) << made->fault();
    return made;
  }
  /// As compose.edges.yaml starts it.
  std::unique_ptr<BackgroundProgram> run(const std::string& what, const std::string& user, uint16_t port,
                                         std::vector<std::string> more) const {
    std::vector<std::string> command{"env",
                                     "SCREE_NATS=" + url(user),
                                     "SCREE_NATS_CA=" + (folder / "ca.pem"),
                                     "SCREE_WORLD_NAME=hill",
                                     "SCREE_WORLD=",
                                     SCREE_SERVER_PROGRAM,
                                     "--port",
                                     std::to_string(port),
                                     "--web",
                                     "off"};
    command.insert(command.end(), more.begin(), more.end());
    return std::make_unique<BackgroundProgram>(command, folder / what);
  }
  std::string said(const std::string& what) const {
    std::ostringstream text;
    text << std::ifstream(folder / what).rdbuf();
    return text.str();
  }

  const TestFolder folder;
  std::unique_ptr<NatsProcess> nats;
};

const std::string simulator = "simulator:simulators-own", first = "edge-1:firsts-own",
                  second = "edge-2:seconds-own";

TEST_F(DockerNatsTest, a_world_is_told_and_an_edges_people_carve) {
  const uint16_t port = free_port(), edge_port = free_port();
  const auto server = run("server", simulator, port, {"--terrain", "flat"});
  const auto edge = run("edge", first, edge_port, {"--edge", "--edge-name", "edge-1"});
  ASSERT_TRUE(comes([&] { return RawClient(edge_port).connected(); })) << said("server") << said("edge");
  expect_carve_accepted(edge_port, said("server") + said("edge"));
}

TEST_F(DockerNatsTest, nobody_comes_in_without_his_password_or_in_the_clear) {
  const auto right = connected(first);
  const auto wrong = bus("edge-1:seconds-own"), none = bus("edge-3:any");
  auto clear = Bus::connect(bus_at(nats->url(first)));
  ASSERT_TRUE(clear);
  EXPECT_TRUE(
      comes([&] { return !wrong->fault().empty() && !none->fault().empty() && !(*clear)->fault().empty(); }));
  EXPECT_FALSE(wrong->is_connected() || none->is_connected() || (*clear)->is_connected());
}

TEST_F(DockerNatsTest, an_edge_can_neither_tell_a_world_nor_speak_or_listen_as_another) {
  const auto server = connected(simulator), one = connected(first), two = connected(second);
  Heard by_server, by_one, by_two;
  const auto ups = server->subscribe("scree.hill.up.*", by_server.handler());
  const auto told = two->subscribe("scree.hill.told.tick", by_two.handler());
  const auto downs = two->subscribe("scree.hill.down.edge-2", by_two.handler());
  const auto overheard = one->subscribe("scree.hill.down.edge-2", by_one.handler());
  const auto listened = one->subscribe("scree.hill.up.*", by_one.handler());
  const std::vector<uint8_t> honest{1}, forged{6}, last{7};
  // All subscriptions are there once messages that are allowed arrive.
  ASSERT_TRUE(comes([&] {
    return server->send("scree.hill.told.tick", honest) && server->send("scree.hill.down.edge-2", honest) &&
           two->send("scree.hill.up.edge-2", honest) && by_two.has("scree.hill.told.tick", honest) &&
           by_two.has("scree.hill.down.edge-2", honest) && by_server.has("scree.hill.up.edge-2", honest);
  }));
  for (const char* subject :
       {"scree.hill.told.tick", "scree.hill.told.keyframe", "scree.hill.down.edge-2", "scree.hill.up.edge-2"})
    static_cast<void>(one->send(subject, forged));
  EXPECT_FALSE(one->open_stream({"SCREE_hill", "scree.hill.told.*", 1 << 20, true}));
  // What is allowed comes behind these on the same connections.
  ASSERT_TRUE(comes([&] {
    return one->send("scree.hill.up.edge-1", last) && by_server.has("scree.hill.up.edge-1", last) &&
           server->send("scree.hill.told.tick", last) && by_two.has("scree.hill.told.tick", last);
  }));
  EXPECT_FALSE(by_two.has_bytes(forged) || by_server.has_bytes(forged));
  EXPECT_FALSE(by_one.has_bytes(honest)) << "it hears what is another's";
}

}  // namespace
}  // namespace scree
