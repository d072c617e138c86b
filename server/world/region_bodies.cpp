#include "server/world/region_bodies.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "server/world/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// A body's way in a step.
struct Way {
  PieceId id = 0;
  bool is_piece = false;
  glm::vec3 from_m{0.0F}, to_m{0.0F};
};

/// Whether a box about the way and these bounds are apart.
bool misses(const RegionBounds& bounds, const Way& way) {
  const glm::vec3 lo_m = glm::min(way.from_m, way.to_m), hi_m = glm::max(way.from_m, way.to_m);
  return glm::any(glm::lessThan(hi_m, bounds.lo_m)) || glm::any(glm::greaterThan(lo_m, bounds.hi_m));
}

uint64_t tag_of(const World::State& state, PieceId id) {
  const auto prop = state.props.find(id);
  return prop == state.props.end() ? 0 : prop->second.prop->tag;
}

void tell(EventKind kind, const Region& region, PieceId id, uint64_t tag, std::optional<glm::vec3> place_m,
          TickDelta& delta) {
  delta.told.push_back(
      {.kind = kind, .tick = delta.tick, .place_m = place_m, .text = region.name, .body = id, .tag = tag});
}

/// A way whose box holds all of them; apart from everything where there are none.
Way hull_of_ways(std::span<const Way> ways) {
  constexpr float far_m = std::numeric_limits<float>::max();
  Way all{.from_m = glm::vec3(far_m), .to_m = glm::vec3(far_m)};
  for (size_t i = 0; i < ways.size(); ++i) {
    const Way& way = ways[i];
    const glm::vec3 lo_m = glm::min(way.from_m, way.to_m), hi_m = glm::max(way.from_m, way.to_m);
    all.from_m = i == 0 ? lo_m : glm::min(all.from_m, lo_m);
    all.to_m = i == 0 ? hi_m : glm::max(all.to_m, hi_m);
  }
  return all;
}

/// The ways of all bodies in a step, by id; without those that are no more.
std::vector<Way> ways_of(const World::State& state, std::span<const BodyState> before) {
  std::vector<Way> ways;
  for (const BodyState& body : before)
    if (state.bodies.contains(body.id))
      ways.push_back({body.id, state.pieces.contains(body.id), body.pose.position_m,
                      state.bodies.state(body.id).pose.position_m});
  return ways;
}

using Noted = std::vector<WorldRegions::BodyInside>;

/// The bodies that are noted as in a region, in order: a copy, since what is told changes the notes.
Noted noted_in(const World::State& state, RegionId region) {
  const auto noted = state.regions.inside.find(region);
  return noted == state.regions.inside.end() ? Noted() : noted->second;
}

/// Whether an ascending list has the id; `next` goes on from id to id.
bool goes_to(Noted::const_iterator& next, Noted::const_iterator end, PieceId id) {
  while (next != end && next->id < id) ++next;
  return next != end && next->id == id;
}

/// Puts a piece back that came in from outside, to where it came in; of its speed it keeps what does not lead
/// inwards.
void keep_out(World::State& state, const Region& region, Way& way) {
  const PieceId id = way.id;
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

/// Where the note of a body stands, or would.
Noted::iterator place_in(Noted& noted, PieceId id) {
  return std::ranges::lower_bound(noted, id, {}, &WorldRegions::BodyInside::id);
}

void note(World::State& state, const Region& region, PieceId id) {
  Noted& noted = state.regions.inside[region.id];
  noted.insert(place_in(noted, id), {id, tag_of(state, id)});
}

/// Tells that the body is in the region or not, where it was otherwise. Whether it was.
bool tell_change(World::State& state, const Region& region, PieceId id, bool is_in,
                 std::optional<glm::vec3> place_m, TickDelta& delta) {
  Noted& noted = state.regions.inside[region.id];
  const auto place = place_in(noted, id);
  const bool was_in = place != noted.end() && place->id == id;
  if (is_in == was_in) return false;
  tell(is_in ? EventKind::region_enter : EventKind::region_leave, region, id,
       is_in ? tag_of(state, id) : place->tag, place_m, delta);
  if (is_in)
    note(state, region, id);
  else
    noted.erase(place);
  return true;
}

void tell_crossing(World::State& state, const Region& region, const Way& way, TickDelta& delta) {
  const PieceId id = way.id;
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
  std::vector<Way> ways = ways_of(state, before);
  const Way all = hull_of_ways(ways);
  const auto regions = state.regions.shared();
  for (const Region& region : *regions) {
    if (!region.forbids_any(forbids::pieces)) continue;
    const RegionBounds bounds = bounds_of(region);
    if (misses(bounds, all)) continue;
    for (Way& way : ways)
      if (way.is_piece && !misses(bounds, way)) keep_out(state, region, way);
  }
  for (const Region& region : *regions) {
    if (!region.tells) continue;
    const RegionBounds bounds = bounds_of(region);
    if (misses(bounds, all) && !state.regions.inside.contains(region.id)) continue;
    const Noted noted = noted_in(state, region.id);
    auto next = noted.cbegin();
    for (const Way& way : ways) {
      const bool was_in = goes_to(next, noted.cend(), way.id);
      if (was_in ? holds(region, way.to_m) : misses(bounds, way)) continue;
      tell_crossing(state, region, way, delta);
    }
  }
}

void tell_of_regions(World::State& state, TickDelta& delta) {
  if (!state.regions.tell()) return;
  const std::vector<BodyState> bodies = state.bodies.states();
  std::vector<Way> places;
  for (const BodyState& body : bodies)
    places.push_back({body.id, false, body.pose.position_m, body.pose.position_m});
  const Way all = hull_of_ways(places);
  const auto regions = state.regions.shared();
  for (const Region& region : *regions) {
    if (!region.tells) continue;
    if (misses(bounds_of(region), all) && !state.regions.inside.contains(region.id)) continue;
    const Noted noted = noted_in(state, region.id);
    auto next = noted.cbegin();
    const auto tell_gone_before = [&](PieceId id) {
      for (; next != noted.cend() && next->id < id; ++next)
        if (!state.bodies.contains(next->id))
          tell_change(state, region, next->id, false, std::nullopt, delta);
    };
    for (const BodyState& body : bodies) {
      tell_gone_before(body.id);
      const bool was_in = next != noted.cend() && next->id == body.id;
      const glm::vec3 place_m = body.pose.position_m;
      if (const bool is_in = holds(region, place_m); is_in != was_in)
        tell_change(state, region, body.id, is_in, place_m, delta);
    }
    tell_gone_before(std::numeric_limits<PieceId>::max());
  }
}

void note_inside(World::State& state, RegionId id) {
  const auto& regions = state.regions.all();
  const auto region = std::ranges::lower_bound(regions, id, {}, &Region::id);
  CHECK(region != regions.end() && region->id == id);
  for (const BodyState& body : state.bodies.states())
    if (holds(*region, body.pose.position_m)) note(state, *region, body.id);
}

}  // namespace scree
