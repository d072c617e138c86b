#include "server/work/price.h"

#include <algorithm>

#include "server/work/limits.h"
#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/field/edit.h"

namespace scree {

namespace {

struct Pricing {
  const Field& field;
  Cutter cutter;

  static float seeds_price_us(const CarveRequest& request) {
    if (!is_relaxed(request.pattern)) return 0.0F;
    return std::max(limits::relax_cost_us, limits::relax_seed_cost_us * static_cast<float>(request.seeds));
  }

  float operator()(const CarveRequest& request) const {
    CHECK(request.seeds <= limits::seeds_max);
    if (request.piece != 0)
      return rest_price_us(limits::broken_voxels) +
             cut_price_us(cutter, limits::broken_voxels, request.seeds);
    const float own = edit_price_us(request.shape, field);
    const float voxels = voxels_of(band_box(in_voxels(request.shape, field.source().voxel_size_m)));
    return own + seeds_price_us(request) + cut_price_us(cutter_for(cutter, voxels), voxels, request.seeds);
  }
  float operator()(const FillRequest& request) const { return edit_price_us(request.shape, field); }
  float operator()(const PaintRequest& request) const { return edit_price_us(request.shape, field); }
  float operator()(const SettingsRequest&) const { return 0.0F; }
  float operator()(const LeaveRequest&) const { return 0.0F; }
  float operator()(const AddPropRequest& request) const {
    float price_us = limits::prop_cost_us;
    for (const PropPart& part : request.prop.parts) {
      const auto corners = static_cast<float>(part.corners_m.size());
      price_us += limits::prop_part_cost_us + limits::prop_corner_cost_us * corners +
                  limits::prop_plane_cost_us * corners * corners * corners;
    }
    return price_us;
  }
  float operator()(const RemovePropRequest&) const { return limits::prop_touch_cost_us; }
  float operator()(const MovePropRequest&) const { return limits::prop_cost_us; }
  float operator()(const PushRequest&) const { return limits::prop_touch_cost_us; }
  float operator()(const BlastRequest& request) const {
    const float dx = field.source().voxel_size_m;
    const Shape shape = sphere(request.centre_m, blast_reach_m(request.energy_j, dx));
    const float voxels = voxels_of(band_box(in_voxels(shape, dx)));
    return edit_price_us(shape, field) + limits::blast_voxel_cost_us * voxels +
           cut_price_us(cutter_for(cutter, voxels), voxels, pieces_of_blast(request.energy_j));
  }
  float operator()(const AddJointRequest&) const { return limits::prop_touch_cost_us; }
  float operator()(const RemoveJointRequest&) const { return limits::prop_touch_cost_us; }
  float operator()(const SetMotorRequest&) const { return limits::prop_touch_cost_us; }
  float operator()(const CutOutRequest& request) const {
    const float voxels = voxels_of(band_box(in_voxels(request.shape, field.source().voxel_size_m)));
    return edit_price_us(request.shape, field) + cut_price_us(cheapest_cutter, voxels, 1) +
           rest_price_us(voxels);
  }
  float operator()(const ReleaseRequest&) const { return limits::prop_touch_cost_us; }
  float operator()(const SetRegionRequest&) const { return limits::prop_cost_us; }
  float operator()(const RemoveRegionRequest&) const { return limits::prop_cost_us; }
  float operator()(const AddPieceRequest& request) const {
    CHECK(request.volume != nullptr);
    return added_price_us(Window::count(request.volume->window.box));
  }
  float operator()(const StandRequest&) const { return limits::prop_cost_us; }
  float operator()(const WalkRequest&) const { return 0.0F; }  // the tick's stage pays
  float operator()(const DigRequest& request) const {
    return request.piece != 0 ? limits::prop_touch_cost_us : edit_price_us(request.shape, field);
  }
  float operator()(const PlaceRequest& request) const { return edit_price_us(request.shape, field); }
  float operator()(const TransferRequest&) const { return limits::prop_touch_cost_us; }
  float operator()(const RulesRequest&) const { return 0.0F; }  // done at once
  float operator()(const RestoreRequest& request) const {
    return restore_price_us(request.bricks == nullptr ? 0 : request.bricks->size());
  }
  float operator()(const BreakRequest& request) const {
    CHECK(request.seeds <= limits::seeds_max);
    return cut_price_us(cutter, limits::broken_voxels, request.seeds);
  }
};

}  // namespace

uint32_t pieces_at_once(Cutter cutter, float voxels, uint32_t wanted) {
  const CutPrice& least = traits_of(cheapest_cutter).price;
  const float left_us = limits::first_fracture_us - least.volume_us - least.voxel_us * voxels;
  const float each_us = traits_of(cutter).price.piece_us;
  const auto paid =
      std::max(limits::first_fracture_pieces_min, static_cast<uint32_t>(std::max(left_us, 0.0F) / each_us));
  return wanted <= paid + paid / 2 ? wanted : paid;
}

Cutter cutter_for(Cutter wanted, float voxels, float limit_us) {
  return cut_price_us(wanted, voxels, 2) > limit_us ? cheapest_cutter : wanted;
}

float added_price_us(size_t voxels) {
  return limits::added_cost_us + limits::added_voxel_cost_us * static_cast<float>(voxels);
}

float price_us(const Request& request, const Field& field, Cutter cutter) {
  return std::visit(Pricing{field, cutter}, request);
}

}  // namespace scree
