// What happened in a tick, as the handlers of scripts hear of it. Derived when the tick is over, and told
// before the next one.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "server/rules/rules_moment.h"
#include "server/world/tick_delta.h"

namespace scree {

struct Happening {
  std::string_view event;  ///< of on.NAME
  /// Writes the event's fields into the table that is open.
  std::function<void(ScriptWriter& to, RulesMoment& moment)> write;
};

class Happenings {
 public:
  /// Whether a script has a handler for such an event.
  using IsWanted = std::function<bool(std::string_view event)>;

  Happenings(float voxel_size_m, std::shared_ptr<const Palette> palette)
      : voxel_size_m_(voxel_size_m), palette_(std::move(palette)) {}

  /// The next tick's, in the order in which they happened.
  std::vector<Happening> derive(const TickDelta& delta, const IsWanted& is_wanted);

 private:
  /// What a piece held, to be told when it merges.
  struct Weight {
    double volume_m3 = 0.0;
    double mass_kg = 0.0;
  };

  void note_pieces(const TickDelta& delta);
  Weight weight_of(const Volume& volume) const;
  Weight weight_of(const std::vector<PieceId>& pieces) const;
  void add_operation(const AppliedOperation& applied, const TickDelta& delta, const IsWanted& is_wanted,
                     std::vector<Happening>& all) const;
  void add_told(const Event& event, const IsWanted& is_wanted, std::vector<Happening>& all) const;

  float voxel_size_m_;
  std::shared_ptr<const Palette> palette_;
  std::unordered_map<PieceId, Weight> weights_;  ///< of pieces that were made while somebody listened
};

}  // namespace scree
