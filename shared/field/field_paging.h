// Moves a field's chunks in and out of memory (paging.h), and changes no code and no paint. An owner who lets
// others read the field can still let somebody look after its memory.
#pragma once

#include <utility>

#include "shared/field/field.h"

namespace scree {

/// The field must outlive it. Used by the field's thread.
class FieldPaging {
 public:
  explicit FieldPaging(Field& field) : field_(&field) {}

  const Field& field() const { return *field_; }
  // As the functions of Field.
  void page_by(ReadChunk read) { field_->page_by(std::move(read)); }
  void page_out(ChunkCoord chunk) { field_->page_out(chunk); }
  [[nodiscard]] bool page_in(ChunkCoord chunk, std::span<const BrickPatch> bricks) {
    return field_->page_in(chunk, bricks);
  }
  void begin_turn() { field_->begin_turn(); }
  void touch(ChunkCoord chunk) { field_->touch(chunk); }

 private:
  Field* field_;
};

}  // namespace scree
