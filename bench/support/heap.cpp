#include "bench/support/heap.h"

#include <cstdlib>
#include <malloc.h>
#include <new>

namespace {

thread_local size_t held = 0;
thread_local size_t peak = 0;

}  // namespace

namespace scree {

size_t heap_bytes() {
  return held;
}

size_t heap_peak_bytes() {
  return peak;
}

void reset_heap_peak() {
  peak = held;
}

}  // namespace scree

// Array, sized and nothrow forms call these two. Memory that another thread frees is not counted: benches
// that use this work on one thread.
void* operator new(size_t size) {
  void* block = std::malloc(size);
  if (block == nullptr) throw std::bad_alloc();
  held += malloc_usable_size(block);
  peak = held > peak ? held : peak;
  return block;
}

void operator delete(void* block) noexcept {
  const size_t size = malloc_usable_size(block);
  held = size < held ? held - size : 0;
  std::free(block);
}

void operator delete(void* block, size_t) noexcept {
  operator delete(block);
}
