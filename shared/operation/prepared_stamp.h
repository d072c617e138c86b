// The result of a stamp, computed before the stamp is applied. Planning a stamp computes its codes; apply()
// uses them, if nothing has changed since, instead of computing them again. Its result is the same without.
#pragma once

#include "shared/operation/operation.h"

namespace scree {

struct PreparedStamp {
  StampOperation operation;
  std::vector<std::shared_ptr<const Volume>> volumes;  ///< of the piece and of the others
  uint64_t field_hash = 0;
  /// The terrain around the pieces as it is, and merged with them; empty for methods that prepare nothing but
  /// the operation.
  Window before, after;
  MassUnits gain = 0;

  /// Whether applying that operation to this field, where the pieces have these volumes, gives `after`.
  bool holds(const StampOperation& op, const Field& field,
             const std::vector<std::shared_ptr<const Volume>>& volumes_now) const {
    return !after.codes.empty() && operation == op && volumes == volumes_now && field_hash == field.hash();
  }
};

/// Plans the merge of a piece at a pose by a method (plan_stamp()), which chooses the operation's shift for
/// the budget. The piece must be in the table.
PreparedStamp prepare_stamp(Field& field, const PieceTable& pieces, PieceId piece, const QuantisedPose& pose,
                            StampMethod method, MassUnits budget, Brings brings = Brings::rubble);

/// Plans the merge of several pieces in one pass by a method that lays; they can_merge_together().
PreparedStamp prepare_group(Field& field, const PieceTable& pieces, std::span<const StampedPiece> group,
                            StampMethod method, MassUnits budget, Brings brings = Brings::rubble);

/// All of the operation's pieces on the terrain's grid, in one window; `volumes` has the operation's order.
Window lay_all(const StampOperation& op, const std::vector<std::shared_ptr<const Volume>>& volumes,
               float voxel_size_m);

}  // namespace scree
