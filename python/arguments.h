// Arguments from Python, checked: numbers are finite and within bounds, boxes have sides that are positive.
// Everything else is a ValueError or a TypeError, so that no call reaches a CHECK.
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "shared/base/kind_table.h"
#include "shared/field/coord.h"

namespace scree::python {

namespace limits {
/// Voxels of one array: 1 GB of distances. Above: refused.
inline constexpr int64_t array_voxels_max = int64_t{1} << 28U;
/// Places of one array of questions. Above: refused.
inline constexpr int64_t places_max = int64_t{1} << 24U;
/// Ticks of one call: 4.6 hours at 60 Hz. Above: refused.
inline constexpr int64_t ticks_max = 1'000'000;
/// Any number that is given, to either side of 0: all sums with it stay finite.
inline constexpr double number_max = 1e12;
}  // namespace limits

/// A number that is finite, named `what` in the error.
float number_of(double value, const char* what);
/// Three numbers, as a sequence or an array; a place in metres as a rule.
glm::vec3 vector_of(const pybind11::handle& value, const char* what);
/// A rotation (w, x, y, z), made a unit one.
glm::quat rotation_of(const pybind11::handle& value, const char* what);
/// Many places, of an array of shape (n, 3) that is read as it lies or converted.
std::vector<glm::vec3> places_of(const pybind11::handle& value, const char* what);
/// A whole number within bounds.
int64_t whole_of(int64_t value, int64_t least, int64_t most, const char* what);
/// Voxels lo (in it) to hi (not in it), of a world of that voxel size, which bounds them.
VoxelBox box_of(const pybind11::handle& lo, const pybind11::handle& hi, float voxel_m);

/// A kind by its name in the table.
template <HasRows Kind>
Kind kind_of(const std::string& name, const char* what) {
  if (const auto kind = kind_named<Kind>(name)) return *kind;
  throw pybind11::value_error("the " + std::string(what) + " '" + name + "' is not a known one (" +
                              listed(kind_names<Kind>) + ")");
}

pybind11::tuple tuple_of(glm::vec3 v);

}  // namespace scree::python
