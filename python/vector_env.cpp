#include "python/vector_env.h"

namespace scree::python {

namespace py = pybind11;

namespace {

/// The module, or None.
py::object gymnasium() {
  try {
    if (py::module_::import("importlib.util").attr("find_spec")("gymnasium").is_none()) return py::none();
    return py::module_::import("gymnasium");
  } catch (const py::error_already_set&) {
    return py::none();  // one that cannot be imported is as none
  }
}

}  // namespace

py::object box_space(const py::object& low, const py::object& high) {
  const py::object type = py::module_::import("numpy").attr("float32");
  if (const py::object found = gymnasium(); !found.is_none())
    return found.attr("spaces").attr("Box")(py::arg("low") = low, py::arg("high") = high,
                                            py::arg("dtype") = type);
  return py::module_::import("types").attr("SimpleNamespace")(py::arg("low") = low, py::arg("high") = high,
                                                              py::arg("shape") = low.attr("shape"),
                                                              py::arg("dtype") = low.attr("dtype"));
}

void join_gymnasium(py::module_& module, const char* name) {
  const py::object found = gymnasium();
  if (found.is_none()) return;
  const py::object own = module.attr(name);
  const py::object theirs = found.attr("vector").attr("VectorEnv");
  py::dict members;
  members["__module__"] = module.attr("__name__");
  members["__doc__"] = own.attr("__doc__");
  py::dict metadata;
  metadata["render_modes"] = py::list();
  if (py::hasattr(found.attr("vector"), "AutoresetMode"))
    metadata["autoreset_mode"] = found.attr("vector").attr("AutoresetMode").attr("NEXT_STEP");
  members["metadata"] = metadata;
  module.attr(name) = py::type::of(own)(name, py::make_tuple(own, theirs), members);
}

}  // namespace scree::python
