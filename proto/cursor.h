// Where persons are and what they aim at: as messages of the wire, and as recordings keep it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "shared/base/ids.h"

namespace scree {

// ---- client to server

/// A person's eye and aim, shown to others.
struct CursorMessage {
  glm::vec3 eye_m{0.0F};
  glm::vec3 aim_m{0.0F};
};

// ---- server to client

struct PlayerCursor {
  uint64_t session = 0;
  std::string name;
  glm::vec3 eye_m{0.0F};
  glm::vec3 aim_m{0.0F};

  bool operator==(const PlayerCursor&) const = default;
};

/// The cursors of all other persons within interest.
struct CursorsMessage {
  std::vector<PlayerCursor> cursors;
};

/// In a replay: the cursors of the persons who were there at its moment, wherever they were. The sessions are
/// those of the recorded server.
struct RecordedCursorsMessage {
  std::vector<PlayerCursor> cursors;

  bool operator==(const RecordedCursorsMessage&) const = default;
};

// ---- in a recording

/// What changed of the cursors of persons at a tick.
struct CursorSample {
  Tick tick = 0;
  std::vector<PlayerCursor> moved{};  ///< by session, ascending: new ones, too
  std::vector<uint64_t> gone{};       ///< sessions, ascending

  bool operator==(const CursorSample&) const = default;
};

}  // namespace scree
