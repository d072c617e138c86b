// The network thread's side of NetServer: it puts the parts below together, and says in which order they
// learn of a connection, a message and a tick. Used by net_server.cpp only (Asio). Runs on the network
// thread; figures() is for any thread.
//
// The parts are Arrivals (who comes in), SessionTable (who is connected), Authorizer (who may do what), Room
// (how many there may be) and Returns (who may come back). Requests has commands and their answers,
// Administration the acts of administrators, WebConnections HTTP, and Talk the lines of persons. Publisher
// decides what each client is sent, FlushQueue when, and HostFigures counts.
//
// Within publish() the workers compose messages and hand them to the sockets, while the network thread takes
// part and waits. They ask sessions for their backlog() and let them send_now(), each session on one of them
// at a time, and change nothing else: whatever ends a session, counts or logs comes before or after, on the
// network thread.
#pragma once

#include <asio/io_context.hpp>
#include <asio/steady_timer.hpp>
#include <memory>
#include <optional>

#include "server/doors/authorizer.h"
#include "server/doors/bytes_out.h"
#include "server/doors/door.h"
#include "server/net/administration.h"
#include "server/net/arrivals.h"
#include "server/net/client_session.h"
#include "server/net/flush_queue.h"
#include "server/net/ground_pace.h"
#include "server/net/host_figures.h"
#include "server/net/host_log.h"
#include "server/net/message_counts.h"
#include "server/net/net_server.h"
#include "server/net/requests.h"
#include "server/net/returns.h"
#include "server/net/room.h"
#include "server/net/session_table.h"
#include "server/net/talk.h"
#include "server/net/web_connections.h"
#include "shared/base/thread_check.h"

namespace scree {

class NetHost final : public SessionHost, public WebHost {
 public:
  NetHost(const NetConfig& config, CommandQueue& commands);
  ~NetHost() override = default;

  /// Call before the thread runs.
  Result<void> listen();
  /// A connection that something else than a socket carries, as if it had come in by the entrance. False: it
  /// was turned away.
  bool enter(std::shared_ptr<Transport> transport) { return arrivals_.enter(std::move(transport)); }
  /// The same as of NetServer::enter().
  void enter_apart(std::shared_ptr<Transport> transport) { arrivals_.enter_apart(std::move(transport)); }
  uint16_t port() const { return arrivals_.port(); }
  /// The network thread: returns after shut_down().
  void run();

  // ---- on the network thread
  /// Takes the world before the first tick. Called once, before anybody joins.
  void begin(const TickDelta& keyframe);
  /// `more`: the next tick waits already; then this one's messages may go together with that one's.
  void publish(const TickDelta& delta, const TickSpan& span, bool more);
  /// From now on; sessions whose token was revoked end.
  void set_access(std::shared_ptr<const Access> access);
  /// The files of the page, from now on.
  void set_files(std::shared_ptr<const WebFiles> files);
  /// As of NetServer.
  void send(uint64_t session, const ServerMessage& message);
  void set_role(uint64_t session, Role role);
  void kick(uint64_t session, const std::string& reason);
  void set_own_store(uint64_t session, uint64_t of_session);
  /// Hands all that is queued to the sockets.
  void flush() { flush_queue_.send_all(); }
  void shut_down();

  asio::io_context& context() { return context_; }
  const HostFigures& figures() const { return figures_; }

 private:
  // ---- SessionHost
  tl::expected<WelcomeMessage, Refused> admit(ClientSession& session, const HelloMessage& hello) override;
  tl::expected<void, Refused> receive(ClientSession& session, const ClientMessage& message) override;
  void refused(ClientSession& session, const Refused& refused) override;
  void closed(ClientSession& session, const std::string& reason) override;
  void count_out(std::span<const uint8_t> bytes) override { messages_.add_out(bytes); }
  void count_in(std::span<const uint8_t> body) override { messages_.add_in(body); }
  // ---- WebHost
  void begin_websocket(std::shared_ptr<Transport> stream, const Visitor& from, uint64_t id) override {
    arrivals_.begin_session(std::move(stream), from, id);
  }
  NetFigures status_figures() override;
  HealthMessage health() override;  ///< of SessionHost, too
  void web_changed() override { update_stats(); }

  tl::expected<void, Refused> find_room(const ClientSession& newcomer, const Grant& grant,
                                        const std::optional<Departed>& before, double now_s);
  tl::expected<void, Refused> ask(ClientSession& session, uint32_t request, const Request& body);
  void join(ClientSession& session, const HelloMessage& hello, float radius_m, const Grant& grant,
            const std::optional<Departed>& before);
  tl::expected<void, Refused> follow(ClientSession& session, const InterestMessage& interest);
  tl::expected<void, Refused> skip(ClientSession& session, const UnknownMessage& unknown);
  tl::expected<void, Refused> carry_out(ClientSession& session, const ClientMessage& message);
  /// What an edge hands on; nothing: the message is this server's.
  std::optional<tl::expected<void, Refused>> hand_on(ClientSession& session, const ClientMessage& message);
  void forget(uint64_t session);

  void tick_timer();
  void check_time();
  void share_bytes_out();
  void grant(const ServiceLimits& service);
  void queue_frames(const TickDelta& delta, double done_s);
  void stream_ground();
  Backlog backlog_of(uint64_t session) const;
  void answer(const TickDelta& delta, const TickSpan& span);
  /// Tells who listens that a person came or went.
  void note(EventKind kind, const SessionEntry& entry, std::optional<glm::vec3> place_m = {}) const {
    const uint64_t session = entry.session->id(), token = entry.grant.token_id;
    if (config_.noted) config_.noted({kind, 0, place_m, 0.0F, 0, session, 0.0F, entry.name, token});
  }
  void update_stats();

  const NetConfig config_;
  ServiceLimits service_;  ///< as they stand
  const uint64_t world_;   ///< WelcomeMessage::world
  HostFigures figures_;
  MessageCounts messages_;
  HostLog log_;
  asio::io_context context_;
  Door door_;
  BytesOut bytes_out_;
  Authorizer authorizer_;
  SessionTable sessions_;
  Room room_;
  Requests requests_;
  Returns returns_;
  Administration administration_;
  WebConnections web_;
  Arrivals arrivals_;
  Talk talk_;
  Workers workers_;
  Publisher publisher_;
  FlushQueue flush_queue_;
  GroundPace ground_pace_;
  asio::steady_timer timer_;
  bool stopping_ = false;
  double stop_deadline_s_ = 0.0;
  ThreadCheck network_thread_;
};

}  // namespace scree
