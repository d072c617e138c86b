#include "server/work/price.h"

#include <algorithm>

#include "server/work/limits.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/falling/island.h"
#include "shared/field/edit.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

/// Whether parts of the volume are computed as polygons.
bool cuts_polygons(Cutter cutter) {
  switch (cutter) {
    case Cutter::field:
      return false;
    case Cutter::slice:
    case Cutter::conform:
      break;
  }
  return true;
}

/// Chunks of the box that no edit has touched: their terrain may have to be generated. Whether it has been is
/// not part of the simulation's state.
size_t untouched_chunks(const VoxelBox& box, const Field& field) {
  const ChunkCoord lo = chunk_of(brick_of(box.lo)), hi = chunk_of(brick_of(box.hi));
  size_t count = 0;
  for (int x = lo.x; x <= hi.x; ++x)
    for (int y = lo.y; y <= hi.y; ++y)
      for (int z = lo.z; z <= hi.z; ++z) count += field.has_edits({x, y, z}) ? 0 : 1;
  return count;
}

/// Reading and changing the field in a valid shape's box.
float edit_price_us(const Shape& shape, const Field& field) {
  const float dx = field.source().voxel_size_m;
  CHECK(validate(Operation(FillOperation{shape}), {}, dx));
  const VoxelBox box = band_box(in_voxels(shape, dx));
  return limits::edit_cost_us + limits::edit_voxel_cost_us * voxels_of(box) +
         limits::chunk_cost_us * static_cast<float>(untouched_chunks(box, field));
}

struct Pricing {
  const Field& field;
  Cutter cutter;

  static float seeds_price_us(const CarveRequest& request) {
    if (!is_relaxed(request.pattern)) return 0.0F;
    return std::max(limits::relax_cost_us, limits::relax_seed_cost_us * static_cast<float>(request.seeds));
  }

  float operator()(const CarveRequest& request) const {
    CHECK(request.seeds <= limits::seeds_max);
    const float own = edit_price_us(request.shape, field);
    const float voxels = voxels_of(band_box(in_voxels(request.shape, field.source().voxel_size_m)));
    return own + seeds_price_us(request) + cut_price_us(cutter_for(cutter, voxels), voxels, request.seeds);
  }
  float operator()(const FillRequest& request) const { return edit_price_us(request.shape, field); }
  float operator()(const PaintRequest& request) const { return edit_price_us(request.shape, field); }
  float operator()(const SettingsRequest&) const { return 0.0F; }
};

}  // namespace

float voxels_of(const VoxelBox& box) {
  const VoxelCoord size = box.size();
  return static_cast<float>(size.x) * static_cast<float>(size.y) * static_cast<float>(size.z);
}

float cut_price_us(Cutter cutter, float voxels, uint32_t pieces) {
  const auto count = static_cast<float>(pieces);
  if (cuts_polygons(cutter))
    return limits::polygons_cost_us + limits::polygons_voxel_cost_us * voxels +
           limits::polygons_piece_cost_us * count;
  return limits::cut_cost_us + limits::cut_voxel_cost_us * voxels + limits::piece_cost_us * count;
}

uint32_t pieces_at_once(Cutter cutter, float voxels, uint32_t wanted) {
  const float each = cuts_polygons(cutter) ? limits::polygons_piece_cost_us : limits::piece_cost_us;
  const float left_us = limits::cut_at_once_us - limits::cut_cost_us - limits::cut_voxel_cost_us * voxels;
  const auto paid = std::max(limits::cut_at_once_min, static_cast<uint32_t>(std::max(left_us, 0.0F) / each));
  return wanted <= paid + paid / 2 ? wanted : paid;
}

Cutter cutter_for(Cutter wanted, float voxels, float limit_us) {
  return cut_price_us(wanted, voxels, 2) > limit_us ? Cutter::field : wanted;
}

float lift_price_us(const VoxelBox& box) {
  return limits::lift_cost_us + limits::lift_voxel_cost_us * voxels_of(lift_box(box));
}

float price_us(const Request& request, const Field& field, Cutter cutter) {
  return std::visit(Pricing{field, cutter}, request);
}

}  // namespace scree
