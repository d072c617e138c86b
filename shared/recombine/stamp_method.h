// The methods by which a piece becomes terrain again, each a row of one table, and one interface to them all.
// A method decides bits, so it crosses the wire.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

#include "shared/base/kind_table.h"
#include "shared/recombine/stamp.h"
#include "shared/recombine/stamp_slices.h"
#include "shared/recombine/stamp_sphere.h"

namespace scree {

/// stamp and facets: stamp.h, with edges that give way and with edges that stay. slices: the paper's
/// (stamp_slices.h). sphere: that of the paper's program (stamp_sphere.h).
enum class StampMethod : uint8_t { stamp = 0, slices = 1, sphere = 2, facets = 3 };

/// A method that merges one piece at a time, by functions as those below.
struct WholeStamp {
  VoxelBox (*box)(const Volume& volume, const QuantisedPose& pose, float voxel_size_m) = nullptr;
  void (*stamp)(Window& window, const Volume& volume, const QuantisedPose& pose, float voxel_size_m,
                int shift) = nullptr;
  StampPlan (*plan)(const Window& window, const Volume& volume, const QuantisedPose& pose, float voxel_size_m,
                    MassUnits budget, const MergeFills& fills) = nullptr;
};

struct StampMethodRow {
  std::string_view name;
  uint8_t wire;                          ///< its number in a stamp (proto/operation_codec.cpp)
  std::optional<uint8_t> wire_together;  ///< the same, where several pieces merge at once
  float price_us;                        ///< the model's price of a merge, without its voxels
  std::variant<WholeStamp, Laying> kernel;
};

constexpr StampMethodRow row_of(StampMethod method) {
  switch (method) {
    case StampMethod::stamp:
      return {.name = "stamp", .wire = 0, .wire_together = 3, .price_us = 55.0F, .kernel = laying_rounded};
    case StampMethod::slices:
      return {.name = "slices",
              .wire = 1,
              .wire_together = {},
              .price_us = 60.0F,
              .kernel = WholeStamp{stamp_box, stamp_slices, plan_slices}};
    case StampMethod::sphere:
      return {.name = "sphere",
              .wire = 2,
              .wire_together = {},
              .price_us = 170.0F,
              .kernel = WholeStamp{stamp_sphere_box, stamp_sphere, plan_sphere}};
    case StampMethod::facets:
      return {.name = "facets", .wire = 4, .wire_together = 5, .price_us = 150.0F, .kernel = laying_faceted};
  }
  return {};
}

/// Whether the known method is made of lay() and stamp_laid().
constexpr bool lays(StampMethod method) {
  return std::holds_alternative<Laying>(traits_of(method).kernel);
}

/// How a method that lays does so.
constexpr const Laying& laying_of(StampMethod method) {
  CHECK(lays(method));
  return std::get<Laying>(traits_of(method).kernel);
}

/// Where another method's window would be too large: the one whose window is the piece's own.
inline constexpr StampMethod smallest_stamp = StampMethod::stamp;
/// Where another method's gain would be over the budget: one whose gain never is.
inline constexpr StampMethod bounded_stamp = StampMethod::slices;

/// The voxels that a stamp by this method may read and change, whatever its shift.
VoxelBox stamp_box(StampMethod method, const Volume& volume, const QuantisedPose& pose, float voxel_size_m);

/// Merges the piece into `window`, which must cover the method's stamp_box(); the shift lies within
/// ±stamp_shift_max.
void stamp(StampMethod method, Window& window, const Volume& volume, const QuantisedPose& pose,
           float voxel_size_m, int shift);

/// Finds the shift whose gain comes nearest the budget, and this gain, exactly; each method's own plan says
/// when the gain may exceed the budget. With a method that lays, all must be solid; else plan_laid() plans.
StampPlan plan_stamp(StampMethod method, const Window& window, const Volume& volume,
                     const QuantisedPose& pose, float voxel_size_m, MassUnits budget,
                     const MergeFills& fills = {});

}  // namespace scree
