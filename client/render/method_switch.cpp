#include "client/render/method_switch.h"

#include <utility>

namespace scree {

MethodSwitch::MethodSwitch(WorkPool& pool, float view_radius_m, const MethodEntry& first)
    : pool_(pool), view_radius_m_(view_radius_m), chosen_(&first) {}

Result<void> MethodSwitch::choose(const MethodEntry& entry) {
  if (const std::optional<std::string> missing = entry.missing())
    return fail("the method " + std::string(entry.name) + " needs " + *missing);
  chosen_ = &entry;
  return {};
}

void MethodSwitch::begin_world() {
  stones_.forget();
  next_ = {};
  shown_is_past_ = shown_.method != nullptr;
}

void MethodSwitch::forget_world() {
  next_ = {};
  shown_ = {};
  was_loaded_ = false;
}

const MethodSwitch::Slot* MethodSwitch::prepared() const {
  if (next_.method) return &next_;
  return shown_.method && !shown_.method->loaded() ? &shown_ : nullptr;
}

DrawMethod* MethodSwitch::preparing() {
  const Slot* slot = prepared();
  return slot == nullptr ? nullptr : slot->method.get();
}

void MethodSwitch::set_options(const DrawOptionValues& values) {
  options_ = values;
  for (Slot* slot : {&shown_, &next_})
    if (slot->method) slot->method->set_options(options_);
}

Result<void> MethodSwitch::begin(Slot& slot, const Scene& scene) {
  Result<std::unique_ptr<DrawMethod>> made = chosen_->make(pool_, view_radius_m_);
  if (!made) return fail(made.error().message);
  slot = {std::move(*made), chosen_, view_radius_m_};
  slot.method->set_options(options_);
  // The method starts late: all pieces are new to it.
  MirrorChanges known;
  for (const auto& [id, piece] : scene.pieces) known.pieces_added.push_back(id);
  slot.method->changed(known);
  return {};
}

Result<void> MethodSwitch::follow(const MirrorChanges& mirrored, const Scene& mirrors, const Camera& camera) {
  MirrorChanges changes = mirrored;
  const Scene scene{mirrors.field, stones_.step(mirrors.pieces, mirrors.field, camera.eye_m, changes),
                    mirrors.props};
  const auto update = [&](Slot& slot) {
    slot.method->changed(changes);
    slot.method->update(scene, camera);
  };
  const bool shown_fits = fits(shown_) && !shown_is_past_;
  Slot& wanted = shown_.method ? next_ : shown_;
  if (shown_fits) next_ = {};
  if (!shown_fits && !fits(wanted)) {
    TRY(begin(wanted, scene));
    // The scene holds the changes; passed twice, they would be meshed twice.
    wanted.method->update(scene, camera);
    if (&wanted == &shown_) return {};
  } else if (next_.method) {
    update(next_);
  }
  if (shown_.method && !shown_is_past_) update(shown_);
  if (next_.method && next_.method->loaded()) {
    shown_ = std::exchange(next_, {});
    shown_is_past_ = false;
  }
  was_loaded_ = was_loaded_ || shown_.method->loaded();
  return {};
}

}  // namespace scree
