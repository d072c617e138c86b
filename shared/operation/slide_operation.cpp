#include "shared/operation/slide_operation.h"

#include "shared/base/check.h"

namespace scree {

SlideTerms terms_of(const SlideOperation& op) {
  return {.box = op.box, .material = op.material, .tangent = op.tangent, .cell = op.cell};
}

std::optional<Slid> plan_slide(const SlideOperation& op, const Field& field) {
  const RubbleRows& rows = field.rubble();
  // What a merge would make something else of is neither rubble nor loose.
  if (rows.rubble[row_number(op.material)] != op.material) return std::nullopt;
  const Window before = gather(field, slide_window(op.box));
  const MaterialReader were(field, before.box);
  return slide(were, rows, before, terms_of(op));
}

Applied apply_slide(const SlideOperation& op, Field& field) {
  Applied applied;
  const std::optional<Slid> slid = plan_slide(op, field);
  if (!slid) return applied;
  CHECK(slid->added.gains.empty());
  applied.changed = scatter(field, slid->after, slid->added.says);
  return applied;
}

}  // namespace scree
