#include "python/errors.h"

namespace scree::python {

void add_errors(pybind11::module_& module) {
  static auto& error = *new pybind11::exception<RaisedError>(module, "Error");  // Python keeps it, too
  error.doc() = "What Scree refuses, in words: a damaged file, a world in use on another thread.";
  pybind11::register_exception_translator([](std::exception_ptr raised) {
    try {
      if (raised) std::rethrow_exception(raised);
    } catch (const RaisedError& e) {
      error(e.what());
    }
  });
}

}  // namespace scree::python
