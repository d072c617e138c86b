// What administrators ask for, and the lists that answer it (proto/access.proto).
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "proto/admin_rows.h"
#include "proto/body_list.h"
#include "proto/flight_rows.h"
#include "proto/game_message.h"
#include "proto/history_message.h"
#include "proto/joint_message.h"
#include "proto/lines_message.h"
#include "proto/playback_state.h"
#include "proto/region_message.h"
#include "shared/operation/request.h"
#include "shared/operation/store.h"

namespace scree {

/// Requests of an administrator; a director may list bodies, joints, stores and masses, too. SettingsRequest
/// changes all its settings, or none.
struct ListSessionsRequest {};
struct KickRequest {
  uint64_t session = 0;
  std::string reason;  ///< told to who is sent away; may be empty
};
/// An address, or that of a session; the sessions from there end.
struct BanRequest {
  uint64_t session = 0;  ///< 0: the address says who
  std::string address;   ///< numeric, IPv4 or IPv6
  uint32_t minutes = 0;  ///< 0: until it is lifted
  std::string reason;
};
struct ListBansRequest {};
struct LiftBanRequest {
  std::string address;
};
struct ListStoresRequest {};
using AdminRequest =
    std::variant<SettingsRequest, ListSessionsRequest, KickRequest, BanRequest, ListBansRequest,
                 LiftBanRequest, ControlReplayRequest, ListBodiesRequest, ListJointsRequest,
                 ListStoresRequest, ListRegionMassesRequest, ControlRulesRequest, HistoryRequest, UndoRequest,
                 ListFlightRequest, ListLinesRequest>;

/// Answered with a reply; what lists something, with an AdminListMessage.
struct AdminMessage {
  uint32_t request = 0;
  std::string token;  ///< equal to the server's, or empty where the session's role is admin
  AdminRequest act;
};

/// The answer to a request that lists something.
struct AdminListMessage {
  uint32_t request = 0;
  std::vector<SessionRow> sessions{};
  std::vector<BanRow> bans{};
  std::vector<BodyRow> bodies{};            ///< ordered by id, at most limits::admin_rows_max
  std::vector<KnownJoint> joints{};         ///< likewise
  uint32_t left_out = 0;                    ///< rows of the lists before and after this that would be more
  std::vector<StoreContent> stores{};       ///< in order, at most limits::stores_a_message
  std::vector<RegionMass> region_masses{};  ///< by origin and material, at most limits::admin_rows_max
  std::string text{};                       ///< lines for people, at most limits::admin_text_bytes_max
  std::vector<SlowTickRow> slow_ticks{};    ///< the oldest first, at most limits::slow_rows_max
  std::vector<PartyRow> parties{};          ///< at most limits::admin_rows_max
};

}  // namespace scree
