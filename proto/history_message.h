// What administrators ask of a server's memory of its world: who edited it, and to take that back. Plain
// values.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "shared/base/ids.h"
#include "shared/base/kind_table.h"

namespace scree {

/// The edits, the newest first; answered with text.
struct HistoryRequest {
  std::optional<glm::vec3> at_m{};  ///< near that place; nothing: everywhere
  float radius_m = 0.0F;
  std::string
      by{};  ///< whose: a name, "session:17", "token:ID", "address:HASH" or "undo:3"; empty: everybody's
  uint32_t since_s = 0;  ///< of the last so many seconds; 0: all
  bool as_json = false;
};

/// The number of each is that on the wire.
enum class UndoMode : uint8_t { preview, refuse_conflicts, keep_others, over_others, stop, progress };

struct UndoModeRow {
  UndoMode mode{};
  std::string_view name;
};
constexpr UndoModeRow row_of(UndoMode mode) {
  switch (mode) {
    case UndoMode::preview:
      return {mode, "preview"};
    case UndoMode::refuse_conflicts:
      return {mode, "refuse_conflicts"};
    case UndoMode::keep_others:
      return {mode, "keep_others"};
    case UndoMode::over_others:
      return {mode, "over_others"};
    case UndoMode::stop:
      return {mode, "stop"};
    case UndoMode::progress:
      return {mode, "progress"};
  }
  return {};
}

/// Takes back edits: bricks become what they were, pieces of these edits go. Answered with text once it
/// begins.
struct UndoRequest {
  UndoMode mode = UndoMode::preview;
  std::string by{};      ///< as of HistoryRequest; empty: everybody's, and then to_tick says since when
  uint32_t since_s = 0;  ///< edits of the last so many seconds; 0: all, or since to_tick
  Tick to_tick = 0;      ///< the terrain after that tick; 0: since_s says it
  /// Corners of a box; only bricks that meet it.
  std::optional<glm::vec3> lo_m{}, hi_m{};
  bool as_json = false;
  uint64_t show_session = 0;  ///< of a preview: on whose screen the places are marked; 0: on nobody's
};

using HistoryAct = std::variant<HistoryRequest, UndoRequest>;

}  // namespace scree
