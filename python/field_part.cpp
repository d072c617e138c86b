// Arrays of boxes of voxels: what lies there, filled once in C++ and owned by the array.
#include <algorithm>
#include <pybind11/pybind11.h>

#include "python/arguments.h"
#include "python/arrays.h"
#include "python/excavation.h"
#include "python/world_functions.h"
#include "shared/field/material_window.h"

namespace scree::python {

namespace py = pybind11;

namespace {

std::vector<py::ssize_t> shape_of_box(const VoxelBox& box) {
  const VoxelCoord size = box.size();
  return {size.x, size.y, size.z};
}

/// The codes of a box, read without Python's lock.
std::vector<Code> codes_in(HeldWorld& held, const VoxelBox& box) {
  const Use use(held);
  const py::gil_scoped_release unlocked;
  return gather(held.world().field(), box).codes;
}

py::array codes(HeldWorld& held, const py::object& lo, const py::object& hi) {
  const VoxelBox box = box_of(lo, hi, held.voxel_m());
  return array_over(codes_in(held, box), shape_of_box(box));
}

py::array distances(HeldWorld& held, const py::object& lo, const py::object& hi) {
  const VoxelBox box = box_of(lo, hi, held.voxel_m());
  const std::vector<Code> read = codes_in(held, box);
  std::vector<float> metres(read.size());
  std::ranges::transform(read, metres.begin(), [&](Code code) { return decode(code) * held.voxel_m(); });
  return array_over(std::move(metres), shape_of_box(box));
}

py::array occupied(HeldWorld& held, const py::object& lo, const py::object& hi) {
  const VoxelBox box = box_of(lo, hi, held.voxel_m());
  const std::vector<Code> read = codes_in(held, box);
  std::vector<uint8_t> solid(read.size());
  std::ranges::transform(read, solid.begin(), [](Code code) { return static_cast<uint8_t>(code < 0); });
  return bools_over(std::move(solid), shape_of_box(box));
}

py::array materials(HeldWorld& held, const py::object& lo, const py::object& hi) {
  const VoxelBox box = box_of(lo, hi, held.voxel_m());
  std::vector<uint8_t> rows(Window::count(box));
  {
    const Use use(held);
    const py::gil_scoped_release unlocked;
    const MaterialWindow window = gather_materials(held.world().field(), box);
    for (size_t i = 0; i < rows.size(); ++i) rows[i] = static_cast<uint8_t>(window.at(i));
  }
  return array_over(std::move(rows), shape_of_box(box));
}

py::array heights(HeldWorld& held, const py::object& lo, const py::object& hi, int64_t step) {
  const VoxelBox box = box_of(lo, hi, held.voxel_m());
  const int each = static_cast<int>(whole_of(step, 1, 1 << 17, "step"));
  const int along_x = columns_along(box.size().x, each), along_z = columns_along(box.size().z, each);
  std::vector<float> metres(static_cast<size_t>(along_x) * static_cast<size_t>(along_z));
  {
    const Use use(held);
    const py::gil_scoped_release unlocked;
    column_heights(held.world().field(), box, each, metres);
  }
  return array_over(std::move(metres), {along_x, along_z});
}

}  // namespace

void add_arrays_of(WorldClass& world) {
  world
      .def("codes", &codes, py::arg("lo"), py::arg("hi"),
           "Codes of the voxels lo (in it) to hi (not in it): int8 of shape hi - lo, z fastest. A code c is "
           "a distance "
           "of 3 c / 127 voxels, negative in rock.")
      .def("distances", &distances, py::arg("lo"), py::arg("hi"),
           "The same as float32 metres to the surface, negative in rock, within 3 voxels to either side.")
      .def("occupancy", &occupied, py::arg("lo"), py::arg("hi"),
           "The same as bool: whether a voxel lies in rock.")
      .def("materials_in", &materials, py::arg("lo"), py::arg("hi"),
           "The same as uint8: numbers of materials.")
      .def("heights", &heights, py::arg("lo"), py::arg("hi"), py::arg("step") = 1,
           "Heights of the highest rock between lo and hi in every step-th column of voxels: float32 metres "
           "of shape "
           "(x, z); NaN: there is none.");
}

}  // namespace scree::python
