// Four floats at a time, in a form that g++ and clang both compile to vector instructions at any level of
// optimisation, with the same bits. Private to this folder.
#pragma once

#include <LinearMath/btVector3.h>
#include <cstring>

namespace scree {

using Floats = float __attribute__((vector_size(16)));
using Ints = int __attribute__((vector_size(16)));

inline Floats load(const float* from) {
  Floats out;
  std::memcpy(&out, from, sizeof(out));
  return out;
}

/// The fourth lane is whatever Bullet keeps there.
inline Floats load(const btVector3& from) {
  return load(from.m_floats);
}

inline void store(Floats from, btVector3& to) {
  std::memcpy(to.m_floats, &from, sizeof(from));
}

inline Floats all(float x) {
  return Floats{x, x, x, x};
}

}  // namespace scree
