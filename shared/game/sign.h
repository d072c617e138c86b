// Signs: lines, bars and markers that a host's rules show to persons, until they take them away. Plain
// values; one that comes from outside is untrusted until validate() has passed it. Metres.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "shared/base/ids.h"
#include "shared/base/result.h"
#include "shared/game/audience.h"
#include "shared/game/limits.h"

namespace scree {

/// The numbers are those on the wire and in files.
enum class SignKind : uint8_t { line, bar, marker };

struct SignKindRow {
  std::string_view name;
};

constexpr SignKindRow row_of(SignKind kind) {
  switch (kind) {
    case SignKind::line:  // text at the screen's top
      return {"line"};
    case SignKind::bar:  // the same, with a bar that Sign::share fills
      return {"bar"};
    case SignKind::marker:  // text at a place in the world
      return {"marker"};
  }
  return {};
}

struct Sign {
  std::string name;  ///< unique for its audience; signs are shown in the order of their names
  Audience to{};
  SignKind kind = SignKind::line;
  std::string text{};
  float share = 0.0F;       ///< of a bar, 0 to 1
  glm::vec3 place_m{0.0F};  ///< of a marker
  /// Red, green and blue of text, bar and marker.
  std::array<uint8_t, 3> colour{255, 255, 255};
  /// The tick in which it ends by itself; 0: it stays. A line, bar or marker with an end shows the time that
  /// is left after its text, where `counts`.
  Tick until = 0;
  bool counts = false;

  bool operator==(const Sign&) const = default;
};

/// The order of a world's signs: by audience, then by name.
bool sign_before(const Sign& a, const Sign& b);

/// Refuses what cannot be shown: names and texts that are no clean text or too long, a share outside 0 to 1,
/// a place that is not in the world.
Result<void> validate(const Sign& sign);
Result<void> validate(const Audience& audience);

}  // namespace scree
