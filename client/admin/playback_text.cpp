#include <array>
#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "client/admin/admin.h"

namespace scree {

std::string playback_json(const PlaybackMessage& playback) {
  const nlohmann::ordered_json json{{"moment", playback.moment},   {"first", playback.first},
                                    {"last", playback.last},       {"speed", playback.speed},
                                    {"playing", playback.playing}, {"grows", playback.grows}};
  return json.dump(2) + "\n";
}

std::string playback_lines(const PlaybackMessage& playback) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "moment %llu of %llu to %llu, %s at speed %g%s\n",
                static_cast<unsigned long long>(playback.moment),
                static_cast<unsigned long long>(playback.first),
                static_cast<unsigned long long>(playback.last), playback.playing ? "playing" : "paused",
                static_cast<double>(playback.speed), playback.grows ? ", being recorded" : "");
  return text.data();
}

std::string went_elsewhere(const ControlReplayRequest& wish, const PlaybackMessage& playback) {
  const auto first = static_cast<int64_t>(playback.first), last = static_cast<int64_t>(playback.last);
  if (wish.move != ReplayMove::to_tick || (wish.value >= first && wish.value <= last)) return {};
  return fmt::format("tick {} is not in the recording, which has the ticks {} to {}: it went to the nearest",
                     wish.value, first, last);
}

}  // namespace scree
