// The administrators' requests: settings, sessions, bans, the control of a replay. On the network thread.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "proto/messages.h"
#include "server/doors/authorizer.h"
#include "server/doors/tickets.h"
#include "server/net/host_records.h"
#include "server/net/requests.h"
#include "server/net/session_table.h"
#include "server/publish/publisher.h"
#include "server/world/tick_delta.h"

namespace scree {

class Administration {
 public:
  using Control = std::function<Result<void>(const ControlReplayRequest&)>;
  using ControlRules = std::function<void(uint64_t session, uint32_t request, const ControlRulesRequest&)>;

  using AskHistory =
      std::function<void(uint64_t session, uint32_t request, const HistoryAct&, const std::string& who)>;

  /// All arguments but the functions, which are as of NetConfig, must outlive this object.
  /// `counts`: requests are counted there.
  Administration(SessionTable& sessions, Requests& requests, Authorizer& authorizer, Tickets& tickets,
                 NetStats& counts, Control control, ControlRules control_rules, AskHistory ask_history,
                 const Publisher& publisher)
      : sessions_(sessions),
        requests_(requests),
        authorizer_(authorizer),
        tickets_(tickets),
        counts_(counts),
        control_(std::move(control)),
        control_rules_(std::move(control_rules)),
        ask_history_(std::move(ask_history)),
        publisher_(publisher) {}

  /// From now on.
  void set_reports(FlightReports flight, HostRecords records) {
    flight_ = std::move(flight);
    records_ = std::move(records);
  }
  /// Handles a request. The error is a wrong admin token's, and ends the session.
  tl::expected<void, Refused> administer(ClientSession& session, const AdminMessage& message);
  /// A request is on its way to the world. One that changes regions is noted once a tick has carried it out.
  void note_asked(const ClientSession& session, uint32_t request, const Request& body);
  /// Notes those that this tick carried out.
  void note_done(const TickDelta& delta);
  /// The host answers later than a tick; an undo is noted once it has begun.
  void note_answered(uint64_t session, const ServerMessage& answer);
  /// Takes what was changed in the file of bans by hand, and ends the sessions that it refuses.
  void read_bans_again();

 private:
  void note_later(const ClientSession& session, uint32_t request, std::string act);
  void set(ClientSession& session, uint32_t request, SettingsRequest asked);
  /// A spawn that is "here", or "here SESSION", as the place of that person's eye.
  Result<void> find_here(const ClientSession& session, SettingsRequest& asked) const;
  /// The person of that number; of none: the only one at the address of the session.
  Result<const PlayerCursor*> person_at(const ClientSession& session, const std::string& number) const;
  void act(ClientSession& session, const AdminMessage& message);
  std::vector<BanRow> ban_rows() const;
  AdminListMessage flight(const ListFlightRequest& request) const;
  AdminListMessage lines(const ListLinesRequest& request) const;
  Result<void> kick(const KickRequest& kick, const std::string& author);
  Result<void> ban(const BanRequest& ban, const std::string& author);
  Result<void> lift(const LiftBanRequest& lift, const std::string& author);
  /// Into the log, as a line about a session if it is one's, and for who keeps what administrators do.
  void note(const std::string& author, const std::string& act, uint64_t about = 0) const;
  /// Ends the sessions that are banned, administrators' excepted.
  void end_banned();
  /// Who acts, for the log: the session, the person's name, the access token, the address.
  std::string author_of(const ClientSession& session) const;
  /// The IP address of a session, which may have lost its connection.
  Result<std::string> ip_of(uint64_t session) const;

  SessionTable& sessions_;
  Requests& requests_;
  Authorizer& authorizer_;
  Tickets& tickets_;
  NetStats& counts_;
  const Control control_;
  const ControlRules control_rules_;
  const AskHistory ask_history_;
  FlightReports flight_;
  HostRecords records_;
  const Publisher& publisher_;  ///< has the cursors of the persons who are there
  struct Asked {
    std::string author, act;
  };
  /// By session and request: what the world has not answered yet.
  std::map<std::pair<uint64_t, uint32_t>, Asked> asked_;
};

}  // namespace scree
