// Where visitors of a world begin: the spawn that somebody chose, or a place that its ground suggests. Where
// terrain lies there by now, the eye is lifted out of it. Not thread-safe.
#pragma once

#include <optional>

#include "server/world/tick_delta.h"
#include "shared/base/spawn.h"
#include "shared/field/field.h"

namespace scree {

class SpawnPlace {
 public:
  /// As the field stands. `chosen`: nothing where the ground is to suggest one.
  Spawn find(const Field& field, const std::optional<Spawn>& chosen);
  /// Notes in the delta if the spawn is another one after this tick. It does nothing before the first find():
  /// only worlds with visitors need one.
  void follow(const Field& field, const std::optional<Spawn>& chosen, TickDelta& delta);

 private:
  bool is_near(const TickDelta& delta, float voxel_size_m) const;

  std::optional<Spawn> suggested_;  ///< by the ground, which never changes
  std::optional<Spawn> chosen_;     ///< as of the last find()
  std::optional<Spawn> found_;
};

/// The spawn of that choice, lifted to the next place above it where there is no rock around the eye.
Spawn lifted(const Field& field, const Spawn& wanted);

/// What settings say of the spawn: the chosen one, or nothing.
std::optional<Spawn> chosen_spawn(const SettingValues& settings);

}  // namespace scree
