// How errors of Scree become Python's. A Result's error is raised as `scree.Error`, with its words; what no
// call may be given, as ValueError. Every function runs with Python's lock held.
#pragma once

#include <pybind11/pybind11.h>
#include <stdexcept>
#include <string>
#include <utility>

#include "shared/base/result.h"

namespace scree::python {

/// Becomes `scree.Error`.
struct RaisedError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Enters `Error` in the module.
void add_errors(pybind11::module_& module);

[[noreturn]] inline void raise(const Error& error) {
  throw RaisedError(error.message);
}

/// The value of a result, or the exception.
template <typename T>
T value_of(Result<T>&& result) {
  if (!result) raise(result.error());
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

/// The same of an argument that the caller gave.
template <typename T>
T valid(Result<T>&& result) {
  if (!result) throw pybind11::value_error(result.error().message);
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

}  // namespace scree::python
