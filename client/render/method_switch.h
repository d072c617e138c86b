// Which method draws a world, and how another takes over: the old one draws until the new one has loaded, so
// that neither a switch nor a new world ever shows a hole. Needs the GL context current, the destructor too.
#pragma once

#include <memory>

#include "client/render/methods.h"

namespace scree {

class MethodSwitch {
 public:
  /// `pool` must outlive it. Nothing is drawn before the first world.
  MethodSwitch(WorkPool& pool, float view_radius_m, const MethodEntry& first);

  /// From the next follow() on this method loads beside the one that draws. Fails, and changes nothing, when
  /// this GL context lacks what it needs.
  Result<void> choose(const MethodEntry& entry);
  const MethodEntry& chosen() const { return *chosen_; }

  /// Another world begins: what is shown of the old one stays until the new one is loaded.
  void begin_world();
  /// What the mirror's last messages changed, and the scene of this frame.
  Result<void> follow(const MirrorChanges& changes, const Scene& scene, const Camera& camera);

  /// Null before the first world.
  DrawMethod* shown() { return shown_.method.get(); }
  /// What is shown is the newest world by the chosen method, all of it within the view radius; and in its
  /// newest state.
  bool loaded() const {
    return shown_.entry == chosen_ && !shown_is_past_ && !next_.method && shown_.method->loaded();
  }
  bool complete() const { return loaded() && shown_.method->complete(); }

 private:
  struct Slot {
    std::unique_ptr<DrawMethod> method;
    const MethodEntry* entry = nullptr;
  };

  Result<void> begin(Slot& slot, const Scene& scene);

  WorkPool& pool_;
  float view_radius_m_;
  const MethodEntry* chosen_;
  Slot shown_;
  bool shown_is_past_ = false;  ///< of a world that is gone: it stands still
  Slot next_;                   ///< not yet loaded
};

}  // namespace scree
