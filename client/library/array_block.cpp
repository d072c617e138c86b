#include "client/library/array_block.h"

#include <cstdlib>

namespace scree {

void* ArraySource::allocate(size_t bytes) const {
  void* const memory = allocator_.allocate != nullptr
                           ? allocator_.allocate(allocator_.user, bytes, alignof(std::max_align_t))
                           : std::malloc(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void ArraySource::release(void* memory, size_t bytes) const {
  if (allocator_.release != nullptr)
    allocator_.release(allocator_.user, memory, bytes);
  else
    std::free(memory);
}

}  // namespace scree
