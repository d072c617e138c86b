// The requests of a recording, one after the other, for other programs: who asked for which change, where and
// when. Nothing is simulated, so that a line does not say whether the world carried it out. One thread at a
// time.
#pragma once

#include "server/replay/export_lines.h"

namespace scree {

/// A line for each request that reached the world, as CSV or JSON Lines: tick, time_s, at, request, session,
/// name, token, party, x_m, y_m, z_m, reach_m and text (the settings).
Result<void> export_requests(RecordingReader& recording, LineFormat format, const LineSink& write);
inline constexpr std::string_view request_csv_heads =
    "tick,time_s,at,request,session,name,token,party,x_m,y_m,z_m,reach_m,text";

}  // namespace scree
