#include "server/command/refusal.h"

#include <numeric>

#include "shared/base/check.h"

namespace scree {

namespace {

struct Row {
  Refusal reason;
  std::string_view name;
};

/// In the order of the enumeration.
constexpr Row rows[] = {
    {Refusal::carve_invalid, "carve_invalid"},
    {Refusal::fill_invalid, "fill_invalid"},
    {Refusal::paint_invalid, "paint_invalid"},
    {Refusal::settings_invalid, "settings_invalid"},
    {Refusal::prop_invalid, "prop_invalid"},
    {Refusal::push_invalid, "push_invalid"},
    {Refusal::blast_invalid, "blast_invalid"},
    {Refusal::body_missing, "body_missing"},
    {Refusal::shape_misses, "shape_misses"},
    {Refusal::body_not_kept, "body_not_kept"},
    {Refusal::piece_invalid, "piece_invalid"},
    {Refusal::props_max, "props_max"},
    {Refusal::joint_invalid, "joint_invalid"},
    {Refusal::joint_apart, "joint_apart"},
    {Refusal::joint_missing, "joint_missing"},
    {Refusal::joints_max, "joints_max"},
    {Refusal::region_invalid, "region_invalid"},
    {Refusal::region_missing, "region_missing"},
    {Refusal::regions_max, "regions_max"},
    {Refusal::in_region, "in_region"},
    {Refusal::blast_speed, "blast_speed"},
    {Refusal::pieces_max, "pieces_max"},
    {Refusal::pieces_share, "pieces_share"},
    {Refusal::requests_waiting, "requests_waiting"},
    {Refusal::falls_waiting, "falls_waiting"},
    {Refusal::memory_max, "memory_max"},
    {Refusal::terrain_unreadable, "terrain_unreadable"},
    {Refusal::session_over, "session_over"},
    {Refusal::persons_fly, "persons_fly"},
    {Refusal::not_on_foot, "not_on_foot"},
    {Refusal::person_body, "person_body"},
    {Refusal::walk_invalid, "walk_invalid"},
    {Refusal::inputs_waiting, "inputs_waiting"},
    {Refusal::out_of_sight, "out_of_sight"},
    {Refusal::dig_invalid, "dig_invalid"},
    {Refusal::place_invalid, "place_invalid"},
    {Refusal::transfer_invalid, "transfer_invalid"},
    {Refusal::store_full, "store_full"},
    {Refusal::store_lacks, "store_lacks"},
    {Refusal::store_missing, "store_missing"},
    {Refusal::stores_max, "stores_max"},
    {Refusal::dig_rate, "dig_rate"},
    {Refusal::in_the_way, "in_the_way"},
    {Refusal::rules_invalid, "rules_invalid"},
    {Refusal::restore_invalid, "restore_invalid"},
    {Refusal::host, "host"},
    {Refusal::model_missing, "model_missing"},
    {Refusal::replay, "replay"},
    {Refusal::edge, "edge"},
    {Refusal::simulator_away, "simulator_away"},
    {Refusal::requests_per_second, "requests_per_second"},
    {Refusal::commands_waiting, "commands_waiting"},
    {Refusal::reach, "reach"},
    {Refusal::no_admin_token, "no_admin_token"},
    {Refusal::role, "role"},
    {Refusal::admin_invalid, "admin_invalid"},
    {Refusal::value_unknown, "value_unknown"},
    {Refusal::query_invalid, "query_invalid"},
    {Refusal::query_far, "query_far"},
    {Refusal::query_later, "query_later"},
    {Refusal::query_tick, "query_tick"},
    {Refusal::queries_per_second, "queries_per_second"},
    {Refusal::queries_waiting, "queries_waiting"},
    {Refusal::http_malformed, "http_malformed"},
    {Refusal::http_too_long, "http_too_long"},
    {Refusal::http_late, "http_late"},
    {Refusal::http_requests_per_second, "http_requests_per_second"},
    {Refusal::origin_foreign, "origin_foreign"},
    {Refusal::host_foreign, "host_foreign"},
    {Refusal::connects_per_second, "connects_per_second"},
    {Refusal::connections_per_address, "connections_per_address"},
    {Refusal::outsiders_max, "outsiders_max"},
    {Refusal::sessions_max, "sessions_max"},
    {Refusal::idle_made_room, "idle_made_room"},
    {Refusal::protocol_version, "protocol_version"},
    {Refusal::hello_missing, "hello_missing"},
    {Refusal::hello_late, "hello_late"},
    {Refusal::hello_repeated, "hello_repeated"},
    {Refusal::message_malformed, "message_malformed"},
    {Refusal::message_cut_short, "message_cut_short"},
    {Refusal::messages_per_second, "messages_per_second"},
    {Refusal::bytes_per_second, "bytes_per_second"},
    {Refusal::interest_invalid, "interest_invalid"},
    {Refusal::ground_waiting, "ground_waiting"},
    {Refusal::admin_token_wrong, "admin_token_wrong"},
    {Refusal::token_guesses, "token_guesses"},
    {Refusal::tls_required, "tls_required"},
    {Refusal::tls_failed, "tls_failed"},
    {Refusal::stream_malformed, "stream_malformed"},
    {Refusal::token_missing, "token_missing"},
    {Refusal::token_malformed, "token_malformed"},
    {Refusal::token_foreign, "token_foreign"},
    {Refusal::token_world, "token_world"},
    {Refusal::token_expired, "token_expired"},
    {Refusal::token_revoked, "token_revoked"},
    {Refusal::kicked, "kicked"},
    {Refusal::banned, "banned"},
    {Refusal::server_stops, "server_stops"},
    {Refusal::outbox_full, "outbox_full"},
    {Refusal::reading_stalled, "reading_stalled"},
};

constexpr bool in_order() {
  for (size_t i = 0; i < std::size(rows); ++i)
    if (rows[i].reason != static_cast<Refusal>(i)) return false;
  return std::size(rows) == refusal_reasons;
}
static_assert(in_order(), "every reason has a name, in the order of the enumeration");

}  // namespace

std::string_view name_of(Refusal reason) {
  CHECK(static_cast<size_t>(reason) < refusal_reasons);
  return rows[static_cast<size_t>(reason)].name;
}

uint64_t RefusalCounts::total() const {
  return std::accumulate(counts_.begin(), counts_.end(), uint64_t{0});
}

}  // namespace scree
