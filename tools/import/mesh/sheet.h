// Open sheets: terrain meshes and scans, which have a surface and no other side.
#pragma once

#include "shared/base/kind_table.h"
#include "tools/import/mesh/mesh_parts.h"

namespace scree {

/// What becomes of open sheets.
enum class SheetRule : uint8_t { refuse = 0, down = 1, close = 2, drop = 3 };

struct SheetRuleRow {
  std::string_view name;
  std::string_view means;
};

constexpr SheetRuleRow row_of(SheetRule rule) {
  switch (rule) {
    case SheetRule::refuse:
      return {"refuse", "refuses the file"};
    case SheetRule::down:
      return {"down", "fills the rock below them"};
    case SheetRule::close:
      return {"close", "closes them like holes, by winding numbers"};
    case SheetRule::drop:
      return {"drop", "leaves them out"};
  }
  return {};
}

/// Whether most of the other side is missing, or the part is a field of heights whose rock would depend on
/// how far down it goes.
bool is_sheet(const TriangleMesh& mesh, const MeshPart& part, double voxel_m);

/// A closed mesh: the sheet, turned up, its walls down to `bottom_m`, and a bottom. Cubic metres: its volume.
TriangleMesh filled_down(const TriangleMesh& mesh, const MeshPart& part, double bottom_m);

/// The least height of a part.
double lowest_m(const TriangleMesh& mesh, const MeshPart& part);

}  // namespace scree
