// A session without a canvas, for Node: mirrors a server's world, strikes it, and says what its mirror holds.
// Bytes come and go by the socket's functions of client/web/bridge.h.
#include <cinttypes>
#include <cstdio>
#include <memory>

#include "client/viewer/session/viewer_session.h"
#include "client/web/socket_bridge.h"
#include "shared/base/timing.h"

namespace scree {
namespace {

std::unique_ptr<ViewerSession>& session() {
  static std::unique_ptr<ViewerSession> only;
  return only;
}

Camera& camera() {
  static Camera only;
  return only;
}

}  // namespace
}  // namespace scree

using namespace scree;

extern "C" {

void session_begin(float x, float y, float z, float interest_radius_m, int predict) {
  camera().eye_m = {x, y, z};
  SessionChoice choice;
  choice.interest_radius_m = interest_radius_m;
  choice.program = "scree-web test";
  choice.apply_s = 0.008;
  session() =
      std::make_unique<ViewerSession>(std::make_unique<SocketConnector>(page_socket(), "the server"), choice);
  session()->predict(predict != 0);
}

void session_step() {
  session()->step(steady_now_s(), camera());
}

/// A carve of that radius and so many seeds below the place.
void session_strike(float x, float y, float z, float radius_m, int seeds) {
  Tool tool;
  tool.use = ToolUse::carve;
  tool.radius_m = radius_m;
  tool.seeds = static_cast<uint32_t>(seeds);
  session()->strike(tool, {x, y, z}, {0.0F, -1.0F, 0.0F}, steady_now_s());
}

const char* session_report() {
  static char text[640];
  const Mirror* mirror = session()->mirror();
  if (mirror == nullptr || !mirror->status()) {
    std::snprintf(text, sizeof text, "{\"text\":\"%s\"}", session()->description().c_str());
    return text;
  }
  const MirrorCounters& counters = mirror->counters();
  std::snprintf(text, sizeof text,
                "{\"joined\":%s,\"field_hash\":\"%016" PRIx64 "\",\"server_hash\":\"%016" PRIx64
                "\",\"tick\":%" PRIu64 ",\"server_tick\":%" PRIu64
                ",\"server_pieces\":%u,\"pieces\":%zu"
                ",\"pieces_made\":%" PRIu64 ",\"pieces_merged\":%" PRIu64 ",\"checks\":%" PRIu64
                ",\"mismatches\":%" PRIu64 ",\"predictions\":%zu,\"apply_worst_ms\":%.2f,\"notice\":\"%s\"}",
                session()->joined(steady_now_s()) ? "true" : "false", mirror->field().hash(),
                mirror->status()->field_hash, mirror->tick(), mirror->status()->tick,
                mirror->status()->pieces, mirror->pieces().size(), counters.pieces_made,
                counters.pieces_merged, counters.checks, counters.mismatches, session()->predictions(),
                session()->apply_worst_ms(), session()->notice(steady_now_s()).c_str());
  return text;
}

}  // extern "C"
