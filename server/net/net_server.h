// The server's network side: accepts clients, hands their requests to the simulation, and sends them the
// messages that the Publisher selects.
//
// One network thread owns all sockets; it only queues, decodes and sends. Encoding and sending it shares with
// workers (workers.h), for which it waits. The simulation calls publish(), which only posts. A client that
// breaks the protocol gets the reason and is closed; other clients do not notice.
//
// The host that simulates has two duties, and both are checked. It gives listen() the world as it stands, and
// publishes every later tick, in order. Clients hold the world by its changes, so a gap would cost them all
// of it. A server that plays a recording (NetConfig::replay) may jump: its tick out of order is a keyframe,
// and resets every client.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "content/builtin_palette.h"
#include "proto/event.h"
#include "proto/talk.h"
#include "server/command/joined_person.h"
#include "server/doors/access.h"
#include "server/doors/bytes_out.h"
#include "server/doors/door.h"
#include "server/doors/ip_network.h"
#include "server/doors/limits.h"
#include "server/doors/proxies.h"
#include "server/net/command_queue.h"
#include "server/net/flight_reports.h"
#include "server/net/host_records.h"
#include "server/net/limits.h"
#include "server/net/message_counts.h"
#include "server/net/request_times.h"
#include "server/net/server_health.h"
#include "server/net/way_back.h"
#include "server/publish/limits.h"
#include "server/publish/publisher.h"
#include "server/web/web_config.h"
#include "server/world/service_limits.h"
#include "shared/base/result.h"
#include "shared/base/timing.h"
#include "transport/transport.h"

namespace scree {

/// Counts since the start.
struct NetStats {
  PublisherStats published;
  uint32_t sessions = 0;      ///< now
  uint32_t sessions_max = 0;  ///< the setting, as far as the process may open files
  uint64_t sessions_joined = 0;
  uint64_t sessions_resumed = 0;       ///< of those that joined: went on by a ticket
  uint64_t tickets_void = 0;           ///< presented, and did not hold
  uint64_t sessions_refused = 0;       ///< refused, or closed with a reason
  uint64_t sessions_disconnected = 0;  ///< cut off: they did not read, or said no hello
  uint64_t turned_away = 0;            ///< connections closed without a session
  uint64_t requests = 0;
  uint64_t requests_refused = 0;  ///< by a limit of the network side
  RefusalCounts refusals;  ///< of requests, by the world and the network side, of sessions and connections
  uint64_t messages_unknown = 0;  ///< skipped: of a kind, or with a value, that this version does not know
  uint64_t publish_waits = 0;     ///< times that the simulation waited for the network thread
  uint64_t bytes_out = 0;         ///< to sessions and by HTTP
  uint64_t bytes_out_held = 0;    ///< times that a session or a connection had no room in its budget
  WebStats web;
};

/// What the network side knows of a server's state, for operators.
struct NetFigures {
  NetStats stats;
  LatencyCounts latency;  ///< of requests that a tick answered, since the start
  StatusMessage status;   ///< what clients are told alike
  std::vector<SessionRow> sessions;
  HealthMessage health;
  MessageCounts messages;
  Durations frame_age;        ///< of frames when their client's socket is given them, since their tick's end
  uint64_t unsent_bytes = 0;  ///< that wait for all clients together
  uint64_t sessions_behind =
      0;  ///< of those that have joined: more waits for them than their links take soon
};

/// How the network thread keeps up, by the tick that it took latest since it was asked before.
struct NetLoad {
  float lag_ms = 0.0F;   ///< from the tick's end until it was taken
  float busy_ms = 0.0F;  ///< for handing it on
  float cpu_ms = 0.0F;   ///< of it on a processor
};

struct NetConfig {
  std::string bind = "127.0.0.1";
  uint16_t port = 0;  ///< 0: any free one
  TerrainSource terrain;
  uint32_t tick_rate_hz = 60;
  uint32_t ticks_per_transform = 3;
  ServiceLimits service;     ///< until a tick says otherwise
  bool replay = false;       ///< a recording: requests are refused
  std::string admin_token;   ///< a client with it is an administrator; empty: there is none
  std::string admin_socket;  ///< path of a Unix socket by which the server's owner comes in; empty: none
  AccessConfig access;
  Door::Rules door{limits::connections_per_address_max, limits::connects_per_second_max,
                   limits::connects_burst_max};
  BytesOut::Rules bytes_out;
  Proxies proxies;  ///< those that are trusted to say for whom they speak
  double hello_seconds = limits::hello_seconds_max;
  double stall_seconds = limits::stall_seconds_max;
  double heartbeat_s = limits::heartbeat_s;  ///< as of PublisherConfig
  uint64_t world = 0;                        ///< WelcomeMessage::world; 0: one is drawn
  uint64_t first_session = 1;                ///< number of the first session; positive
  std::function<Saving()> saving;            ///< what is told of saves, once a tick; may be empty
  /// Takes the events of sessions, join and leave, without their tick; on the network thread. May be empty.
  std::function<void(Event)> noted;
  /// What of the server's health the network side does not see itself; on the network thread. May be empty.
  std::function<ServerHealth()> health;
  /// Called a few times a second on the network thread, with the time of steady_now_s(). May be empty.
  std::function<void(double now_s)> checked;
  /// Takes a person's line; false: the line is not passed on. On the network thread. May be empty.
  std::function<bool(const SaidMessage&)> said;
  /// Take who joins and who is gone, and what programs say to a host's rules; likewise.
  std::function<void(const JoinedPerson&)> joined;
  std::function<void(uint64_t session)> left;
  std::function<void(uint64_t session, const ChannelData&)> heard;
  /// Takes what an administrator wants of the rules, which answer later. Empty: this server has none.
  std::function<void(uint64_t session, uint32_t request, const ControlRulesRequest&)> control_rules;
  /// Takes what an administrator asks of the world's history, which answers later, and who he is, in words.
  /// Empty: this server keeps none.
  std::function<void(uint64_t session, uint32_t request, const HistoryAct&, const std::string& who)>
      ask_history;
  /// Takes what somebody who may wants of a replay; on the network thread. Empty: this server plays none.
  std::function<Result<void>(const ControlReplayRequest&)> control;
  /// Takes what persons at an edge ask of the world. Null: the world is this server's own.
  std::shared_ptr<WayBack> way_back{};
  FlightReports flight{};
  HostRecords records{};
  bool takes_cursors = false;           ///< NetServer::cursors() has them: a recording keeps them
  bool chat = true;                     ///< whether persons' lines are passed on
  bool log_chat = false;                ///< whether they are logged, too
  std::shared_ptr<ChunkSupply> chunks;  ///< as of PublisherConfig
  std::shared_ptr<const Palette> palette = shared_builtin_palette();  ///< as of ContentStream
  std::shared_ptr<const ContentFiles> images{};                       ///< likewise
  std::shared_ptr<const ContentFiles> models{};                       ///< likewise
  size_t net_threads = 0;  ///< that encode and send; 0: as many as the machine has cores
  WebConfig web;
  /// status.json for operators (docs/browser.md); on the network thread. Empty, or an empty text: there is
  /// none.
  std::function<std::string(const NetFigures&)> status;
  /// Likewise /metrics (docs/monitoring.md).
  std::function<std::string(const NetFigures&)> metrics;
  std::vector<IpNetwork> metrics_readers;  ///< whose programs may read it, beside those of this machine
};

class NetServer {
 public:
  /// Listens at once. `commands` must outlive the server. `keyframe` (World::keyframe()) is the world before
  /// the first tick that is published. A replay passes an empty one, because its first tick has everything.
  static Result<std::unique_ptr<NetServer>> listen(const NetConfig& config, CommandQueue& commands,
                                                   TickDelta keyframe);
  /// Calls stop().
  ~NetServer();
  NetServer(const NetServer&) = delete;
  NetServer& operator=(const NetServer&) = delete;

  uint16_t port() const;

  /// Hands a tick to the network thread; waits while limits::deltas_in_flight_max ticks wait there. It is the
  /// tick after the last one, or after the keyframe; only a replay may jump. One thread at a time. `span`:
  /// when the tick took its commands, and was done; unless told, it took no time.
  void publish(std::shared_ptr<const TickDelta> delta, const TickSpan& span = instant(steady_now_s()));

  /// Reads the files of NetConfig::access again, certificate, keys, revoked tokens, and those of the page.
  /// Sessions go on, but those whose token is revoked end. The error says what is wrong with the files; all
  /// old ones stay in force then.
  Result<void> reload();

  /// Sends a message to a session, changes its role until it ends, or ends it with a reason; nothing, where
  /// it is not there. From any thread.
  void send(uint64_t session, ServerMessage message);
  void set_role(uint64_t session, Role role);
  void kick(uint64_t session, std::string reason);
  /// The session's own store is that of this session of the simulating server; as above.
  void set_own_store(uint64_t session, uint64_t of_session);
  /// Runs a job on the network thread; after stop() perhaps not. From any thread.
  void post(std::function<void()> job);
  /// A connection that something else than a socket carries. Its address is no IP address, and it has no
  /// place at the door: who brings it bounds how many there are. On the network thread.
  void enter(std::shared_ptr<Transport> transport);

  /// Waits until the network thread has handed all published ticks to the sockets.
  void flush();

  /// As of the last tick that was sent. From any thread.
  NetStats stats() const;
  /// The latency of requests that a tick answered, since the start. From any thread.
  LatencyCounts latency() const;
  /// As of the ticks since the last call. From any thread.
  NetLoad load() const;
  /// Positions of the clients' eyes as of the last tick that was sent; metres. From any thread.
  std::vector<glm::vec3> eyes_m() const;
  /// Persons' cursors as of the last tick that was sent, by session. From any thread.
  std::vector<PlayerCursor> cursors() const;
  /// Whether any client asked for PhysicsMessages. From any thread.
  bool wants_physics() const;

  /// Tells every client that the server stops, closes, and joins the thread. A second call does nothing.
  void stop();

 private:
  struct Impl;
  explicit NetServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace scree
