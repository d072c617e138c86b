#include "client/viewer/session/region_lines.h"

#include <algorithm>

namespace scree {

namespace {

constexpr LineColour region_colour{255, 90, 60, 170};

/// Farther ones are not drawn: a town's would hide it.
constexpr float region_seen_m = 96.0F;

bool is_closed(const ViewerSession& session, const Region& region) {
  return region.forbids_any(forbids::edits) && !may_edit(region, session.asker());
}

void add_outline(LineList& lines, const Region& region) {
  const RegionBounds bounds = bounds_of(region);
  const glm::vec3 up(0.0F, region.half_m.y, 0.0F);
  switch (region.form) {
    case RegionForm::box:
      return lines.box(bounds.lo_m, bounds.hi_m, region_colour);
    case RegionForm::sphere:
      return lines.shape(sphere(region.centre_m, region.half_m.x), region_colour);
    case RegionForm::cylinder:
      return lines.tube(region.centre_m - up, region.centre_m + up, region.half_m.x, region_colour);
  }
}

}  // namespace

void add_regions_of(ViewerSession& session, LineList& lines, glm::vec3 eye_m) {
  const Mirror* const mirror = session.mirror();
  if (mirror == nullptr || session.is_replay()) return;
  for (const Region& region : mirror->regions())
    if (is_closed(session, region) && distance(region, eye_m) <= region_seen_m) add_outline(lines, region);
}

bool is_in_closed_region(ViewerSession& session, const Shape& shape) {
  const Mirror* const mirror = session.mirror();
  return mirror != nullptr &&
         std::any_of(mirror->regions().begin(), mirror->regions().end(), [&](const Region& region) {
           return is_closed(session, region) && meets(region, shape);
         });
}

}  // namespace scree
