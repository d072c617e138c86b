// Persons on foot, as the world publishes them and as a client learns of them (proto/person.proto).
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "shared/base/ids.h"
#include "shared/base/walking.h"

namespace scree {

/// A person on foot after a tick.
struct PersonPlace {
  uint64_t session = 0;
  PieceId body = 0;    ///< the prop that is the person's body
  uint32_t taken = 0;  ///< number of the last input that was carried out; 0: none
  WalkerState walker;
  glm::vec3 look{0.0F, 0.0F, -1.0F};  ///< unit

  bool operator==(const PersonPlace&) const = default;
};

struct PersonBody {
  uint64_t session = 0;
  PieceId body = 0;

  bool operator==(const PersonBody&) const = default;
};

/// The receiver's own person, exact.
struct OwnPerson {
  uint32_t taken = 0;  ///< number of the last input that was carried out; 0: none
  WalkerState walker;

  bool operator==(const OwnPerson&) const = default;
};

struct PersonPlacesMessage {
  Tick tick = 0;
  /// All persons on foot, ordered by session, when who that is has changed; at most
  /// limits::person_bodies_max.
  std::optional<std::vector<PersonBody>> persons{};
  std::optional<OwnPerson> own{};  ///< when it has changed
};

}  // namespace scree
