// The Python module `scree`. Its parts enter what it has; python/scree.pyi has the types.
#include <pybind11/pybind11.h>

#include "python/arrays.h"
#include "python/errors.h"
#include "python/parts.h"

PYBIND11_MODULE(scree, module) {
  using namespace scree::python;
  module.doc() =
      "Scree: terrain that breaks, falls, comes to rest and is terrain again. Metres, seconds, kilograms; y "
      "points up.";
  module.attr("__version__") = SCREE_VERSION;
  add_errors(module);
  add_row_types(module);
  add_shapes(module);
  add_commands(module);
  add_steps(module);
  add_worlds(module);
  add_batches(module);
  add_clients(module);
  add_recordings(module);
}
