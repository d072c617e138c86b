#include "shared/region/region.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/plain_number.h"
#include "shared/base/text.h"
#include "shared/region/limits.h"

namespace scree {

namespace {

bool is_number(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Result<void> check_name(const std::string& name, const std::string& whose) {
  if (name.empty() || name.size() > limits::region_name_bytes_max)
    return fail(whose + " has 1 to " + std::to_string(limits::region_name_bytes_max) + " bytes");
  if (name.find_first_not_of(' ') == std::string::npos) return fail(whose + " is blank");
  if (const auto fault = fault_of_text(name)) return fail(whose + " " + std::string(*fault));
  return {};
}

/// Half its extents along the axes.
glm::vec3 extents(const Region& region) {
  switch (region.form) {
    case RegionForm::box:
      return region.half_m;
    case RegionForm::sphere:
      return glm::vec3(region.half_m.x);
    case RegionForm::cylinder:
      return {region.half_m.x, region.half_m.y, region.half_m.x};
  }
  CHECK(is_known(region.form));
  return {};
}

float length_of(float a, float b) {
  return std::sqrt(a * a + b * b);
}

/// How far the nearest place of an interval about 0 is from a number.
float beyond(float at, float lo, float hi) {
  return std::max(std::max(lo - at, at - hi), 0.0F);
}

constexpr int halvings = 40;

/// Where between 0 and 1 a function that has one valley is least.
template <typename F>
float place_of_least(F&& f) {
  float lo = 0.0F, hi = 1.0F;
  for (int i = 0; i < 2 * halvings; ++i) {
    const float a = lo + (hi - lo) / 3.0F, b = hi - (hi - lo) / 3.0F;
    if (f(a) <= f(b))
      hi = b;
    else
      lo = a;
  }
  float least = 0.5F * (lo + hi);
  for (const float end : {0.0F, 1.0F})
    if (f(end) < f(least)) least = end;
  return least;
}

}  // namespace

Result<void> validate(const Region& region) {
  TRY(check_name(region.name, "the region's name"));
  TRY(validate_kind(region.form, "form of region"));
  TRY(validate_kind(region.editors, "kind of who may edit"));
  TRY(validate_kind(region.role, "role"));
  if (region.forbids > forbids::all) return fail("the region forbids something unknown");
  if (!is_number(region.centre_m) || !is_number(region.half_m))
    return fail("the region's place or size is not a finite number");
  const glm::vec3 size = extents(region);
  for (const float half : {size.x, size.y, size.z})
    if (!(half >= limits::region_half_min_m && half <= limits::region_half_max_m))
      return fail("half a side of the region must lie " +
                  range_text(limits::region_half_min_m, limits::region_half_max_m, "m"));
  const glm::vec3 far = glm::abs(region.centre_m);
  if (std::max(far.x, far.z) > limits::world_half_width_m || far.y > limits::world_half_height_m)
    return fail("the region's middle lies outside the world");
  if (region.persons.size() > limits::region_persons_max)
    return fail("a region names " + std::to_string(limits::region_persons_max) + " persons at most");
  for (const std::string& person : region.persons) TRY(check_name(person, "the name of a region's person"));
  if (region.teams.size() > limits::region_persons_max)
    return fail("a region names " + std::to_string(limits::region_persons_max) + " teams at most");
  for (const std::string& team : region.teams) TRY(check_name(team, "the name of a region's team"));
  return {};
}

namespace {

/// A name that no token states is none.
bool lists(const std::vector<std::string>& names, const std::string& name) {
  return !name.empty() && std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

bool may_edit(const Region& region, const Asker& asker) {
  switch (region.editors) {
    case RegionEditors::nobody:
      return false;
    case RegionEditors::role:
      return may_act_as(asker.role, region.role);
    case RegionEditors::persons:
      return lists(region.persons, asker.name) || lists(region.teams, asker.team);
    case RegionEditors::all:
      return true;
  }
  return false;
}

RegionBounds bounds_of(const Region& region) {
  const glm::vec3 size = extents(region);
  return {region.centre_m - size, region.centre_m + size};
}

float distance(const Region& region, glm::vec3 place_m) {
  const glm::vec3 off = place_m - region.centre_m;
  if (region.form == RegionForm::sphere) return std::sqrt(glm::dot(off, off)) - region.half_m.x;
  glm::vec3 q = glm::abs(off) - region.half_m;
  if (region.form == RegionForm::cylinder)
    q = {length_of(off.x, off.z) - region.half_m.x, glm::abs(off.y) - region.half_m.y, -1e9F};
  const glm::vec3 outside = glm::max(q, glm::vec3(0.0F));
  const float inside = std::min(std::max(q.x, std::max(q.y, q.z)), 0.0F);
  return std::sqrt(glm::dot(outside, outside)) + inside;
}

bool holds(const Region& region, glm::vec3 place_m) {
  return distance(region, place_m) <= 0.0F;
}

bool meets(const Region& region, glm::vec3 lo_m, glm::vec3 hi_m) {
  const glm::vec3 c = region.centre_m;
  const float x = beyond(c.x, lo_m.x, hi_m.x), y = beyond(c.y, lo_m.y, hi_m.y),
              z = beyond(c.z, lo_m.z, hi_m.z);
  const glm::vec3 half = region.half_m;
  switch (region.form) {
    case RegionForm::box:
      return x <= half.x && y <= half.y && z <= half.z;
    case RegionForm::sphere:
      return x * x + y * y + z * z <= half.x * half.x;
    case RegionForm::cylinder:
      return y <= half.y && x * x + z * z <= half.x * half.x;
  }
  CHECK(is_known(region.form));
  return false;
}

bool meets_ball(const Region& region, glm::vec3 centre_m, float radius_m) {
  return distance(region, centre_m) <= radius_m;
}

bool meets(const Region& region, const Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::sphere:
    case ShapeKind::crater:
      return meets_ball(region, shape.a, shape.radius_m);
    case ShapeKind::box: {
      const glm::vec3 half = shape.b + shape.radius_m;
      return meets(region, shape.a - half, shape.a + half);
    }
    case ShapeKind::capsule: {
      const auto away = [&](float t) { return distance(region, shape.a + (shape.b - shape.a) * t); };
      return away(place_of_least(away)) <= shape.radius_m;
    }
  }
  CHECK(is_known(shape.kind));
  return false;
}

std::optional<float> first_in(const Region& region, glm::vec3 from_m, glm::vec3 to_m) {
  const auto away = [&](float t) { return distance(region, from_m + (to_m - from_m) * t); };
  if (away(0.0F) <= 0.0F) return 0.0F;
  if (!meets(region, glm::min(from_m, to_m), glm::max(from_m, to_m))) return std::nullopt;
  float inside = away(1.0F) <= 0.0F ? 1.0F : place_of_least(away), outside = 0.0F;
  if (away(inside) > 0.0F) return std::nullopt;
  for (int i = 0; i < halvings; ++i) {
    const float middle = 0.5F * (outside + inside);
    (away(middle) <= 0.0F ? inside : outside) = middle;
  }
  return inside;
}

glm::vec3 outward(const Region& region, glm::vec3 place_m) {
  const glm::vec3 off = place_m - region.centre_m, up(0.0F, 1.0F, 0.0F);
  const auto unit = [&](glm::vec3 v) {
    const float length = std::sqrt(glm::dot(v, v));
    return length > 0.0F ? v / length : up;
  };
  const auto side = [](float at) { return at < 0.0F ? -1.0F : 1.0F; };
  if (region.form == RegionForm::sphere) return unit(off);
  const glm::vec3 q = glm::abs(off) - region.half_m;
  const glm::vec3 upright(0.0F, side(off.y), 0.0F);
  if (region.form == RegionForm::cylinder)
    return q.y > length_of(off.x, off.z) - region.half_m.x ? upright : unit({off.x, 0.0F, off.z});
  if (q.y >= std::max(q.x, q.z)) return upright;
  return q.x >= q.z ? glm::vec3(side(off.x), 0.0F, 0.0F) : glm::vec3(0.0F, 0.0F, side(off.z));
}

std::vector<const Region*> regions_at(const std::vector<Region>& regions, glm::vec3 place_m) {
  std::vector<const Region*> at;
  for (const Region& region : regions)
    if (holds(region, place_m)) at.push_back(&region);
  return at;
}

}  // namespace scree
