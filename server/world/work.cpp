#include "server/world/work.h"

#include "server/world/limits.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

float cost_of(const Bodies& bodies) {
  return limits::body_cost_us * static_cast<float>(bodies.awake()) +
         limits::contact_cost_us * static_cast<float>(bodies.contact_points());
}

/// Voxels of an edit's box; 0 for a shape that will be refused: its box may not fit integers.
float voxels_of(const Shape& shape, float voxel_size_m) {
  if (!validate(Operation(FillOperation{shape}), {}, voxel_size_m)) return 0.0F;
  const VoxelCoord size = band_box(in_voxels(shape, voxel_size_m)).size();
  return static_cast<float>(size.x) * static_cast<float>(size.y) * static_cast<float>(size.z);
}

struct Costing {
  float voxel_size_m;

  float operator()(const CarveRequest& request) const {
    return limits::edit_voxel_cost_us * voxels_of(request.shape, voxel_size_m) +
           limits::seed_cost_us * static_cast<float>(request.seeds);
  }
  float operator()(const FillRequest& request) const {
    return limits::edit_voxel_cost_us * voxels_of(request.shape, voxel_size_m);
  }
  float operator()(const PaintRequest& request) const {
    return limits::edit_voxel_cost_us * voxels_of(request.shape, voxel_size_m);
  }
  float operator()(const SettingsRequest&) const { return 0.0F; }
};

}  // namespace

WorkBudget::WorkBudget(uint32_t tick_rate_hz)
    : budget_us_(limits::work_share * 1e6F / static_cast<float>(tick_rate_hz)) {
  CHECK(tick_rate_hz > 0);
}

void WorkBudget::begin(const Bodies& bodies) {
  bodies_us_ = cost_of(bodies);
  spent_us_ = bodies_us_;
}

void WorkBudget::stepped(const Bodies& bodies) {
  const float before_us = bodies_us_;
  bodies_us_ = cost_of(bodies);
  spent_us_ += bodies_us_ - before_us;
  CHECK(spent_us_ >= 0.0F);
}

bool WorkBudget::crowded() const {
  return bodies_us_ > limits::crowded_share * budget_us_;
}

void WorkBudget::report(TickWork& work) const {
  work.budget_us = static_cast<uint32_t>(budget_us_);
  work.estimate_us = static_cast<uint32_t>(spent_us_);
}

float cost_us(const Command& command, float voxel_size_m) {
  return std::visit(Costing{voxel_size_m}, command.body);
}

}  // namespace scree
