// Shapes: one function for each row of the table of kinds.
#include <optional>
#include <pybind11/pybind11.h>
#include <string>

#include "python/arguments.h"
#include "python/errors.h"
#include "python/parts.h"
#include "shared/field/shape.h"

namespace scree::python {

namespace py = pybind11;

namespace {

std::string text_of_shape(const Shape& shape) {
  const auto text = [](glm::vec3 v) { return std::string(py::str(tuple_of(v))); };
  std::string all = "scree." + std::string(name_of(shape.kind)) + "(" + text(shape.a);
  if (traits_of(shape.kind).has_b) all += ", " + text(shape.b);
  return all + ", " + std::string(py::str(py::float_(static_cast<double>(shape.radius_m)))) + ")";
}

Shape shape_made(ShapeKind kind, const py::object& a, const py::object& b, double radius_m) {
  const Shape shape{kind, vector_of(a, "a"), b.is_none() ? glm::vec3(0.0F) : vector_of(b, "b"),
                    number_of(radius_m, "radius_m")};
  valid(validate(shape));
  return shape;
}

}  // namespace

void add_shapes(py::module_& module) {
  py::class_<Shape>(module, "Shape", "A solid to carve with and to fill; metres.")
      .def_property_readonly("kind", [](const Shape& shape) { return std::string(name_of(shape.kind)); })
      .def_property_readonly("a", [](const Shape& shape) { return tuple_of(shape.a); })
      .def_property_readonly("b", [](const Shape& shape) { return tuple_of(shape.b); })
      .def_readonly("radius_m", &Shape::radius_m)
      .def("__repr__", &text_of_shape)
      .def("__eq__", [](const Shape& one, const Shape& other) { return one == other; });
  for (const ShapeKind kind : all_kinds<ShapeKind>) {
    const std::string name(name_of(kind));
    if (traits_of(kind).has_b)
      module.def(
          name.c_str(),
          [kind](const py::object& a, const py::object& b, double radius_m) {
            return shape_made(kind, a, b, radius_m);
          },
          py::arg("a"), py::arg("b"), py::arg("radius_m") = 0.0,
          "A shape of two places or lengths, and a radius; metres. box: centre a, half extents b, corners "
          "rounded by the radius. capsule: from a to b.");
    else
      module.def(
          name.c_str(),
          [kind](const py::object& a, double radius_m) { return shape_made(kind, a, py::none(), radius_m); },
          py::arg("a"), py::arg("radius_m"), "A shape about the centre a, of that radius; metres.");
  }
}

}  // namespace scree::python
