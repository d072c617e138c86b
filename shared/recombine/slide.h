// Slides: rubble that lies steeper than its angle of repose runs down, as far as a window shows
// (slide_columns.h). The surface of the rubble moves up and down as a whole, with its stones; then the mass
// of each material is met to the unit, by single codes of its surface. Integers, and distances made anew
// (redistance.h): the same bits everywhere.
#pragma once

#include <optional>

#include "shared/recombine/slide_columns.h"
#include "shared/recombine/stamp_materials.h"

namespace scree {

/// What a slide makes of a window.
struct Slid {
  Window after;
  AddedMaterials added;  ///< its gains are none
};

/// The voxels that a slide in that box reads.
inline VoxelBox slide_window(const VoxelBox& box) {
  return box.grown(slide_margin);
}

/// `before` has the reader's box: slide_window() of the terms' box, whose sides along x and z are whole
/// cells. Nothing where all lies at rest, where the mass cannot be met, or where it would hardly sink: so a
/// slope that slides comes to an end.
std::optional<Slid> slide(const MaterialReader& were, const RubbleRows& rows, const Window& before,
                          const SlideTerms& terms);

}  // namespace scree
