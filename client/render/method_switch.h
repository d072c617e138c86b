// Switches between methods and between worlds: the old one is drawn until the new one has loaded, so that no
// switch shows a hole. Needs the GL context current, the destructor too.
#pragma once

#include <memory>

#include "client/render/methods.h"
#include "client/render/scene/settled_stones.h"

namespace scree {

class MethodSwitch {
 public:
  /// `pool` must outlive it. Nothing is drawn before the first world.
  MethodSwitch(WorkPool& pool, float view_radius_m, const MethodEntry& first);

  /// Chooses a method, which loads from the next follow() on, beside the drawing one. Fails, and changes
  /// nothing, when this GL context lacks a feature that the method needs.
  Result<void> choose(const MethodEntry& entry);
  const MethodEntry& chosen() const { return *chosen_; }
  /// Draws so far from the next follow() on; what was drawn is drawn until the new range is loaded.
  void set_view_radius(float metres) { view_radius_m_ = metres; }

  /// The values of the methods' own options from now on.
  void set_options(const DrawOptionValues& values);

  /// Begins another mirror of the world: what was drawn is drawn until the new one is loaded.
  void begin_world();
  /// Draws nothing until begin_world() and follow() have made something.
  void forget_world();
  /// The world is at another moment: no stone lies where a piece merged.
  void forget_stones() { stones_.forget(); }
  /// Passes on the mirror's last changes and the scene of this frame, with the stones that lie where pieces
  /// merged (settled_stones.h).
  Result<void> follow(const MirrorChanges& changes, const Scene& scene, const Camera& camera);

  /// The pieces and stones of the last follow().
  const ScenePieces& pieces() const { return stones_.shown(); }
  /// How many of them are stones.
  size_t stones() const { return stones_.count(); }

  /// Null before the first world.
  DrawMethod* shown() { return shown_.method.get(); }
  /// Whether the view was whole at some time since the world began: what is prepared now only goes on from
  /// there.
  bool was_loaded() const { return was_loaded_; }
  /// The name of the method that is shown; empty before the first world.
  std::string_view shown_name() const { return name_of(shown_); }
  /// The method that loads beside the drawing one, or is not loaded yet; null when there is none.
  DrawMethod* preparing();
  std::string_view preparing_name() const { return prepared() == nullptr ? "" : name_of(*prepared()); }
  /// Whether the newest world is shown by the chosen method, everywhere within the view radius.
  bool loaded() const { return fits(shown_) && !shown_is_past_ && !next_.method && shown_.method->loaded(); }
  /// The same, and in its newest state.
  bool complete() const { return loaded() && shown_.method->complete(); }

 private:
  struct Slot {
    std::unique_ptr<DrawMethod> method;
    const MethodEntry* entry = nullptr;
    float view_radius_m = 0.0F;
  };

  bool fits(const Slot& slot) const {
    return slot.method && slot.entry == chosen_ && slot.view_radius_m == view_radius_m_;
  }

  static std::string_view name_of(const Slot& slot) {
    return slot.entry == nullptr ? std::string_view() : slot.entry->name;
  }

  /// The slot of preparing(), or null.
  const Slot* prepared() const;
  Result<void> begin(Slot& slot, const Scene& scene);

  WorkPool& pool_;
  float view_radius_m_;
  SettledStones stones_;
  const MethodEntry* chosen_;
  DrawOptionValues options_;
  Slot shown_;
  bool shown_is_past_ = false;  ///< of a world that is gone: it stands still
  bool was_loaded_ = false;
  Slot next_;  ///< not yet loaded
};

}  // namespace scree
