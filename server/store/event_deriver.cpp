#include "server/store/event_deriver.h"

#include <algorithm>

#include "shared/base/overloaded.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

/// What an operation of a tick is as an event; nothing for what is a part of another event.
class Telling {
 public:
  Telling(const TickDelta& delta, const AppliedOperation& applied, float voxel_size_m)
      : delta_(delta), applied_(applied), voxel_size_m_(voxel_size_m) {}

  std::optional<Event> operator()(const CarveOperation& carve) const {
    EventKind kind = EventKind::carve;
    if (applied_.stage == TickStage::impacts) kind = EventKind::dent;
    if (applied_.stage == TickStage::support) kind = EventKind::crush;
    return with_pieces(at(kind, middle_of(carve.shape)));
  }
  std::optional<Event> operator()(const FillOperation& fill) const {
    return at(EventKind::fill, middle_of(fill.shape));
  }
  std::optional<Event> operator()(const PaintOperation& paint) const {
    return at(EventKind::paint, middle_of(paint.shape));
  }
  std::optional<Event> operator()(const ShatterOperation&) const {
    if (applied_.stage == TickStage::cut) return std::nullopt;
    Event broke{.kind = EventKind::broke, .tick = delta_.tick};
    for (const PieceId id : applied_.created)
      if (const auto state = std::ranges::lower_bound(delta_.pieces, id, {}, &PieceState::id);
          state != delta_.pieces.end() && state->id == id) {
        broke.place_m = dequantise(state->pose).position_m;
        break;
      }
    return with_pieces(broke);
  }
  std::optional<Event> operator()(const IslandOperation& island) const {
    const glm::vec3 corners = glm::vec3(island.box.lo.x + island.box.hi.x, island.box.lo.y + island.box.hi.y,
                                        island.box.lo.z + island.box.hi.z);
    return with_pieces(at(EventKind::fall, corners * (0.5F * voxel_size_m_)));
  }
  // Bursts of merges are the tick's as a whole; what leaves the world is nobody's to see.
  std::optional<Event> operator()(const StampOperation&) const { return std::nullopt; }
  std::optional<Event> operator()(const DiscardOperation&) const { return std::nullopt; }

 private:
  static glm::vec3 middle_of(const Shape& shape) {
    return row_of(shape.kind).has_b ? (shape.a + shape.b) * 0.5F : shape.a;
  }
  Event at(EventKind kind, glm::vec3 place_m) const {
    return {.kind = kind, .tick = delta_.tick, .place_m = place_m};
  }
  Event with_pieces(Event event) const {
    MassUnits mass = 0;
    for (const PieceId id : applied_.created) {
      const auto made = std::ranges::lower_bound(delta_.spawned, id, {}, &SpawnedPiece::id);
      if (made != delta_.spawned.end() && made->id == id) mass += made->volume->mass;
    }
    event.pieces = static_cast<uint32_t>(applied_.created.size());
    const double voxel_m3 = double{voxel_size_m_} * voxel_size_m_ * voxel_size_m_;
    event.volume_m3 = static_cast<float>(static_cast<double>(mass) / units_per_voxel * voxel_m3);
    return event;
  }

  const TickDelta& delta_;
  const AppliedOperation& applied_;
  float voxel_size_m_;
};

/// At the first merge of the tick.
std::optional<Event> burst_of(const TickDelta& delta) {
  Event burst{.kind = EventKind::merge, .tick = delta.tick};
  for (const AppliedOperation& applied : delta.operations) {
    burst.pieces += static_cast<uint32_t>(pieces_merged_by(applied.operation));
    if (const auto* stamp = std::get_if<StampOperation>(&applied.operation); stamp && !burst.place_m)
      burst.place_m = dequantise(stamp->pose).position_m;
  }
  if (burst.pieces < merge_burst_min) return std::nullopt;
  return burst;
}

}  // namespace

void EventDeriver::add_settings(const TickDelta& delta, std::vector<Event>& events) {
  if (delta.settings.empty()) return;
  for (const SettingValue& setting : delta.settings)
    if (std::ranges::find(settings_, setting) == settings_.end())
      events.push_back(
          {.kind = EventKind::setting, .tick = delta.tick, .text = setting.name + "=" + setting.value});
  settings_ = delta.settings;
}

std::vector<Event> EventDeriver::events_of(const TickDelta& delta) {
  std::vector<Event> events;
  for (const AppliedOperation& applied : delta.operations)
    if (auto event = std::visit(Telling(delta, applied, voxel_size_m_), applied.operation))
      events.push_back(std::move(*event));
  if (auto burst = burst_of(delta)) events.push_back(std::move(*burst));
  add_settings(delta, events);
  return events;
}

}  // namespace scree
