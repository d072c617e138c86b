#include "server/world/region_bodies.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "server/world/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// A body's way in a step.
struct Way {
  glm::vec3 from_m{0.0F}, to_m{0.0F};
};

uint64_t tag_of(const World::State& state, PieceId id) {
  const auto prop = state.props.find(id);
  return prop == state.props.end() ? 0 : prop->second.prop->tag;
}

void tell(EventKind kind, const Region& region, PieceId id, uint64_t tag, std::optional<glm::vec3> place_m,
          TickDelta& delta) {
  delta.told.push_back(
      {.kind = kind, .tick = delta.tick, .place_m = place_m, .text = region.name, .body = id, .tag = tag});
}

/// The bodies near a region, and those that are noted as in it; ordered.
std::vector<PieceId> candidates(const World::State& state, const Region& region, float slack_m) {
  const RegionBounds bounds = bounds_of(region);
  std::vector<PieceId> ids = state.bodies.near(bounds.lo_m - slack_m, bounds.hi_m + slack_m);
  if (const auto noted = state.regions.inside.find(region.id); noted != state.regions.inside.end())
    for (const auto& [id, tag] : noted->second) ids.push_back(id);
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/// The ways of all bodies in a step.
class Ways {
 public:
  Ways(const World::State& state, std::span<const BodyState> before) {
    for (const BodyState& body : before) {
      const glm::vec3 to_m = state.bodies.state(body.id).pose.position_m;
      ways_.emplace_hint(ways_.end(), body.id, Way{body.pose.position_m, to_m});
      const glm::vec3 step = to_m - body.pose.position_m;
      longest_m_ = std::max(longest_m_, std::sqrt(glm::dot(step, step)));
    }
  }

  float longest_m() const { return longest_m_; }
  /// Null: the body is no more.
  Way* find(PieceId id) {
    const auto found = ways_.find(id);
    return found == ways_.end() ? nullptr : &found->second;
  }

 private:
  std::map<PieceId, Way> ways_;
  float longest_m_ = 0.0F;
};

/// Puts a piece back that came in from outside, to where it came in; of its speed it keeps what does not lead
/// inwards.
void keep_out(World::State& state, const Region& region, PieceId id, Way& way) {
  if (holds(region, way.from_m)) return;
  const std::optional<float> share = first_in(region, way.from_m, way.to_m);
  if (!share) return;
  const glm::vec3 at_m = way.from_m + (way.to_m - way.from_m) * *share;
  const glm::vec3 out = outward(region, at_m);
  BodyState body = state.bodies.state(id);
  body.pose.position_m = at_m + out * limits::region_skin_m;
  const float inwards = std::min(glm::dot(body.velocity_m_s, out), 0.0F);
  body.velocity_m_s -= out * inwards;
  state.bodies.put_back(id, body.pose, body.velocity_m_s);
  way.to_m = state.bodies.state(id).pose.position_m;
}

void note(World::State& state, const Region& region, PieceId id) {
  state.regions.inside[region.id][id] = tag_of(state, id);
}

/// Tells that the body is in the region or not, where it was otherwise. Whether it was.
bool tell_change(World::State& state, const Region& region, PieceId id, bool is_in,
                 std::optional<glm::vec3> place_m, TickDelta& delta) {
  std::map<PieceId, uint64_t>& inside = state.regions.inside[region.id];
  const auto noted = inside.find(id);
  if (is_in == (noted != inside.end())) return false;
  tell(is_in ? EventKind::region_enter : EventKind::region_leave, region, id,
       is_in ? tag_of(state, id) : noted->second, place_m, delta);
  if (is_in)
    note(state, region, id);
  else
    inside.erase(noted);
  return true;
}

void tell_crossing(World::State& state, const Region& region, PieceId id, const Way& way, TickDelta& delta) {
  const auto at = [&](glm::vec3 from_m, glm::vec3 to_m) -> std::optional<glm::vec3> {
    const std::optional<float> share = first_in(region, from_m, to_m);
    return share ? std::optional(from_m + (to_m - from_m) * *share) : std::nullopt;
  };
  const std::optional<glm::vec3> came = at(way.from_m, way.to_m), went = at(way.to_m, way.from_m);
  const bool is_in = holds(region, way.to_m);
  if (tell_change(state, region, id, is_in, is_in ? came : went.value_or(way.to_m), delta)) return;
  if (is_in || !came) return;  // it came and went
  tell_change(state, region, id, true, came, delta);
  tell_change(state, region, id, false, went, delta);
}

}  // namespace

std::vector<BodyState> places_before_step(const World::State& state) {
  const bool wanted = state.regions.tell() || state.regions.forbid_any(forbids::pieces);
  return wanted ? state.bodies.states() : std::vector<BodyState>();
}

void meet_regions(World::State& state, std::span<const BodyState> before, TickDelta& delta) {
  if (before.empty()) return;
  Ways ways(state, before);
  const auto regions = state.regions.shared();
  for (const Region& region : *regions) {
    if (!region.forbids_any(forbids::pieces)) continue;
    for (const PieceId id : candidates(state, region, ways.longest_m()))
      if (Way* const way = ways.find(id); way != nullptr && state.pieces.contains(id))
        keep_out(state, region, id, *way);
  }
  for (const Region& region : *regions) {
    if (!region.tells) continue;
    for (const PieceId id : candidates(state, region, ways.longest_m()))
      if (const Way* const way = ways.find(id)) tell_crossing(state, region, id, *way, delta);
  }
}

void tell_of_regions(World::State& state, TickDelta& delta) {
  if (!state.regions.tell()) return;
  const auto regions = state.regions.shared();
  for (const Region& region : *regions) {
    if (!region.tells) continue;
    for (const PieceId id : candidates(state, region, 0.0F)) {
      std::optional<glm::vec3> place_m;
      if (state.bodies.contains(id)) place_m = state.bodies.state(id).pose.position_m;
      tell_change(state, region, id, place_m && holds(region, *place_m), place_m, delta);
    }
  }
}

void note_inside(World::State& state, RegionId id) {
  const auto& regions = state.regions.all();
  const auto region = std::ranges::lower_bound(regions, id, {}, &Region::id);
  CHECK(region != regions.end() && region->id == id);
  for (const PieceId body : candidates(state, *region, 0.0F))
    if (holds(*region, state.bodies.state(body).pose.position_m)) note(state, *region, body);
}

}  // namespace scree
