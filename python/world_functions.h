// What the parts of World share.
#pragma once

#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "python/held_world.h"

namespace scree::python {

/// A configuration of arguments and settings; ValueError: one that no world has.
WorldConfig config_of(const std::string& terrain, int64_t seed, double voxel_m, int64_t tick_rate_hz,
                      const pybind11::dict& settings);
/// One command, several, or none. TypeError: something else.
std::vector<Command> commands_of(const pybind11::object& commands);

using WorldClass = pybind11::class_<HeldWorld, Held>;
/// Arrays of boxes of voxels.
void add_arrays_of(WorldClass& world);
/// Questions about space, and `Hit`.
void add_queries(pybind11::module_& module, WorldClass& world);

}  // namespace scree::python
