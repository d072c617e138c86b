// An edge's side of the pipes to the simulating server (pipe_door.h): one for each person who has asked for
// something, which begins with the hello that he said to the edge. So the simulating server sees his own
// token or ticket, and nothing is asked in the name of anybody else.
//
// What is asked while the simulating server is away is refused, and so is what waits when a pipe ends. On the
// network thread, but for status().
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "proto/frame_reader.h"
#include "server/bus/bus.h"
#include "server/formats/bus_codec.h"
#include "server/net/net_server.h"
#include "server/net/way_back.h"
#include "server/told/told_names.h"

namespace scree {

struct EdgePipesConfig {
  std::string world;              ///< its name on the bus
  std::string edge;               ///< this edge's; no two have the same
  uint64_t edge_run = 0;          ///< drawn; not 0
  std::function<bool()> is_away;  ///< whether the simulating server is; from the network thread
};

struct EdgePipesStatus {
  size_t pipes = 0;
  uint64_t handed_on = 0;  ///< requests
  uint64_t answered = 0;
  uint64_t lost = 0;     ///< without an answer
  uint64_t refused = 0;  ///< messages that could not be read
};

class EdgePipes final : public WayBack {
 public:
  EdgePipes(std::shared_ptr<Bus> bus, EdgePipesConfig config);
  ~EdgePipes() override;

  /// Listens as long as the subscription is there. `net` outlives it, and must be stopped before this object
  /// is destroyed.
  Result<std::unique_ptr<BusSubscription>> open(NetServer& net);
  /// Says that the edge lives, and gives up what waits for too long. Call a few times a second.
  void check_time(double now_s);
  EdgePipesStatus status() const;

  void joined(uint64_t session, const HelloMessage& hello) override;
  void left(uint64_t session) override;
  tl::expected<void, Refused> ask(uint64_t session, glm::vec3 eye_m, uint32_t request,
                                  const ClientMessage& message) override;

 private:
  struct Person {
    HelloMessage hello;
    std::string ticket;               ///< of the simulating server; empty: none
    uint64_t pipe = 0;                ///< 0: none is open
    uint64_t sent = 0, received = 0;  ///< messages of the pipe
    FrameReader reader{};
    std::map<uint32_t, double> waiting{};  ///< requests, and since when
    glm::vec3 eye_m{0.0F};                 ///< as it was told
    Refused shut{};                        ///< why the simulating server did not let the person in
    double shut_until_s = 0.0;             ///< nothing is handed on before
  };

  void heard(std::span<const uint8_t> bytes);
  void take(const PipeMessage& message);
  void read(uint64_t session, Person& person, const PipeMessage& message);
  /// False: the person's pipe has ended.
  bool take(uint64_t session, Person& person, const ServerMessage& message);
  Result<void> open_pipe(uint64_t session, Person& person, glm::vec3 eye_m);
  Result<void> send(Person& person, const ClientMessage& message);
  void end_pipe(uint64_t session, Person& person, const Refused& why, bool tell);

  const std::shared_ptr<Bus> bus_;
  const EdgePipesConfig config_;
  const ToldNames names_;
  NetServer* net_ = nullptr;               ///< null: before open()
  std::map<uint64_t, Person> persons_;     ///< by session
  std::map<uint64_t, uint64_t> sessions_;  ///< by pipe
  uint64_t next_pipe_ = 1;
  uint64_t connections_ = 0;  ///< of the bus
  double alive_s_ = 0.0;
  std::atomic<size_t> pipes_ = 0;
  std::atomic<uint64_t> handed_on_ = 0, answered_ = 0, lost_ = 0, refused_ = 0;
  std::atomic<int> waiting_ = 0;  ///< for the network thread
};

}  // namespace scree
