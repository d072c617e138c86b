#include "client/viewer/events/piece_event_detector.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "client/mirror/predictions.h"
#include "client/viewer/base/limits.h"

namespace scree {
namespace {

/// Change of speed, less gravity's, that counts as a blow; below it poses are only interpolated unevenly.
constexpr float blow_m_s = 0.8F;
/// Speed that a piece gets by what breaks it off, as far as its crack counts.
constexpr float crack_m_s = 3.0F;
constexpr float settle_m_s = 0.4F;
/// Without a step for so long, what happened meanwhile is no event.
constexpr double gap_s = 0.5;
/// A piece that appears within so much of where a predicted one was until now: the same break.
constexpr float takes_place_m = 1.5F;

}  // namespace

PieceEventDetector::Known PieceEventDetector::seen(const ScenePiece& piece, float voxel_m) {
  const Volume& volume = *piece.volume;
  const float voxels = static_cast<float>(volume.mass) / units_per_voxel;
  const float volume_m3 = std::max(voxels, 0.0F) * voxel_m * voxel_m * voxel_m;
  return {piece.pose.position_m, glm::vec3(0.0F),
          std::cbrt(volume_m3),  volume_m3 * traits_of(volume.material).density_kg_m3,
          volume.material,       false};
}

void PieceEventDetector::note_strike(PieceId id, const Known& before, const Known& now, float elapsed_s,
                                     std::vector<PieceEvent>& events) {
  if (!before.moved) return;
  const float jump_m_s = glm::length(now.speed_m_s - before.speed_m_s - gravity_m_s2 * elapsed_s);
  // What lies still is held against gravity.
  const float blow = jump_m_s - glm::length(gravity_m_s2) * elapsed_s;
  if (blow > blow_m_s)
    events.push_back({PieceEventKind::strike, now.place_m, now.size_m, now.mass_kg * blow, now.material, id});
}

bool PieceEventDetector::replaces_predicted(PieceId id, const ScenePieces& pieces) const {
  const glm::vec3 place_m = pieces.at(id).pose.position_m;
  return std::ranges::any_of(*known_, [&](const auto& known) {
    return Predictions::is_predicted(known.first) && !pieces.contains(known.first) &&
           glm::distance(known.second.place_m, place_m) < takes_place_m;
  });
}

std::vector<PieceEvent> PieceEventDetector::step(const ScenePieces& pieces, float voxel_m, double now_s) {
  std::vector<PieceEvent> events;
  const auto elapsed_s = static_cast<float>(now_s - last_s_);
  if (known_ && elapsed_s <= 0.0F) return events;
  const bool continuous = known_ && static_cast<double>(elapsed_s) < gap_s;
  Table now;
  for (const auto& [id, piece] : pieces) {
    Known one = seen(piece, voxel_m);
    const auto before = continuous ? known_->find(id) : Table::const_iterator();
    if (continuous && before != known_->end()) {
      one.speed_m_s = (one.place_m - before->second.place_m) / elapsed_s;
      one.moved = true;
      note_strike(id, before->second, one, elapsed_s, events);
    } else if (continuous && !replaces_predicted(id, pieces)) {
      events.push_back(
          {PieceEventKind::crack, one.place_m, one.size_m, one.mass_kg * crack_m_s, one.material, id});
    }
    now.emplace(id, one);
  }
  if (continuous)
    for (const auto& [id, gone] : *known_)
      if (!now.contains(id) && !Predictions::is_predicted(id))
        events.push_back({PieceEventKind::settle, gone.place_m, gone.size_m, gone.mass_kg * settle_m_s,
                          gone.material, id});
  known_ = std::move(now);
  last_s_ = now_s;
  std::ranges::stable_sort(events, std::ranges::greater(), &PieceEvent::impulse_n_s);
  if (events.size() > limits::piece_events_per_step_max) events.resize(limits::piece_events_per_step_max);
  return events;
}

}  // namespace scree
