// What administrators ask of a world's history in words, as message_words.h.
#pragma once

#include <fmt/format.h>
#include <optional>
#include <string>
#include <vector>

#include "proto/history_message.h"

namespace scree {

inline std::string place_words(const std::optional<glm::vec3>& at_m) {
  return at_m ? fmt::format("({}, {}, {})", at_m->x, at_m->y, at_m->z) : "everywhere";
}

inline std::vector<std::string> history_words(const HistoryRequest& h) {
  return {fmt::format("list history: {}, radius {} m, by '{}', since {} s, {}", place_words(h.at_m),
                      h.radius_m, h.by, h.since_s, h.as_json ? "JSON" : "lines")};
}

inline std::vector<std::string> undo_words(const UndoRequest& u) {
  return {fmt::format("undo: {}, by '{}', since {} s, to tick {}, {} to {}, {}, shown to session {}",
                      name_of(u.mode), u.by, u.since_s, u.to_tick, place_words(u.lo_m), place_words(u.hi_m),
                      u.as_json ? "JSON" : "lines", u.show_session)};
}

}  // namespace scree
