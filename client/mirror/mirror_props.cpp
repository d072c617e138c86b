// What a mirror knows of props, and of whatever moves.
#include <fmt/format.h>

#include "client/mirror/mirror.h"

namespace scree {

Result<void> Mirror::apply_stone(const StoneMessage& message, MirrorChanges& changes) {
  changes.stones.push_back(
      {message.id, std::make_shared<const Volume>(message.volume), message.pose, message.lies});
  return {};
}

void Mirror::note_merge(const Operation& operation, MirrorChanges& changes) const {
  const auto* const stamp = std::get_if<StampOperation>(&operation);
  if (stamp == nullptr) return;
  changes.stones.push_back({stamp->piece, table_.at(stamp->piece), stamp->pose});
  for (const StampedPiece& other : stamp->others)
    changes.stones.push_back({other.piece, table_.at(other.piece), other.pose});
}

Result<void> Mirror::apply_prop(const PropMessage& message, MirrorChanges& changes) {
  if (find_moving(message.id) != nullptr)
    return fail(fmt::format("prop {} is sent a second time", message.id));
  known_motions_.add(message.id, glm::vec3(0.0F));
  const Pose pose = dequantise(message.pose);
  props_[message.id] = {{pose, pose, tick_, tick_}, std::make_shared<const Prop>(message.prop)};
  changes.props_added.push_back(message.id);
  ++counters_.props_sent;
  return {};
}

Result<void> Mirror::apply_kept(const KeptPiecesMessage& message) {
  for (const PieceId id : message.kept) {
    if (!motions_.contains(id)) return fail(fmt::format("piece {} is kept, and not known here", id));
    kept_.insert(id);
  }
  for (const PieceId id : message.released) kept_.erase(id);
  return {};
}

BetweenPoses* Mirror::find_moving(PieceId id) {
  if (const auto piece = motions_.find(id); piece != motions_.end()) return &piece->second;
  const auto prop = props_.find(id);
  return prop == props_.end() ? nullptr : &prop->second;
}

void Mirror::remove(PieceId id, MirrorChanges& changes) {
  const auto prop = props_.find(id);
  if (prop == props_.end()) return remove_piece(id, changes);
  forget_joints_of(id, changes);
  props_.erase(prop);
  known_motions_.remove(id);
  changes.props_removed.push_back(id);
}

/// Tiles of the ground may arrive without a message: then nothing that was read is kept.
HeldScene Mirror::scene() {
  scenes_.begin(motions_.size() + props_.size());
  for (const auto& [id, piece] : motions_) scenes_.add_piece(id, piece.to, *piece.volume);
  for (const auto& [id, prop] : props_) scenes_.add_prop(id, prop.to, prop.prop);
  return field_.source().heights == nullptr ? scenes_.make(field_) : scenes_.make_apart(field_);
}

Result<void> Mirror::apply_persons(const PersonPlacesMessage& message) {
  if (message.persons) {
    persons_.clear();
    bool is_on_foot = false;
    for (const PersonBody& person : *message.persons) {
      persons_[person.body] = person.session;
      is_on_foot = is_on_foot || person.session == session_;
    }
    if (!is_on_foot) own_person_.reset();
  }
  if (message.own) own_person_ = message.own;
  return {};
}

Result<void> Mirror::apply_regions(const RegionsMessage& message, MirrorChanges& changes) {
  regions_ = message.regions;
  changes.regions = true;
  return {};
}

Result<void> Mirror::apply_stores(const StoresMessage& message) {
  for (const StoreContent& one : message.stores) carried_ = one.masses;
  return {};
}

}  // namespace scree
