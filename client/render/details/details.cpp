#include "client/render/details/details.h"

#include <utility>

namespace scree {

Result<void> Details::follow(const Field& field, std::span<const BrickCoord> changed, glm::vec3 eye_m,
                             float range_m, glm::vec3 sun) {
  if (range_m > 0.0F && !drawer_) drawer_.emplace(TRY(DetailDrawer::create()));
  field_.follow(field, changed, eye_m, range_m, sun);
  return {};
}

void Details::draw(const DrawPass& pass) {
  if (!drawer_ || field_.count() == 0) return;
  for (std::vector<Detail>& list : lists_) list.clear();
  field_.add_to(lists_, Frustum(pass.view_projection), pass.eye_m,
                {.shadows = pass.kind == DrawPass::Kind::shadow, .floor_m = floor_m_});
  drawer_->draw(lists_, field_.range_m(), pass);
}

}  // namespace scree
