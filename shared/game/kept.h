// What a host's rules keep with a world, and what a world knows of the persons in its game. Plain values.
#pragma once

#include <cstdint>
#include <string>

#include "shared/base/result.h"
#include "shared/game/limits.h"

namespace scree {

/// A value under its key. Bytes that the rules alone understand; the key is clean text.
struct KeptValue {
  std::string key;
  std::string value;

  bool operator==(const KeptValue&) const = default;
};

/// What rules made of a session's person, until it leaves.
struct Player {
  uint64_t session = 0;
  /// The team of the game, which counts in place of the access token's; empty: the token's counts.
  std::string team{};
  float pace = 1.0F;  ///< multiple of the usual walking speed

  bool operator==(const Player&) const = default;
};

/// Refuses keys that are empty, too long or no clean text, and values that are too long.
Result<void> validate(const KeptValue& value);
/// Refuses a team that cannot be shown, and a pace that is not 0 to limits::walk_pace_max.
Result<void> validate(const Player& player);

}  // namespace scree
