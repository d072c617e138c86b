// The parts of the module, each of which enters its functions and classes.
#pragma once

#include <pybind11/pybind11.h>

namespace scree::python {

/// `Shape`, and a function for each kind of shape.
void add_shapes(pybind11::module_& module);
/// `Command`, and a function for each request.
void add_commands(pybind11::module_& module);
/// `Step`: the result of ticks.
void add_steps(pybind11::module_& module);
/// `World`.
void add_worlds(pybind11::module_& module);
/// `Batch`.
void add_batches(pybind11::module_& module);
/// `Client`.
void add_clients(pybind11::module_& module);
/// `Recording`.
void add_recordings(pybind11::module_& module);

}  // namespace scree::python
