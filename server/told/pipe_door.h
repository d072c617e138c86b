// Where the persons of edges come into the simulating server: each by a pipe, which carries the protocol of
// clients as a socket would. So token, ticket, role, rates and bans are looked at as of anybody who connects;
// an edge can do nothing for a person but pass on what he sends. Persons without a token are one party for
// each edge.
//
// Edges are not trusted: their messages are decoded and counted, their pipes and messages bounded. Listens on
// the bus's threads; all else runs on the network thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "server/bus/bus.h"
#include "server/formats/bus_codec.h"
#include "server/net/net_server.h"
#include "server/told/pipe_transport.h"
#include "server/told/told_names.h"
#include "shared/base/log_limit.h"
#include "shared/base/rate_limit.h"

namespace scree {

struct PipeDoorStatus {
  size_t edges = 0;
  size_t pipes = 0;
  uint64_t opened = 0;
  uint64_t refused = 0;  ///< messages that could not be read, or were too many
};

class PipeDoor {
 public:
  /// `net` must be stopped before this object is destroyed, and outlive it.
  static Result<std::unique_ptr<PipeDoor>> open(std::shared_ptr<Bus> bus, const std::string& world,
                                                NetServer& net, bool encrypted);
  ~PipeDoor();
  PipeDoor(const PipeDoor&) = delete;
  PipeDoor& operator=(const PipeDoor&) = delete;

  /// Ends the pipes of edges that are silent. Call a few times a second on the network thread.
  void check_time(double now_s);
  /// From any thread.
  PipeDoorStatus status() const;

 private:
  struct Edge {
    explicit Edge(double now_s);
    uint64_t run = 0;
    double heard_s = 0.0;
    RateLimit opens, messages;
    std::map<uint64_t, std::shared_ptr<PipeTransport>> pipes;
  };

  PipeDoor(std::shared_ptr<Bus> bus, const std::string& world, NetServer& net, bool encrypted);
  void heard(const std::string& subject, std::span<const uint8_t> bytes);
  void take(const std::string& edge_name, const PipeMessage& message);
  /// Null: it is not heard.
  Edge* edge_of(const std::string& name, const PipeMessage& message, double now_s);
  std::shared_ptr<PipeTransport> open_pipe(Edge& edge, const std::string& name, const PipeMessage& message,
                                           double now_s);
  void pass(Edge& edge, const PipeMessage& message, const std::shared_ptr<PipeTransport>& pipe);
  void end_pipes(Edge& edge, const std::string& why);
  void answer_end(const std::string& edge_name, const PipeMessage& message);
  void count();

  const std::shared_ptr<Bus> bus_;
  const ToldNames names_;
  NetServer& net_;
  const bool encrypted_;
  std::map<std::string, Edge> edges_;
  size_t pipes_ = 0;
  LogLimit log_limit_;
  std::atomic<size_t> edges_seen_ = 0, pipes_seen_ = 0;
  std::atomic<uint64_t> opened_ = 0, refused_ = 0;
  std::atomic<int> waiting_ = 0;  ///< for the network thread
  std::unique_ptr<BusSubscription> subscription_;
};

}  // namespace scree
