// A stamp worked out before it is applied: whoever plans one has its codes already, and apply() takes them,
// when nothing has changed since, instead of working them out again. What apply() does is the same without.
#pragma once

#include "shared/field/operation.h"

namespace scree {

struct PreparedStamp {
  StampOperation operation;
  std::shared_ptr<const Volume> volume;
  uint64_t field_hash = 0;
  Window after;  ///< empty for methods that prepare nothing but the operation
  MassUnits gain = 0;

  /// Whether applying that operation to this field, where the piece has this volume, gives `after`.
  bool holds(const StampOperation& op, const Field& field,
             const std::shared_ptr<const Volume>& volume_now) const {
    return !after.codes.empty() && operation == op && volume == volume_now && field_hash == field.hash();
  }
};

/// Plans the merge of a piece at a pose, by a method: its operation's shift meets the budget as plan_stamp
/// says. The piece must be in the table.
PreparedStamp prepare_stamp(Field& field, const PieceTable& pieces, PieceId piece, const QuantisedPose& pose,
                            StampMethod method, MassUnits budget);

}  // namespace scree
