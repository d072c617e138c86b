#include "server/store/event_deriver.h"

#include <algorithm>
#include <fmt/format.h>

#include "shared/base/overloaded.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

/// The place of the first of these pieces that is alive.
std::optional<glm::vec3> place_of_pieces(const std::vector<PieceId>& pieces, const TickDelta& delta) {
  for (const PieceId id : pieces)
    if (const auto state = std::ranges::lower_bound(delta.pieces, id, {}, &PieceState::id);
        state != delta.pieces.end() && state->id == id)
      return dequantise(state->pose).position_m;
  return std::nullopt;
}

glm::vec3 centre_of(const VoxelBox& box, float voxel_size_m) {
  return glm::vec3(box.lo.x + box.hi.x, box.lo.y + box.hi.y, box.lo.z + box.hi.z) * (0.5F * voxel_size_m);
}

/// What an operation of a tick is as an event; nothing for what is a part of another event.
class Telling {
 public:
  Telling(const TickDelta& delta, const AppliedOperation& applied, float voxel_size_m)
      : delta_(delta), applied_(applied), voxel_size_m_(voxel_size_m) {}

  std::optional<Event> operator()(const CarveOperation& carve) const {
    EventKind kind = EventKind::carve;
    if (applied_.stage == TickStage::impacts) kind = EventKind::dent;
    if (applied_.stage == TickStage::support) kind = EventKind::crush;
    return with_pieces(at(kind, centre_of(carve.shape)));
  }
  std::optional<Event> operator()(const FillOperation& fill) const {
    return at(EventKind::fill, centre_of(fill.shape));
  }
  std::optional<Event> operator()(const PaintOperation& paint) const {
    return at(EventKind::paint, centre_of(paint.shape));
  }
  std::optional<Event> operator()(const ShatterOperation&) const {
    if (applied_.stage == TickStage::refracture) return std::nullopt;
    return with_pieces({.kind = EventKind::broke,
                        .tick = delta_.tick,
                        .place_m = place_of_pieces(applied_.created, delta_)});
  }
  std::optional<Event> operator()(const IslandOperation& island) const {
    return with_pieces(at(EventKind::fall, centre_of(island.box, voxel_size_m_)));
  }
  std::optional<Event> operator()(const DigOperation& dig) const {
    Event event = at(EventKind::dig, centre_of(dig.shape));
    event.volume_m3 = m3_of(applied_.stored);
    event.body = dig.piece;
    return event;
  }
  std::optional<Event> operator()(const PlaceOperation& place) const {
    Event event = at(EventKind::place, centre_of(place.shape));
    event.volume_m3 = m3_of(-applied_.stored);
    return event;
  }
  // Bursts of merges are the tick's as a whole; what leaves the world is nobody's to see.
  std::optional<Event> operator()(const StampOperation&) const { return std::nullopt; }
  std::optional<Event> operator()(const DiscardOperation&) const { return std::nullopt; }
  std::optional<Event> operator()(const SlideOperation&) const { return std::nullopt; }
  std::optional<Event> operator()(const RestoreOperation&) const { return std::nullopt; }  // as one: a note

 private:
  Event at(EventKind kind, glm::vec3 place_m) const {
    return {.kind = kind, .tick = delta_.tick, .place_m = place_m, .session = applied_.session};
  }
  Event with_pieces(Event event) const {
    MassUnits mass = 0;
    for (const PieceId id : applied_.created) {
      const auto made = std::ranges::lower_bound(delta_.spawned, id, {}, &SpawnedPiece::id);
      if (made != delta_.spawned.end() && made->id == id) mass += made->volume->mass;
    }
    event.pieces = static_cast<uint32_t>(applied_.created.size());
    event.volume_m3 = m3_of(mass);
    return event;
  }
  float m3_of(MassUnits mass) const {
    const double voxel_m3 = double{voxel_size_m_} * voxel_size_m_ * voxel_size_m_;
    return static_cast<float>(static_cast<double>(mass) / units_per_voxel * voxel_m3);
  }

  const TickDelta& delta_;
  const AppliedOperation& applied_;
  float voxel_size_m_;
};

/// Merges this far from a burst's first one belong to it, m: about the reach of one blow's rubble.
constexpr float burst_reach_m = 8.0F;

/// Bursts that may grow at once; above: a merge belongs to the nearest.
constexpr size_t bursts_max = 64;

Event event_of(const ContactEvent& contact, Tick tick) {
  return {.kind = EventKind::contact,
          .tick = tick,
          .place_m = contact.place_m,
          .body = contact.body,
          .other = contact.other,
          .normal = contact.normal,
          .impulse_n_s = contact.impulse_n_s,
          .energy_j = contact.energy_j};
}

float distance_squared(glm::vec3 a, glm::vec3 b) {
  const glm::vec3 d = a - b;
  return d.x * d.x + d.y * d.y + d.z * d.z;
}

}  // namespace

std::optional<glm::vec3> place_of(const AppliedOperation& applied, const TickDelta& delta,
                                  float voxel_size_m) {
  using Place = std::optional<glm::vec3>;
  const auto of_shape = [](const auto& operation) -> Place { return centre_of(operation.shape); };
  return std::visit(
      Overloaded{[&](const CarveOperation& carve) { return of_shape(carve); },
                 [&](const FillOperation& fill) { return of_shape(fill); },
                 [&](const PaintOperation& paint) { return of_shape(paint); },
                 [&](const DigOperation& dig) { return of_shape(dig); },
                 [&](const PlaceOperation& place) { return of_shape(place); },
                 [&](const ShatterOperation&) { return place_of_pieces(applied.created, delta); },
                 [&](const IslandOperation& island) -> Place { return centre_of(island.box, voxel_size_m); },
                 [&](const SlideOperation& slide) -> Place { return centre_of(slide.box, voxel_size_m); },
                 [](const StampOperation& stamp) -> Place { return dequantise(stamp.pose).position_m; },
                 [&](const RestoreOperation& restore) -> Place {
                   if (restore.bricks == nullptr) return std::nullopt;
                   return centre_of(read_box(restore, {}, voxel_size_m), voxel_size_m);
                 },
                 [](const DiscardOperation&) -> Place { return std::nullopt; }},
      applied.operation);
}

void EventDeriver::add_settings(const TickDelta& delta, std::vector<Event>& events) {
  if (delta.settings.empty()) return;
  for (const SettingValue& setting : delta.settings)
    if (std::ranges::find(settings_, setting) == settings_.end())
      events.push_back({.kind = EventKind::setting,
                        .tick = delta.tick,
                        .session = delta.settings_by,
                        .text = fmt::format("{}={}", setting.name, setting.value)});
  settings_ = delta.settings;
}

EventDeriver::Burst& EventDeriver::burst_near(glm::vec3 place_m, Tick tick) {
  const auto nearest = std::ranges::min_element(
      bursts_, {}, [&](const Burst& burst) { return distance_squared(burst.place_m, place_m); });
  const bool is_near = nearest != bursts_.end() &&
                       distance_squared(nearest->place_m, place_m) <= burst_reach_m * burst_reach_m;
  if (is_near || bursts_.size() >= bursts_max) return *nearest;
  return bursts_.emplace_back(Burst{tick, place_m, 0});
}

void EventDeriver::note_merges(const TickDelta& delta) {
  for (const AppliedOperation& applied : delta.operations)
    if (const auto* stamp = std::get_if<StampOperation>(&applied.operation))
      burst_near(dequantise(stamp->pose).position_m, delta.tick).pieces +=
          static_cast<uint32_t>(pieces_merged_by(applied.operation));
}

void EventDeriver::add_bursts(Tick tick, std::vector<Event>& events) {
  const auto is_over = [&](const Burst& burst) { return tick - burst.begun >= burst_ticks_; };
  for (const Burst& burst : bursts_)
    if (is_over(burst) && burst.pieces >= merge_burst_min)
      events.push_back(
          {.kind = EventKind::merge, .tick = tick, .place_m = burst.place_m, .pieces = burst.pieces});
  std::erase_if(bursts_, is_over);
}

void EventDeriver::add_told(const TickDelta& delta, std::vector<Event>& events) const {
  if (contacts_j_ <= 0.0F || delta.told.empty()) return;
  const size_t count = std::min(delta.told.size(), told_events_max);
  events.insert(events.end(), delta.told.begin(), delta.told.begin() + static_cast<std::ptrdiff_t>(count));
  events.back().left_out = static_cast<uint32_t>(delta.told.size() - count);
}

void EventDeriver::add_contacts(const TickDelta& delta, std::vector<Event>& events) {
  if (contacts_j_ <= 0.0F) return;
  for (const ContactEvent& contact : delta.contacts) {
    if (contact.energy_j < contacts_j_) break;  // the hardest come first
    if (!contacts_) contacts_ = ContactTime{delta.tick};
    if (contacts_->told < contacts_told_max) {
      ++contacts_->told;
      events.push_back(event_of(contact, delta.tick));
      continue;
    }
    if (contacts_->left_out++ == 0 || contact.energy_j > contacts_->hardest.energy_j)
      contacts_->hardest = contact;
  }
  if (!contacts_ || delta.tick - contacts_->begun < burst_ticks_) return;
  if (contacts_->left_out > 0) {
    events.push_back(event_of(contacts_->hardest, delta.tick));
    events.back().left_out = contacts_->left_out - 1;
  }
  contacts_.reset();
}

std::vector<Event> EventDeriver::events_of(const TickDelta& delta) {
  std::vector<Event> events;
  for (const AppliedOperation& applied : delta.operations)
    if (auto event = std::visit(Telling(delta, applied, voxel_size_m_), applied.operation))
      events.push_back(std::move(*event));
  add_told(delta, events);
  add_contacts(delta, events);
  note_merges(delta);
  add_bursts(delta.tick, events);
  add_settings(delta, events);
  return events;
}

}  // namespace scree
