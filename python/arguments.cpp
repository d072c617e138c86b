#include "python/arguments.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "shared/base/limits.h"

namespace scree::python {

namespace py = pybind11;

namespace {

using Numbers = py::array_t<float, py::array::c_style | py::array::forcecast>;

Numbers numbers_of(const py::handle& value, const char* what) {
  Numbers numbers = Numbers::ensure(value);
  if (!numbers) {
    PyErr_Clear();
    throw py::type_error(std::string(what) + " has to be numbers");
  }
  const float* const data = numbers.data();
  for (py::ssize_t i = 0; i < numbers.size(); ++i) (void)number_of(static_cast<double>(data[i]), what);
  return numbers;
}

VoxelCoord voxel_of(const py::handle& value, const char* what, float voxel_m) {
  const auto sequence = py::reinterpret_borrow<py::object>(value);
  if (!py::isinstance<py::sequence>(sequence) && !py::isinstance<py::array>(sequence))
    throw py::type_error(std::string(what) + " has to be three whole numbers");
  if (py::len(sequence) != 3) throw py::value_error(std::string(what) + " has to be three whole numbers");
  const auto half_width = static_cast<int64_t>(scree::limits::world_half_width_m / voxel_m);
  const auto half_height = static_cast<int64_t>(scree::limits::world_half_height_m / voxel_m);
  int32_t numbers[3];
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t most = axis == 1 ? half_height : half_width;
    const py::object index =
        py::reinterpret_steal<py::object>(PyNumber_Index(py::object(sequence[py::int_(axis)]).ptr()));
    if (!index) throw py::error_already_set();
    numbers[axis] = static_cast<int32_t>(whole_of(index.cast<int64_t>(), -most, most, what));
  }
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

float number_of(double value, const char* what) {
  if (std::abs(value) <= limits::number_max) return static_cast<float>(value);
  throw py::value_error(std::string(what) + " has to be a finite number, at most 1e12 to either side of 0");
}

glm::vec3 vector_of(const py::handle& value, const char* what) {
  const Numbers numbers = numbers_of(value, what);
  if (numbers.ndim() != 1 || numbers.size() != 3)
    throw py::value_error(std::string(what) + " has to be three numbers");
  return {numbers.data()[0], numbers.data()[1], numbers.data()[2]};
}

glm::quat rotation_of(const py::handle& value, const char* what) {
  const Numbers numbers = numbers_of(value, what);
  if (numbers.ndim() != 1 || numbers.size() != 4)
    throw py::value_error(std::string(what) + " has to be four numbers: w, x, y, z");
  const float* const n = numbers.data();
  const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] + n[3] * n[3]);
  if (!(length > 1e-6F) || !(length < 1e6F))
    throw py::value_error(std::string(what) + " has to be a rotation: its length is not near 1");
  return {n[0] / length, n[1] / length, n[2] / length, n[3] / length};
}

std::vector<glm::vec3> places_of(const py::handle& value, const char* what) {
  const Numbers numbers = numbers_of(value, what);
  if (numbers.ndim() != 2 || numbers.shape(1) != 3 || numbers.shape(0) > limits::places_max)
    throw py::value_error(std::string(what) + " has to be an array of shape (n, 3), n at most 2^24");
  std::vector<glm::vec3> places(static_cast<size_t>(numbers.shape(0)));
  const float* n = numbers.data();
  for (glm::vec3& place : places) {
    place = {n[0], n[1], n[2]};
    n += 3;
  }
  return places;
}

int64_t whole_of(int64_t value, int64_t least, int64_t most, const char* what) {
  if (value >= least && value <= most) return value;
  throw py::value_error(std::string(what) + " is " + std::to_string(value) + ", not within " +
                        std::to_string(least) + " to " + std::to_string(most));
}

VoxelBox box_of(const py::handle& lo, const py::handle& hi, float voxel_m) {
  const VoxelBox box{voxel_of(lo, "lo", voxel_m), voxel_of(hi, "hi", voxel_m)};
  if (box.empty()) throw py::value_error("each number of hi has to be greater than that of lo");
  const VoxelCoord size = box.size();
  // Each side is below 2^17.
  if (int64_t{size.x} * size.y * size.z > limits::array_voxels_max)
    throw py::value_error("the box has " + std::to_string(int64_t{size.x} * size.y * size.z) +
                          " voxels, and an array at most 2^28: ask for a smaller box");
  return box;
}

py::tuple tuple_of(glm::vec3 v) {
  return py::make_tuple(v.x, v.y, v.z);
}

}  // namespace scree::python
