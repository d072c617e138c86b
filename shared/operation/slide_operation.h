// How a slide is applied. Private to operations.
#pragma once

#include "shared/operation/operation.h"
#include "shared/recombine/slide.h"

namespace scree {

/// The kernel's view of the operation.
SlideTerms terms_of(const SlideOperation& op);

/// What the operation would make of the field; nothing where it changes nothing.
std::optional<Slid> plan_slide(const SlideOperation& op, const Field& field);

/// Applies a valid slide. The terrain's mass, and that of each material, stays as it was.
Applied apply_slide(const SlideOperation& op, Field& field);

}  // namespace scree
