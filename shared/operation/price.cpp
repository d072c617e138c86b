#include "shared/operation/price.h"

#include "shared/base/check.h"
#include "shared/falling/island.h"
#include "shared/field/edit.h"
#include "shared/operation/limits.h"
#include "shared/recombine/slide.h"

namespace scree {

namespace {

struct OperationPricing {
  const Field& field;
  const PieceTable& pieces;

  float voxels_of_piece(PieceId id) const { return voxels_of(pieces.at(id)->window.box); }
  float merge_us(PieceId id, StampMethod method) const { return merge_price_us(method, voxels_of_piece(id)); }

  float operator()(const CarveOperation& carve) const {
    const float voxels = voxels_of(band_box(in_voxels(carve.shape, field.source().voxel_size_m)));
    return edit_price_us(carve.shape, field) + cut_price_us(carve.cutter, voxels, carve.seeds);
  }
  float operator()(const FillOperation& fill) const { return edit_price_us(fill.shape, field); }
  float operator()(const PaintOperation& paint) const { return edit_price_us(paint.shape, field); }
  float operator()(const StampOperation& stamp) const {
    float sum_us = merge_us(stamp.piece, stamp.method);
    for (const StampedPiece& other : stamp.others) sum_us += merge_us(other.piece, stamp.method);
    return sum_us;
  }
  float operator()(const DiscardOperation&) const { return 0.0F; }
  float operator()(const ShatterOperation& shatter) const {
    const float voxels = voxels_of_piece(shatter.piece);
    const float rest_us = shatter.cut ? rest_price_us(voxels) : 0.0F;
    return rest_us + cut_price_us(shatter.cutter, voxels, shatter.seeds);
  }
  float operator()(const IslandOperation& island) const { return lift_price_us(island.box); }
  float operator()(const DigOperation& dig) const {
    return dig.piece != 0 ? 0.0F : edit_price_us(dig.shape, field);
  }
  float operator()(const PlaceOperation& place) const { return edit_price_us(place.shape, field); }
  float operator()(const RestoreOperation& restore) const {
    return restore_price_us(restore.bricks ? restore.bricks->size() : 0);
  }
  float operator()(const SlideOperation& slide) const { return slide_price_us(slide.box); }
};

}  // namespace

size_t untouched_chunks(const VoxelBox& box, const Field& field) {
  const ChunkCoord lo = chunk_of(brick_of(box.lo)), hi = chunk_of(brick_of(box.hi));
  size_t count = 0;
  for (int x = lo.x; x <= hi.x; ++x)
    for (int y = lo.y; y <= hi.y; ++y)
      for (int z = lo.z; z <= hi.z; ++z) count += field.has_edits({x, y, z}) ? 0 : 1;
  return count;
}

float edit_price_us(const Shape& shape, const Field& field) {
  const float dx = field.source().voxel_size_m;
  CHECK(validate(Operation(FillOperation{shape}), {}, dx));
  const VoxelBox box = band_box(in_voxels(shape, dx));
  return limits::edit_cost_us + limits::edit_voxel_cost_us * voxels_of(box) +
         limits::chunk_cost_us * static_cast<float>(untouched_chunks(box, field));
}

float voxels_of(const VoxelBox& box) {
  const VoxelCoord size = box.size();
  return static_cast<float>(size.x) * static_cast<float>(size.y) * static_cast<float>(size.z);
}

float cut_price_us(Cutter cutter, float voxels, uint32_t pieces) {
  const CutPrice& price = traits_of(cutter).price;
  return price.volume_us + price.voxel_us * voxels + price.piece_us * static_cast<float>(pieces);
}

float merge_price_us(StampMethod method, float voxels) {
  return traits_of(method).price_us + limits::stamp_voxel_cost_us * voxels;
}

float lift_price_us(const VoxelBox& box) {
  return limits::lift_cost_us + limits::lift_voxel_cost_us * voxels_of(lift_box(box));
}

float rest_price_us(float voxels) {
  return limits::lift_cost_us + limits::lift_voxel_cost_us * voxels;
}

float restore_price_us(size_t bricks) {
  return limits::edit_cost_us + limits::restored_brick_cost_us * static_cast<float>(bricks);
}

float slide_price_us(const VoxelBox& box) {
  return limits::slide_cost_us + limits::slide_voxel_cost_us * voxels_of(slide_window(box));
}

float price_us(const Operation& operation, const Field& field, const PieceTable& pieces) {
  return std::visit(OperationPricing{field, pieces}, operation);
}

}  // namespace scree
