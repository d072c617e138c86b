#include "client/viewer/events/piece_event_detector.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "client/mirror/predictions.h"
#include "client/viewer/base/limits.h"
#include "shared/prop/prop_solid.h"

namespace scree {
namespace {

/// Change of speed, less gravity's, that counts as a blow; below it poses are only interpolated unevenly.
constexpr float blow_m_s = 0.8F;
/// Speed that a piece gets by what breaks it off, as far as its crack counts.
constexpr float crack_m_s = 3.0F;
constexpr float settle_m_s = 0.4F;
/// Without a step for so long, what happened meanwhile is no event. Slow machines draw once a second.
constexpr double gap_s = 3.0;
/// A piece larger than this strikes with its foot, which may lie far from its middle.
constexpr float large_m = 2.0F;
/// A piece that appears within so much of where a predicted one was until now: the same break.
constexpr float takes_place_m = 1.5F;

/// Its lowest place, about: of some hundreds of its voxels.
glm::vec3 lowest_place_m(const ScenePiece& piece, float voxel_m) {
  constexpr int looks = 8;
  const Volume& volume = *piece.volume;
  const VoxelBox& box = volume.window.box;
  const VoxelCoord size = box.size();
  const VoxelCoord step{std::max(size.x / looks, 1), std::max(size.y / looks, 1),
                        std::max(size.z / looks, 1)};
  glm::vec3 foot = piece.pose.position_m;
  for (int x = box.lo.x; x < box.hi.x; x += step.x)
    for (int y = box.lo.y; y < box.hi.y; y += step.y)
      for (int z = box.lo.z; z < box.hi.z; z += step.z) {
        if (volume.window.at(x, y, z) >= 0) continue;
        const glm::vec3 off_m = (glm::vec3(x, y, z) - volume.centre_voxels) * voxel_m;
        const glm::vec3 place_m = piece.pose.position_m + piece.pose.rotation * off_m;
        if (place_m.y < foot.y) foot = place_m;
      }
  return foot;
}

}  // namespace

PieceEventDetector::Known PieceEventDetector::seen(const ScenePiece& piece, float voxel_m,
                                                   const Palette& palette) {
  const Volume& volume = *piece.volume;
  const float voxel_m3 = voxel_m * voxel_m * voxel_m;
  const auto volume_m3 = [voxel_m3](MassUnits mass) {
    return std::max(static_cast<float>(mass) / units_per_voxel, 0.0F) * voxel_m3;
  };
  float mass_kg = 0.0F;
  for (const auto& [material, mass] : masses_of(volume))
    mass_kg += volume_m3(mass) * palette.row_or_first(material).density_kg_m3;
  return {piece.pose.position_m,
          glm::vec3(0.0F),
          std::cbrt(volume_m3(volume.mass)),
          mass_kg,
          main_material(volume),
          false,
          false};
}

PieceEventDetector::Known PieceEventDetector::seen(const Prop& prop) {
  Known one;
  one.size_m = std::cbrt(measure_of(prop).volume_m3);
  one.mass_kg = prop.mass_kg;
  one.material = prop.material;
  one.is_prop = true;
  return one;
}

PieceEventDetector::Known PieceEventDetector::moved_on(const Known& before, glm::vec3 place_m,
                                                       float elapsed_s) {
  Known now = before;
  now.place_m = place_m;
  now.speed_m_s = (place_m - before.place_m) / elapsed_s;
  now.moved = true;
  return now;
}

PieceEvent PieceEventDetector::event_of(PieceEventKind kind, PieceId id, const Known& piece, float change_m_s,
                                        const Palette& palette) {
  PieceEvent event{kind, piece.place_m, piece.size_m, piece.mass_kg * change_m_s, piece.material, id};
  const MaterialRow& row = palette.row_or_first(piece.material);
  event.mass_kg = piece.mass_kg;
  event.sound = row.sound;
  const auto& [red, green, blue] = row.look.colour;
  if (piece.material != palette.ground.bulk) event.dust = {red, green, blue};
  return event;
}

std::optional<float> PieceEventDetector::blow_of(const Known& before, const Known& now, float elapsed_s) {
  if (!before.moved) return std::nullopt;
  const float jump_m_s = glm::length(now.speed_m_s - before.speed_m_s - gravity_m_s2 * elapsed_s);
  // What lies still is held against gravity.
  const float blow = jump_m_s - glm::length(gravity_m_s2) * elapsed_s;
  return blow > blow_m_s ? std::optional(blow) : std::nullopt;
}

bool PieceEventDetector::replaces_predicted(PieceId id, const ScenePieces& pieces) const {
  const glm::vec3 place_m = pieces.at(id).pose.position_m;
  return std::ranges::any_of(*known_, [&](const auto& known) {
    return Predictions::is_predicted(known.first) && !pieces.contains(known.first) &&
           glm::distance(known.second.place_m, place_m) < takes_place_m;
  });
}

/// What a kinematic one does is told, and no blow.
void PieceEventDetector::follow_props(const SceneProps& props, std::optional<float> elapsed_s,
                                      const Palette& palette, Table& now,
                                      std::vector<PieceEvent>& events) const {
  for (const auto& [id, shown] : props) {
    if (shown.prop->motion != PropMotion::dynamic) continue;
    const auto before = elapsed_s ? known_->find(id) : Table::const_iterator();
    const bool is_known = elapsed_s && before != known_->end() && before->second.is_prop;
    Known one = is_known ? moved_on(before->second, shown.pose.position_m, *elapsed_s) : seen(*shown.prop);
    one.place_m = shown.pose.position_m;
    if (is_known)
      if (const auto blow = blow_of(before->second, one, *elapsed_s))
        events.push_back(event_of(PieceEventKind::strike, id, one, *blow, palette));
    now.emplace(id, one);
  }
}

std::vector<PieceEvent> PieceEventDetector::step(const Scene& scene, double now_s, const Palette& palette) {
  std::vector<PieceEvent> events;
  const auto elapsed_s = static_cast<float>(now_s - last_s_);
  if (known_ && elapsed_s <= 0.0F) return events;
  const bool continuous = known_ && static_cast<double>(elapsed_s) < gap_s;
  Table now;
  for (const auto& [id, piece] : scene.pieces) {
    Known one = seen(piece, scene.field.source().voxel_size_m, palette);
    const auto before = continuous ? known_->find(id) : Table::const_iterator();
    if (continuous && before != known_->end()) {
      one = moved_on(before->second, one.place_m, elapsed_s);
      if (const auto blow = blow_of(before->second, one, elapsed_s)) {
        events.push_back(event_of(PieceEventKind::strike, id, one, *blow, palette));
        if (one.size_m > large_m)
          events.back().place_m = lowest_place_m(piece, scene.field.source().voxel_size_m);
      }
    } else if (continuous && !replaces_predicted(id, scene.pieces)) {
      events.push_back(event_of(PieceEventKind::crack, id, one, crack_m_s, palette));
    }
    now.emplace(id, one);
  }
  follow_props(scene.props, continuous ? std::optional(elapsed_s) : std::nullopt, palette, now, events);
  if (continuous)
    for (const auto& [id, gone] : *known_)
      if (!now.contains(id) && !gone.is_prop && !Predictions::is_predicted(id))
        events.push_back(event_of(PieceEventKind::settle, id, gone, settle_m_s, palette));
  known_ = std::move(now);
  last_s_ = now_s;
  std::ranges::stable_sort(events, std::ranges::greater(), &PieceEvent::impulse_n_s);
  if (events.size() > limits::piece_events_per_step_max) events.resize(limits::piece_events_per_step_max);
  return events;
}

}  // namespace scree
