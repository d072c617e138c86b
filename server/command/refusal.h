// Why a server says no, as a fixed set of reasons to count by. Their names stand in reports, so they stay as
// they are; the words for people are the caller's, beside the reason.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "shared/base/result.h"

namespace scree {

enum class Refusal : uint8_t {
  // The world refuses a request.
  carve_invalid,
  fill_invalid,
  paint_invalid,
  settings_invalid,
  prop_invalid,
  push_invalid,
  blast_invalid,
  body_missing,
  shape_misses,
  body_not_kept,
  piece_invalid,
  props_max,
  joint_invalid,
  joint_apart,
  joint_missing,
  joints_max,
  region_invalid,
  region_missing,
  regions_max,
  in_region,
  blast_speed,
  pieces_max,
  pieces_share,
  requests_waiting,
  falls_waiting,
  memory_max,
  terrain_unreadable,
  session_over,
  persons_fly,
  not_on_foot,
  person_body,
  walk_invalid,
  inputs_waiting,
  out_of_sight,
  dig_invalid,
  place_invalid,
  transfer_invalid,
  store_full,
  store_lacks,
  store_missing,
  stores_max,
  dig_rate,
  in_the_way,
  rules_invalid,
  restore_invalid,
  // The host's own rule refuses a request (server/host/host_hooks.h).
  host,
  // The server does not have the model that a prop names.
  model_missing,
  // The network side refuses a request.
  replay,
  edge,
  simulator_away,
  requests_per_second,
  commands_waiting,
  reach,
  no_admin_token,
  role,
  admin_invalid,
  value_unknown,
  // The network side refuses a question, or a message of them.
  query_invalid,
  query_far,
  query_later,
  query_tick,
  queries_per_second,
  queries_waiting,
  // The network side refuses an HTTP request.
  http_malformed,
  http_too_long,
  http_late,
  http_requests_per_second,
  origin_foreign,
  host_foreign,
  // A connection is closed at once.
  connects_per_second,
  connections_per_address,
  outsiders_max,
  // A session is refused or ended.
  sessions_max,
  idle_made_room,
  protocol_version,
  hello_missing,
  hello_late,
  hello_repeated,
  message_malformed,
  message_cut_short,
  messages_per_second,
  bytes_per_second,
  interest_invalid,
  ground_waiting,
  admin_token_wrong,
  token_guesses,
  tls_required,
  tls_failed,
  stream_malformed,
  token_missing,
  token_malformed,
  token_foreign,
  token_world,
  token_expired,
  token_revoked,
  kicked,
  banned,
  server_stops,
  // A session is cut off because it does not read.
  outbox_full,
  reading_stalled,
  count_
};

inline constexpr size_t refusal_reasons = static_cast<size_t>(Refusal::count_);

/// As the enumerator is written.
std::string_view name_of(Refusal reason);

/// A refusal on its way to who asked.
struct Refused {
  Refusal reason = Refusal::message_malformed;
  std::string message;  ///< names the thing, the limit and the way out
};

inline tl::unexpected<Refused> refuse(Refusal reason, std::string message) {
  return tl::unexpected<Refused>(Refused{reason, std::move(message)});
}

/// How often each reason was given.
class RefusalCounts {
 public:
  void add(Refusal reason) { ++counts_[static_cast<size_t>(reason)]; }
  uint64_t of(Refusal reason) const { return counts_[static_cast<size_t>(reason)]; }
  uint64_t total() const;

 private:
  std::array<uint64_t, refusal_reasons> counts_{};
};

}  // namespace scree
