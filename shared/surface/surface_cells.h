// The sheets of surface in a cell, by the signs of its 8 corners: the tables of surface_nets.
#pragma once

#include <array>
#include <cstdint>

#include "shared/field/coord.h"

namespace scree {

inline constexpr int cell_corners = 8;
inline constexpr int cell_edges = 12;
inline constexpr int cell_faces = 6;

/// Corner i lies at (i >> 2, (i >> 1) & 1, i & 1): z fastest, as in a window.
/// Edge 4·axis + k runs along the axis; k counts the other two axes' offsets, the later axis fastest.
/// Face 2·axis + side.
inline constexpr VoxelCoord cell_corner(int i) {
  return {i >> 2, (i >> 1) & 1, i & 1};
}
struct CellEdge {
  uint8_t from;
  uint8_t to;
};

inline constexpr uint8_t no_sheet = 255;
inline constexpr uint8_t no_face = 255;

struct CellCase {
  uint8_t sheets = 0;                               ///< 0..4
  std::array<uint8_t, cell_edges> sheet_of_edge{};  ///< no_sheet where the edge is not crossed
  std::array<uint16_t, 4> edges_of_sheet{};         ///< bit e: the sheet crosses edge e
  /// The face of which both halves belong to one sheet, if any. If the neighbour across has the same, the two
  /// cells would share an edge of four triangles: both must then take the split case instead of the joined
  /// one.
  uint8_t pinched_face = no_face;
};

struct CellTables {
  std::array<CellEdge, cell_edges> edges;
  std::array<CellCase, 256> joined;  ///< ambiguous faces join their air corners
  std::array<CellCase, 256> split;   ///< ambiguous faces join their rock corners
  /// Edges of the only sheet in the cases with one sheet and no pinched face, which are nearly all; 0 in
  /// others.
  std::array<uint16_t, 256> only_sheet;
  std::array<uint8_t, 256> first_edges;  ///< how many of the three edges at corner 0 are crossed
};

/// Case index: bit i set when corner i is rock.
const CellTables& cell_tables();

}  // namespace scree
