// NumPy arrays over buffers that C++ filled once: the array's base is a capsule that owns the buffer, and
// nothing is copied again.
#pragma once

#include <memory>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <utility>
#include <vector>

#include "python/rows.h"

namespace scree::python {

/// An array of that shape and type over the buffer, whose size is the shape's.
template <typename T>
pybind11::array array_over(std::vector<T>&& buffer, std::vector<pybind11::ssize_t> shape,
                           const pybind11::dtype& type) {
  auto held = std::make_unique<std::vector<T>>(std::move(buffer));
  const T* const data = held->data();
  const pybind11::capsule owner(held.get(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
  (void)held.release();
  return pybind11::array(type, std::move(shape), data, owner);
}

/// The same of numbers, by their own type.
template <typename T>
pybind11::array array_over(std::vector<T>&& buffer, std::vector<pybind11::ssize_t> shape) {
  return array_over(std::move(buffer), std::move(shape), pybind11::dtype::of<T>());
}

/// Bytes that are 0 or 1, as bool.
inline pybind11::array bools_over(std::vector<uint8_t>&& buffer, std::vector<pybind11::ssize_t> shape) {
  return array_over(std::move(buffer), std::move(shape), pybind11::dtype::of<bool>());
}

pybind11::array bodies_over(std::vector<BodyTableRow>&& rows);
pybind11::array ledgers_over(std::vector<LedgerRow>&& rows);
pybind11::array events_over(std::vector<EventTableRow>&& rows);

/// Enters the types of rows of bodies, ledgers and events.
void add_row_types(pybind11::module_& module);

}  // namespace scree::python
