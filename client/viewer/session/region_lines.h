// Regions in which this person may not edit (shared/region/region.h), as lines over the picture.
#pragma once

#include "client/render/scene/line_list.h"
#include "client/viewer/session/viewer_session.h"

namespace scree {

/// The outlines of those near the eye, metres.
void add_regions_of(ViewerSession& session, LineList& lines, glm::vec3 eye_m);

/// Whether the server refuses an edit of this shape because it lies in one, as far as it has told so.
bool is_in_closed_region(ViewerSession& session, const Shape& shape);

}  // namespace scree
