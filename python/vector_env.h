// The form of Gymnasium's vector environments, by its own classes where it is installed, and by the same
// names where it is not. With Python's lock held.
#pragma once

#include <pybind11/pybind11.h>
#include <vector>

namespace scree::python {

/// gymnasium.spaces.Box of float32, or an object with its low, high, shape and dtype. `low` and `high` are
/// arrays of the shape.
pybind11::object box_space(const pybind11::object& low, const pybind11::object& high);

/// Puts a class of both in the module in the place of a batch's class, where Gymnasium is installed.
void join_gymnasium(pybind11::module_& module, const char* name);

}  // namespace scree::python
