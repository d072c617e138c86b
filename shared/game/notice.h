// Notices: what a host's rules tell once, to persons or to their programs. Plain values; one that comes from
// outside is untrusted until validate() has passed it. Metres.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <variant>
#include <vector>

#include "shared/base/result.h"
#include "shared/game/audience.h"
#include "shared/game/limits.h"
#include "shared/material/material.h"

namespace scree {

/// Sounds and particles that every client can make. The numbers are those on the wire and in files.
enum class CueKind : uint8_t { thud, crack, ring, rattle, dust, sparks };

struct CueKindRow {
  std::string_view name;
  bool sounds = false;  ///< else it is seen
};

constexpr CueKindRow row_of(CueKind kind) {
  switch (kind) {
    case CueKind::thud:
      return {"thud", true};
    case CueKind::crack:
      return {"crack", true};
    case CueKind::ring:
      return {"ring", true};
    case CueKind::rattle:
      return {"rattle", true};
    case CueKind::dust:
      return {"dust"};
    case CueKind::sparks:
      return {"sparks"};
  }
  return {};
}

/// A sound or a puff at a place.
struct Cue {
  CueKind kind = CueKind::thud;
  glm::vec3 place_m{0.0F};
  float size_m = 1.0F;       ///< across, of what sounds, or of the puff
  float energy_j = 1000.0F;  ///< how loud, or how much
  Material material{material::rock};

  bool operator==(const Cue&) const = default;
};

/// A line of text, as persons say them, from the server.
struct NoticeLine {
  std::string text;

  bool operator==(const NoticeLine&) const = default;
};

/// Bytes of a game's own for its clients; a client that does not know the channel skips them. The same value
/// comes from clients to rules.
struct ChannelData {
  std::string channel;
  std::vector<uint8_t> bytes;

  bool operator==(const ChannelData&) const = default;
};

struct Notice {
  Audience to{};
  std::variant<NoticeLine, Cue, ChannelData> what{};

  bool operator==(const Notice&) const = default;
};

/// Refuses texts that are empty, too long or not clean, numbers beyond their bounds, places outside the
/// world.
Result<void> validate(const Notice& notice);
Result<void> validate(const ChannelData& data);

}  // namespace scree
