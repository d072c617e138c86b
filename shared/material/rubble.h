// Rubble: what a material is once it has broken, fallen and come to rest. Its stones fill a part of each
// voxel, and the rest is pores. What kernels know of it, for each row of a palette: a value that decides
// bits.
//
// Rubble is a row of its own, which names the row that its stones are of. Where a palette has none for a row,
// add_rubble() derives one. Rows stay as they are for ever: worlds gain rows, and never lose them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "shared/material/palette.h"

namespace scree {

struct RubbleRows {
  RubbleRows();

  std::array<uint8_t, 256> fill{};     ///< mass of a full voxel, in 128ths of a solid one's: 1 to 128
  std::array<Material, 256> rubble{};  ///< what a merge of it makes; of loose ground, and of rubble, itself
  std::array<Material, 256> stones{};  ///< what a cut of it makes; of what is no rubble, itself
  bool any = false;                    ///< whether a row is rubble

  bool operator==(const RubbleRows&) const = default;
};

/// `palette` is valid.
RubbleRows rubble_rows(const Palette& palette);

/// Cheap to copy; equal where the rows are.
class Rubble {
 public:
  /// Nothing is rubble: every row is its own.
  Rubble();
  explicit Rubble(const RubbleRows& rows) : rows_(std::make_shared<const RubbleRows>(rows)) {}

  const RubbleRows& operator*() const { return *rows_; }
  const RubbleRows* operator->() const { return rows_.get(); }
  bool operator==(const Rubble& other) const { return *rows_ == *other.rows_; }

 private:
  std::shared_ptr<const RubbleRows> rows_;
};

/// Appends a row of rubble for each row that has none and is not loose, as far as there is room; what finds
/// none shares the rubble of the row that looks and weighs most like it. The palette stays valid.
void add_rubble(Palette& palette);
std::shared_ptr<const Palette> with_rubble(const std::shared_ptr<const Palette>& palette);

/// `next` with its rows of rubble where `kept` has those, so that rows which came before them may be more.
Palette numbered_as(const Palette& kept, const Palette& next);

}  // namespace scree
