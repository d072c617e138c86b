// Memory that is handed out to a program: by its own allocator, or by malloc(). Any thread.
#pragma once

#include <cstddef>
#include <new>
#include <utility>

#include "client/library/include/scree/client.h"

namespace scree {

/// Where arrays come from. A value.
class ArraySource {
 public:
  explicit ArraySource(const scree_allocator& allocator) : allocator_(allocator) {}

  /// Throws std::bad_alloc where there is no memory.
  void* allocate(size_t bytes) const;
  void release(void* memory, size_t bytes) const;

 private:
  scree_allocator allocator_;
};

/// One block of it, which is released with this.
class ArrayBlock {
 public:
  ArrayBlock() = default;
  ArrayBlock(const ArraySource& source, size_t bytes)
      : source_(&source), memory_(source.allocate(bytes)), bytes_(bytes) {}
  ~ArrayBlock() { clear(); }
  ArrayBlock(ArrayBlock&& other) noexcept { *this = std::move(other); }
  ArrayBlock& operator=(ArrayBlock&& other) noexcept {
    std::swap(source_, other.source_);
    std::swap(memory_, other.memory_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ArrayBlock(const ArrayBlock&) = delete;
  ArrayBlock& operator=(const ArrayBlock&) = delete;

  void* memory() const { return memory_; }
  size_t bytes() const { return bytes_; }
  /// The block is no longer this one's to release.
  void* let_go() {
    bytes_ = 0;
    return std::exchange(memory_, nullptr);
  }
  void clear() {
    if (memory_ != nullptr) source_->release(std::exchange(memory_, nullptr), bytes_);
    bytes_ = 0;
  }

 private:
  const ArraySource* source_ = nullptr;  ///< outlives the block
  void* memory_ = nullptr;
  size_t bytes_ = 0;
};

}  // namespace scree
