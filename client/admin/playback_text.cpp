#include <array>
#include <cstdio>
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

}  // namespace scree
