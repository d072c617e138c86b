#include "shared/operation/prepared_stamp.h"

#include "shared/base/check.h"
#include "shared/recombine/stamp_materials.h"

namespace scree {

Window lay_all(const StampOperation& op, const std::vector<std::shared_ptr<const Volume>>& volumes,
               float voxel_size_m) {
  CHECK_EQ(volumes.size(), op.others.size() + 1);
  const Laying& laying = laying_of(op.method);
  std::vector<Window> laid{lay(laying, *volumes.front(), op.pose, voxel_size_m)};
  for (size_t i = 0; i < op.others.size(); ++i)
    laid.push_back(lay(laying, *volumes[i + 1], op.others[i].pose, voxel_size_m));
  return together(std::move(laid));
}

namespace {

MergeFills fills_of(const StampOperation& op, const PreparedStamp& prepared, const Field& field) {
  std::vector<MergedPiece> merged{{*prepared.volumes.front(), op.pose}};
  for (size_t i = 0; i < op.others.size(); ++i)
    merged.push_back({*prepared.volumes[i + 1], op.others[i].pose});
  return merge_fills(MaterialReader(field, prepared.before.box), field.rubble(), merged, op.brings,
                     field.source().voxel_size_m);
}

}  // namespace

PreparedStamp prepare_group(Field& field, const PieceTable& pieces, std::span<const StampedPiece> group,
                            StampMethod method, MassUnits budget, Brings brings) {
  CHECK(lays(method));
  CHECK(can_merge_together(group, pieces) || group.size() == 1);
  PreparedStamp prepared;
  prepared.field_hash = field.hash();
  StampOperation& op = prepared.operation;
  op.piece = group.front().piece;
  op.pose = group.front().pose;
  op.method = method;
  op.brings = brings;
  op.others.assign(group.begin() + 1, group.end());
  MassUnits mass = 0;
  for (const StampedPiece& one : group) {
    prepared.volumes.push_back(pieces.at(one.piece));
    mass += prepared.volumes.back()->mass;
  }
  const Window laid = lay_all(op, prepared.volumes, field.source().voxel_size_m);
  prepared.before = gather(field, merge_box(laid));
  prepared.after = prepared.before;
  const StampPlan plan =
      plan_laid(laying_of(method), prepared.after, laid, mass, budget, fills_of(op, prepared, field));
  op.shift = plan.shift;
  prepared.gain = plan.gain;
  return prepared;
}

PreparedStamp prepare_stamp(Field& field, const PieceTable& pieces, PieceId piece, const QuantisedPose& pose,
                            StampMethod method, MassUnits budget, Brings brings) {
  const StampedPiece alone[] = {{piece, pose}};
  if (lays(method)) return prepare_group(field, pieces, alone, method, budget, brings);
  const float dx = field.source().voxel_size_m;
  PreparedStamp prepared;
  prepared.operation.piece = piece;
  prepared.operation.pose = pose;
  prepared.operation.method = method;
  prepared.operation.brings = brings;
  prepared.field_hash = field.hash();
  prepared.volumes.push_back(pieces.at(piece));
  const Volume& volume = *prepared.volumes.front();
  const Window window = gather(field, stamp_box(method, volume, pose, dx));
  const MergedPiece merged[] = {{volume, pose}};
  const StampPlan plan =
      plan_stamp(method, window, volume, pose, dx, budget,
                 merge_fills(MaterialReader(field, window.box), field.rubble(), merged, brings, dx));
  prepared.operation.shift = plan.shift;
  prepared.gain = plan.gain;
  return prepared;
}

}  // namespace scree
