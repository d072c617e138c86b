#include "client/viewer/events/cue_event.h"

#include <algorithm>
#include <cmath>

#include "shared/base/overloaded.h"
#include "shared/game/limits.h"

namespace scree {
namespace {

/// Smaller is heard and seen as this.
constexpr float cue_size_min_m = 0.02F;
constexpr float cue_mass_min_kg = 0.01F;
constexpr glm::vec3 glow{1.0F, 0.62F, 0.16F};

PieceEventKind kind_of(CueKind kind) {
  switch (kind) {
    case CueKind::thud:
      return PieceEventKind::thud;
    case CueKind::crack:
      return PieceEventKind::snap;
    case CueKind::ring:
      return PieceEventKind::ring;
    case CueKind::rattle:
      return PieceEventKind::rattle;
    case CueKind::dust:
      return PieceEventKind::dust;
    case CueKind::sparks:
      return PieceEventKind::sparks;
  }
  return PieceEventKind::thud;
}

/// What a spade or a load of rubble of that size does, joules a cubic metre, about.
constexpr float work_j_m3 = 4000.0F;

void add_cues(CueKind sound, const Shape& shape, Material material, std::vector<Cue>& cues) {
  const float size_m = std::min(1.6F * reach_of(shape), limits::cue_size_max_m);
  const float energy_j = work_j_m3 * size_m * size_m * size_m;
  for (const CueKind kind : {sound, CueKind::dust})
    cues.push_back({kind, centre_of(shape), size_m, energy_j, material});
}

}  // namespace

void add_cues_of(const Operation& operation, std::vector<Cue>& cues) {
  std::visit(Overloaded{[&](const DigOperation& dig) {
                          if (dig.piece == 0) add_cues(CueKind::rattle, dig.shape, material::rock, cues);
                        },
                        [&](const PlaceOperation& place) {
                          add_cues(CueKind::thud, place.shape, place.material, cues);
                        },
                        [&](const FillOperation& fill) {
                          add_cues(CueKind::thud, fill.shape, fill.material.value_or(material::rock), cues);
                        },
                        [](const auto&) {}},
             operation);
}

PieceEvent event_of(const Cue& cue, const Palette& palette) {
  const MaterialRow& row = palette.row_or_first(cue.material);
  PieceEvent event;
  event.kind = kind_of(cue.kind);
  event.place_m = cue.place_m;
  event.size_m = std::max(cue.size_m, cue_size_min_m);
  event.material = cue.material;
  event.mass_kg = std::max(row.density_kg_m3 * event.size_m * event.size_m * event.size_m, cue_mass_min_kg);
  event.impulse_n_s = std::sqrt(2.0F * event.mass_kg * cue.energy_j);
  event.sound = row.sound;
  const auto& [red, green, blue] = row.look.colour;
  if (cue.kind == CueKind::sparks)
    event.dust = glow;
  else if (cue.material != palette.ground.bulk)
    event.dust = {red, green, blue};
  return event;
}

}  // namespace scree
