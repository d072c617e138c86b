// The network thread's side of NetServer: every session, and the publisher that serves them. Used by
// net_server.cpp only (Asio). Runs on the network thread; stats() and the counters are for any thread.
//
// Within publish() the workers compose messages and hand them to the sockets, while the network thread takes
// part and waits. They ask sessions for their backlog() and let them send_now(), each session on one of them
// at a time, and change nothing else: whatever ends a session, counts or logs comes before or after, on the
// network thread.
#pragma once

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/steady_timer.hpp>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <spdlog/common.h>

#include "server/doors/bans.h"
#include "server/doors/entrance.h"
#include "server/doors/parties.h"
#include "server/doors/tickets.h"
#include "server/net/client_session.h"
#include "server/net/departures.h"
#include "server/net/flush_rate.h"
#include "server/net/net_server.h"
#include "server/net/request_times.h"
#include "server/net/talk.h"
#include "server/web/http_connection.h"
#include "server/web/site.h"
#include "shared/base/log_limit.h"
#include "shared/base/thread_check.h"

namespace scree {

class NetHost final : public SessionHost, public EntranceHost, public HttpHost {
 public:
  NetHost(const NetConfig& config, CommandQueue& commands);
  ~NetHost() override = default;

  /// Call before the thread runs.
  Result<void> listen();
  /// A connection that something else than a socket carries, as if it had come in by the entrance. False: it
  /// was turned away.
  bool enter(std::shared_ptr<Transport> transport);
  uint16_t port() const { return entrance_.port(); }
  /// The network thread: returns after shut_down().
  void run();

  // ---- on the network thread
  /// `more`: the next tick waits already; then this one's messages may go together with that one's.
  void publish(const TickDelta& delta, const TickSpan& span, bool more);
  /// From now on; sessions whose token was revoked end.
  void take_access(std::shared_ptr<const Access> access);
  /// Of the page, from now on.
  void take_files(std::shared_ptr<const WebFiles> files);
  /// Hands all that is queued to the sockets.
  void flush();
  void shut_down();

  asio::io_context& context() { return context_; }
  NetStats stats() const;
  LatencyCounts latency() const;
  std::vector<glm::vec3> eyes_m() const;
  std::vector<PlayerCursor> cursors() const;
  bool is_watched() const { return watched_; }

 private:
  struct Entry {
    std::shared_ptr<ClientSession> session;
    RateLimit requests;
    std::string name{};  ///< the person's
    Grant grant{};       ///< of a joined session
    std::string program{};
    double joined_s = 0.0;
    uint64_t party = 0;      ///< as of Command; 0: an administrator, in none of Parties
    bool relayed = false;    ///< by a proxy: not from where its address says
    bool unflushed = false;  ///< in unflushed_
  };

  tl::expected<WelcomeMessage, Refused> admit(ClientSession& session, const HelloMessage& hello) override;
  tl::expected<void, Refused> receive(ClientSession& session, const ClientMessage& message) override;
  void refused(ClientSession& session, const Refused& refused) override;
  void closed(ClientSession& session, const std::string& reason) override;
  void entered(asio::ip::tcp::socket socket, const std::string& address) override;
  void turned_away(const std::string& peer, const Refused& refused) override;
  void accepting_failed(const std::string& why) override;

  void begin(std::shared_ptr<Transport> transport, const std::string& address);
  void begin_session(std::shared_ptr<Transport> transport, const std::string& address, uint64_t id,
                     bool relayed = false);
  void bound_outsiders();
  static double burst_of(double requests_per_second);
  void close_oldest_outsider(const std::string& why);
  static Result<float> granted_radius(glm::vec3 eye_m, float radius_m);
  /// A line of the log, of a kind of which there are few a second.
  void say(spdlog::level::level_enum level, std::string_view kind, const std::string& line);
  void note(Event event) const;
  void tick_timer();
  tl::expected<void, Refused> follow(ClientSession& session, const InterestMessage& interest);
  /// Whether it is on its way to the world; else it is refused.
  bool request(ClientSession& session, const Command& command);
  void log_settings(const TickDelta& delta);
  std::shared_ptr<ClientSession> queue(Outgoing&& outgoing);
  void answer(const TickDelta& delta, const TickSpan& span);
  tl::expected<void, Refused> administer(ClientSession& session, const AdminMessage& message);
  void skip(ClientSession& session, const UnknownMessage& unknown);
  void refuse_request(ClientSession& session, uint32_t request, const Refused& refused);
  void grant(const ServiceLimits& service);
  void fit_descriptors();
  void flush_some(Tick tick, bool more);
  void flush(size_t count);
  void flush_later();

  // ---- who joins, or goes on after a lost connection (net_host_join.cpp)
  std::optional<Departed> resume(const std::string& ticket, const Grant& grant);
  tl::expected<void, Refused> find_room(const ClientSession& newcomer, const Grant& grant, bool has_place);
  bool make_room(const ClientSession& newcomer, const Grant& grant);
  Entry& enter(ClientSession& session, uint64_t id);
  void remember(const ClientSession& session);

  // ---- who may come in and do what (net_host_access.cpp)
  Result<void> open_access();
  /// `address`: as of Door.
  tl::expected<void, Refused> check_admin_token(const std::string& address, const std::string& token);
  tl::expected<Grant, Refused> grant_to(const ClientSession& session, const HelloMessage& hello);
  void end_lapsed_grants();
  uint64_t join_party(const ClientSession& session, const Grant& grant, uint64_t before);
  tl::expected<void, Refused> may(const ClientSession& session, Role needed) const;
  /// Without an admin's token beside the request.
  tl::expected<void, Refused> may_administer(const ClientSession& session, bool is_control);
  void ask(ClientSession& session, const Command& command);
  void administer_sessions(ClientSession& session, const AdminMessage& message);
  std::vector<SessionRow> session_rows() const;
  std::vector<BanRow> ban_rows() const;
  Result<void> kick(const KickRequest& kick);
  Result<void> ban(const BanRequest& ban);
  Result<void> lift(const LiftBanRequest& lift);

  // ---- connections that speak HTTP (net_host_web.cpp)
  Result<void> open_site();
  void begin_http(uint64_t id, std::shared_ptr<Transport> stream, std::span<const uint8_t> arrived);
  HttpResponse answer(const HttpConnection& from, const HttpRequest& request) override;
  void answered(const HttpResponse& response, size_t bytes) override;
  void opened_websocket(HttpConnection& from, std::shared_ptr<Transport> stream,
                        std::span<const uint8_t> arrived) override;
  void cut_off(const HttpConnection& connection, Refusal reason) override;
  void ended(HttpConnection& connection) override;
  HttpResponse status_json(const HttpConnection& from, const HttpRequest& request);
  tl::expected<void, Refused> may_see_status(const HttpConnection& from, const HttpRequest& request);
  void check_http(double now_s);

  // ---- what persons are told of each other (net_host_talk.cpp)
  void tell_persons(double now_s);
  void hear(ClientSession& speaker, const SayMessage& said);

  uint32_t joined_count() const;
  void update_stats();

  const NetConfig config_;
  ServiceLimits service_;  ///< as they stand
  CommandQueue& commands_;
  Departures departures_;
  asio::io_context context_;
  Entrance entrance_;
  asio::steady_timer timer_;
  LogLimit log_;
  bool stopping_ = false;
  double stop_deadline_s_ = 0.0;
  uint64_t next_session_;  ///< 0 is the server itself
  std::map<uint64_t, Entry> sessions_;
  struct Unflushed {
    std::shared_ptr<ClientSession> session;
    Tick since = 0;
  };
  std::vector<Unflushed> unflushed_;  ///< have messages that are only queued; once each, by since
  FlushRate flush_rate_;
  asio::steady_timer flush_timer_;
  std::set<uint64_t> outsiders_;                  ///< sessions that have not joined, or were refused
  size_t outsiders_max_ = limits::outsiders_max;  ///< they and the next
  std::map<uint64_t, std::shared_ptr<HttpConnection>> http_;  ///< by numbers as of sessions
  std::unique_ptr<Site> site_;                                ///< null: HTTP is not spoken
  size_t descriptors_ = 0;                                    ///< for connections
  std::shared_ptr<const Access> access_;
  Bans bans_;
  Parties parties_;
  Tickets tickets_;
  const uint64_t world_;  ///< WelcomeMessage::world
  Workers workers_;
  Publisher publisher_;
  RequestTimes request_times_;
  Talk talk_;
  /// Lines for the log, by session and request, of settings that the world has not answered yet.
  std::map<std::pair<uint64_t, uint32_t>, std::string> settings_asked_;
  std::atomic<bool> watched_{false};
  ThreadCheck network_thread_;
  NetStats counts_;
  mutable std::mutex stats_mutex_;
  NetStats stats_;                            ///< guarded by stats_mutex_
  LatencyCounts latency_;                     ///< guarded by stats_mutex_
  std::vector<glm::vec3> eyes_m_;             ///< guarded by stats_mutex_
  std::map<uint64_t, PlayerCursor> cursors_;  ///< guarded by stats_mutex_
};

}  // namespace scree
