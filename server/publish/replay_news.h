// What one client is told of a replay: where it stands, its events, and the cursors of the persons who were
// there. Each is told when it has changed. One thread at a time.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "proto/messages.h"
#include "server/publish/outgoing.h"
#include "server/world/tick_delta.h"

namespace scree {

class ReplayNews {
 public:
  /// Why the client may not control the replay, for PlaybackMessage; empty: it may.
  void set_control_refusal(const std::string& refusal) { control_refusal_ = refusal; }
  /// A tick of a replay. `in_full`: the pace is told, too, which alone is no news. A client that does not
  /// read along gets events and cursors when it has caught up.
  void serve(const TickDelta& delta, bool in_full, bool reads_along, Outlet& outlet, ServedPart& part);

 private:
  void send_playback(const PlaybackMessage& now, bool in_full, Outlet& outlet, ServedPart& part);

  std::string control_refusal_;
  std::optional<PlaybackMessage> playback_;  ///< as the client knows it, as the next two
  std::shared_ptr<const MarksMessage> marks_;
  std::shared_ptr<const RecordedCursorsMessage> cursors_;
};

}  // namespace scree
