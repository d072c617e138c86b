// Events as lines of text: JSON Lines (jsonlines.org) and CSV (RFC 4180). Pure functions.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "proto/event.h"

namespace scree {

/// How ticks become seconds, and what is known of the event's tick beside it.
struct EventContext {
  uint32_t tick_rate_hz = 60;
  std::optional<float> tick_ms{};  ///< that the tick's simulation took: the event's cost
  uint64_t unix_ms = 0;            ///< when it happened, ms since 1970; 0: it is not known
  Participant who{};               ///< the event's session
};

/// A line without its end: an object with event, tick, time_s, and what else is known of at (ISO 8601, UTC),
/// x_m, y_m, z_m, volume_m3, pieces, session, name, token (the id of the access token), ms and text. What
/// tells of bodies also has some of body, other, tag, normal, impulse_n_s, energy_j and left_out.
std::string json_line(const Event& event, const EventContext& context);

/// A field of a line of CSV, in quotes where it needs them.
std::string csv_field(const std::string& text);

/// A line without its end; fields that the event has not are empty.
std::string csv_line(const Event& event, const EventContext& context);
inline constexpr std::string_view event_csv_heads =
    "tick,time_s,event,x_m,y_m,z_m,volume_m3,pieces,session,ms,text,at,name,token,"
    "body,other,tag,normal_x,normal_y,normal_z,impulse_n_s,energy_j,left_out";

}  // namespace scree
