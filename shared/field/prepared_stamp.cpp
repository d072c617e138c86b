#include "shared/field/prepared_stamp.h"

#include "shared/field/stamp_method.h"

namespace scree {

PreparedStamp prepare_stamp(Field& field, const PieceTable& pieces, PieceId piece, const QuantisedPose& pose,
                            StampMethod method, MassUnits budget) {
  const float dx = field.source().voxel_size_m;
  PreparedStamp prepared{{piece, pose, 0, method}, pieces.at(piece), field.hash(), {}, 0};
  const Volume& volume = *prepared.volume;
  StampPlan plan;
  if (method == StampMethod::stamp) {
    const Window laid = lay(volume, pose, dx);
    prepared.after = gather(field, reach_of(laid));
    plan = plan_laid(prepared.after, laid, volume.mass, budget);
  } else {
    const Window window = gather(field, stamp_box(method, volume, pose, dx));
    plan = plan_stamp(method, window, volume, pose, dx, budget);
  }
  prepared.operation.shift = plan.shift;
  prepared.gain = plan.gain;
  return prepared;
}

}  // namespace scree
