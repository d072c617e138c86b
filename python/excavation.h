// An excavation as a task for learning: what an agent sees of a world, and what its action does there. Pure
// functions of a world; no Python. Metres.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "server/command/command.h"
#include "shared/field/field.h"

namespace scree::python {

/// Heights of the highest rock in the box's columns, every `step`-th in x and z, z fastest; metres. NaN: the
/// column has none in the box.
void column_heights(const Field& field, const VoxelBox& box, int step, std::span<float> heights_m);
/// Columns along x and z.
inline int columns_along(int size, int step) {
  return (size + step - 1) / step;
}

/// The task: a square of ground around the origin, seen as `cells`² heights.
struct Excavation {
  float half_m = 8.0F;   ///< of its side
  int cells = 16;        ///< along a side
  float reach_m = 1.0F;  ///< radius of the bucket
  float depth_max_m = 2.0F;
  float floor_m = -16.0F, top_m = 16.0F;  ///< heights that are seen
};

/// cells² heights from the ground's first level, x slowest.
void observe(const Field& field, const Excavation& task, std::span<float> heights_m);

/// Digs at (x, z) so deep into what lies there, into the world's store. The three numbers are put within
/// their bounds. Nothing: there is no rock.
std::optional<Command> dig_at(const Field& field, const Excavation& task, std::span<const float, 3> action);

}  // namespace scree::python
