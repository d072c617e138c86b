// What a host's rules do to a world besides what persons can ask for: values that they keep, signs, notices,
// and what they make of persons. Part of the requests, so that recordings have them.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <variant>

#include "shared/game/kept.h"
#include "shared/game/notice.h"
#include "shared/game/sign.h"

namespace scree {

/// Keeps the value with the world, in place of the one of its key.
struct KeepValue {
  KeptValue value;

  bool operator==(const KeepValue&) const = default;
};

/// Forgets the value of a key; nothing where there is none.
struct ForgetValue {
  std::string key;

  bool operator==(const ForgetValue&) const = default;
};

/// Shows a sign, in place of the one of its name for its audience.
struct ShowSign {
  Sign sign;

  bool operator==(const ShowSign&) const = default;
};

/// Takes a sign away; nothing where there is none.
struct RemoveSign {
  Audience to{};
  std::string name;

  bool operator==(const RemoveSign&) const = default;
};

/// Changes what the rules made of a session's person; what is left out stays. It ends when the session does.
struct SetPlayer {
  uint64_t session = 0;
  std::optional<std::string> team{};   ///< empty: that of the access token counts again
  std::optional<float> pace{};         ///< multiple of the usual walking speed
  std::optional<glm::vec3> place_m{};  ///< of the feet: the person stands there, on foot from then on

  bool operator==(const SetPlayer&) const = default;
};

using RulesAct = std::variant<KeepValue, ForgetValue, ShowSign, RemoveSign, SetPlayer, Notice>;

/// "keep score", "show the sign round", "tell a cue": what it is, in words.
std::string text_of(const RulesAct& act);

}  // namespace scree
