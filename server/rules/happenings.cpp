#include "server/rules/happenings.h"

#include <algorithm>

#include "server/rules/limits.h"
#include "server/store/event_deriver.h"
#include "server/world/spawn.h"
#include "shared/base/overloaded.h"

namespace scree {

namespace {

void write_person(ScriptWriter& to, std::string_view name, uint64_t session, const RulesMoment& moment) {
  if (session == 0 || !moment.persons->contains(session)) return;
  to.name(name);
  to.handle({"person", session});
}

void write_place(ScriptWriter& to, const std::optional<glm::vec3>& place_m) {
  if (!place_m) return;
  to.name("at");
  to.vector(place_m->x, place_m->y, place_m->z);
}

void write_number(ScriptWriter& to, std::string_view name, double value) {
  to.name(name);
  to.number(value);
}

void write_body(ScriptWriter& to, std::string_view name, PieceId body) {
  if (body == 0) return;
  to.name(name);
  to.handle({"body", body});
}

std::string_view event_of(const AppliedOperation& applied) {
  return std::visit(Overloaded{[&](const CarveOperation&) -> std::string_view {
                                 return applied.stage == TickStage::requests ? "carve" : "broke";
                               },
                               [&](const ShatterOperation&) -> std::string_view {
                                 return applied.stage == TickStage::refracture ? "" : "broke";
                               },
                               [](const IslandOperation&) -> std::string_view { return "fall"; },
                               [](const StampOperation&) -> std::string_view { return "merge"; },
                               [](const DigOperation&) -> std::string_view { return "dig"; },
                               [](const PlaceOperation&) -> std::string_view { return "place"; },
                               [](const FillOperation&) -> std::string_view { return "fill"; },
                               [](const PaintOperation&) -> std::string_view { return "paint"; },
                               [](const auto&) -> std::string_view { return ""; }},
                    applied.operation);
}

std::vector<PieceId> merged_by(const StampOperation& stamp) {
  std::vector<PieceId> pieces{stamp.piece};
  for (const StampedPiece& other : stamp.others) pieces.push_back(other.piece);
  return pieces;
}

}  // namespace

Happenings::Weight Happenings::weight_of(const Volume& volume) const {
  const double voxel_m3 = double{voxel_size_m_} * voxel_size_m_ * voxel_size_m_;
  return {static_cast<double>(volume.mass) / units_per_voxel * voxel_m3,
          static_cast<double>(mass_kg(volume, *palette_, voxel_size_m_))};
}

Happenings::Weight Happenings::weight_of(const std::vector<PieceId>& pieces) const {
  Weight sum;
  for (const PieceId id : pieces)
    if (const auto known = weights_.find(id); known != weights_.end()) {
      sum.volume_m3 += known->second.volume_m3;
      sum.mass_kg += known->second.mass_kg;
    }
  return sum;
}

void Happenings::note_pieces(const TickDelta& delta) {
  for (const SpawnedPiece& piece : delta.spawned) weights_[piece.id] = weight_of(*piece.volume);
  if (weights_.size() <= 2 * delta.pieces.size() + limits::happenings_waiting_max) return;
  std::erase_if(weights_, [&](const auto& one) {
    const auto at = std::ranges::lower_bound(delta.pieces, one.first, {}, &PieceState::id);
    return at == delta.pieces.end() || at->id != one.first;
  });
}

void Happenings::add_operation(const AppliedOperation& applied, const TickDelta& delta,
                               const IsWanted& is_wanted, std::vector<Happening>& all) const {
  const std::string_view event = event_of(applied);
  if (event.empty() || !is_wanted(event)) return;
  const auto* const stamp = std::get_if<StampOperation>(&applied.operation);
  const std::vector<PieceId> pieces = stamp != nullptr ? merged_by(*stamp) : applied.created;
  Weight weight = weight_of(pieces);
  if (applied.stored != 0) {
    const double voxel_m3 = double{voxel_size_m_} * voxel_size_m_ * voxel_size_m_;
    weight = {std::abs(static_cast<double>(applied.stored)) / units_per_voxel * voxel_m3, 0.0};
  }
  all.push_back(
      {event, [place_m = place_of(applied, delta, voxel_size_m_), weight, pieces, session = applied.session,
               party = applied.party, is_merge = stamp != nullptr,
               is_load = applied.stage == TickStage::support](ScriptWriter& to, RulesMoment& moment) {
         write_person(to, "by", moment.persons->contains(session) ? session : moment.person_of(party),
                      moment);
         write_place(to, place_m);
         write_number(to, "volume", weight.volume_m3);
         write_number(to, "mass", weight.mass_kg);
         to.name("count");
         to.integer(static_cast<int64_t>(pieces.size()));
         if (is_load) {
           to.name("by_load");
           to.boolean(true);
         }
         if (is_merge) return;
         to.name("pieces");
         to.open_table();
         for (const PieceId id : pieces) to.handle({"body", id});
         to.close_table();
       }});
}

namespace {

std::string_view event_of(EventKind kind) {
  switch (kind) {
    case EventKind::hurt:
      return "hurt";
    case EventKind::buried:
      return "buried";
    case EventKind::region_enter:
      return "enter";
    case EventKind::region_leave:
      return "exit";
    case EventKind::joint_ended:
      return "joint_broken";
    default:
      return "";
  }
}

/// Whose body a person's is: persons' bodies have their session as tag.
bool is_of_person(const Event& event, const RulesMoment& moment) {
  return event.tag != 0 && moment.persons->contains(event.tag);
}

void write_told(ScriptWriter& to, const Event& event, const RulesMoment& moment) {
  write_place(to, event.place_m);
  if (event.kind == EventKind::hurt || event.kind == EventKind::buried) {
    write_person(to, "person", event.tag, moment);
    write_person(to, "by", moment.person_of(event.session), moment);
    write_body(to, "body", event.other);
    if (event.kind == EventKind::hurt) write_number(to, "energy", event.energy_j);
    return;
  }
  write_body(to, "body", event.body);
  if (event.kind == EventKind::joint_ended) {
    write_body(to, "other", event.other);
    to.name("why");
    to.text(event.text);
    return;
  }
  if (is_of_person(event, moment)) write_person(to, "person", event.tag, moment);
  to.name("region");
  to.text(event.text);
}

}  // namespace

void Happenings::add_told(const Event& event, const IsWanted& is_wanted, std::vector<Happening>& all) const {
  const std::string_view name = event_of(event.kind);
  if (name.empty() || !is_wanted(name)) return;
  all.push_back({name, [event](ScriptWriter& to, RulesMoment& moment) { write_told(to, event, moment); }});
}

std::vector<Happening> Happenings::derive(const TickDelta& delta, const IsWanted& is_wanted) {
  std::vector<Happening> all;
  note_pieces(delta);
  for (const AppliedOperation& applied : delta.operations) add_operation(applied, delta, is_wanted, all);
  for (const Event& event : delta.told) add_told(event, is_wanted, all);
  if (is_wanted("impact"))
    for (size_t i = 0; i < std::min(delta.contacts.size(), limits::impacts_told_max); ++i) {
      const ContactEvent contact = delta.contacts[i];
      if (contact.energy_j < limits::impact_told_least_j) break;  // the hardest come first
      all.push_back({"impact", [contact](ScriptWriter& to, RulesMoment&) {
                       write_place(to, contact.place_m);
                       write_body(to, "body", contact.body);
                       write_body(to, "other", contact.other);
                       write_number(to, "energy", contact.energy_j);
                       write_number(to, "impulse", contact.impulse_n_s);
                     }});
    }
  return all;
}

}  // namespace scree
