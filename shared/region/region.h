// Regions: named boxes, spheres and upright cylinders in which a world forbids some of what happens
// elsewhere, and of which it tells who enters and leaves. Plain values. One that comes from outside is
// untrusted until validate() has passed it. Metres. The geometry uses + − × ÷ and sqrt alone: the same bits
// on both sides.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/base/ids.h"
#include "shared/base/kind_table.h"
#include "shared/base/result.h"
#include "shared/base/role.h"
#include "shared/field/shape.h"

namespace scree {

/// A region's id is from the same numbers as those of pieces, props and joints.
using RegionId = PieceId;

enum class RegionForm : uint8_t { box = 0, sphere = 1, cylinder = 2 };

struct RegionFormRow {
  std::string_view name;
};

constexpr RegionFormRow row_of(RegionForm form) {
  switch (form) {
    case RegionForm::box:
      return {"box"};
    case RegionForm::sphere:
      return {"sphere"};
    case RegionForm::cylinder:
      return {"cylinder"};
  }
  return {};
}

/// Who may edit in a region that forbids edits to others.
enum class RegionEditors : uint8_t { nobody = 0, role = 1, persons = 2, all = 3 };

struct RegionEditorsRow {
  std::string_view name;
};

constexpr RegionEditorsRow row_of(RegionEditors editors) {
  switch (editors) {
    case RegionEditors::nobody:
      return {"nobody"};
    case RegionEditors::role:  // Region::role, and those above it
      return {"role"};
    case RegionEditors::persons:  // Region::persons and Region::teams
      return {"persons"};
    case RegionEditors::all:
      return {"all"};
  }
  return {};
}

/// What a region forbids: bits.
namespace forbids {
inline constexpr uint8_t edits = 1;   ///< requests that edit terrain, of who may not edit there
inline constexpr uint8_t dents = 2;   ///< that blows dent or break terrain, and that loads crush it
inline constexpr uint8_t falls = 4;   ///< that terrain falls which it touches, and that rubble slides
inline constexpr uint8_t pieces = 8;  ///< that pieces come in
inline constexpr uint8_t all = 15;
}  // namespace forbids

struct RegionRule {
  std::string_view name;
  uint8_t bit = 0;
};
inline constexpr std::array<RegionRule, 4> region_rules = {{{"edits", forbids::edits},
                                                            {"dents", forbids::dents},
                                                            {"falls", forbids::falls},
                                                            {"pieces", forbids::pieces}}};

struct Region {
  RegionId id = 0;   ///< 0: none yet
  std::string name;  ///< unique in its world
  RegionForm form = RegionForm::box;
  glm::vec3 centre_m{0.0F};
  /// Half the sides of a box; x is the radius of a sphere and of a cylinder, and y half a cylinder's height.
  /// The rest counts for nothing.
  glm::vec3 half_m{1.0F};
  uint8_t forbids = 0;  ///< bits of forbids::
  RegionEditors editors = RegionEditors::nobody;
  Role role = Role::viewer;            ///< of RegionEditors::role
  std::vector<std::string> persons{};  ///< of RegionEditors::persons: names that access tokens state
  std::vector<std::string> teams{};    ///< likewise: teams that access tokens state
  bool tells = false;                  ///< bodies that enter and leave it are told as events
  bool counts = false;                 ///< what becomes of its rock is counted (region_mass.h)
  Tick until = 0;                      ///< the last tick in which it holds; 0: until it is removed

  bool forbids_any(uint8_t what) const { return (forbids & what) != 0; }
  bool operator==(const Region&) const = default;
};

/// Refuses what no world can take: names that cannot be shown, numbers beyond their bounds, a place outside
/// the world.
Result<void> validate(const Region& region);

/// Who asks for something: his role, and his name and team where an access token states them; else they are
/// empty.
struct Asker {
  Role role = Role::viewer;
  std::string name{};
  std::string team{};

  bool operator==(const Asker&) const = default;
};

/// Whether a region lets him edit there.
bool may_edit(const Region& region, const Asker& asker);

/// A box along the axes.
struct RegionBounds {
  glm::vec3 lo_m{0.0F}, hi_m{0.0F};
};
RegionBounds bounds_of(const Region& region);

/// Distance from a place to the region's surface, negative inside; outside it is exact.
float distance(const Region& region, glm::vec3 place_m);
/// Whether the place lies in it, its surface included.
bool holds(const Region& region, glm::vec3 place_m);
/// Whether it and that box have a place in common. Exact.
bool meets(const Region& region, glm::vec3 lo_m, glm::vec3 hi_m);
/// The same of a ball, and of the shape of an edit, of which a box counts without its rounded corners.
bool meets_ball(const Region& region, glm::vec3 centre_m, float radius_m);
bool meets(const Region& region, const Shape& shape);
/// Where a straight way from one place to another first lies in the region, as a share of it; nothing where
/// it misses it. 0: it begins there.
std::optional<float> first_in(const Region& region, glm::vec3 from_m, glm::vec3 to_m);
/// Unit, out of the region at a place on its surface: along the way on which it is left soonest.
glm::vec3 outward(const Region& region, glm::vec3 place_m);

/// The regions in which a place lies, in order.
std::vector<const Region*> regions_at(const std::vector<Region>& regions, glm::vec3 place_m);

}  // namespace scree
