#include "shared/surface/surface_cells.h"

#include <algorithm>

#include "shared/base/check.h"

namespace scree {
namespace {

/// Corners of a face, in a cycle.
std::array<int, 4> face_corners(int face) {
  const int axis_bit = 4 >> (face / 2);
  const int u = axis_bit == 4 ? 2 : 4;
  const int v = axis_bit == 1 ? 2 : 1;
  const int base = face % 2 == 1 ? axis_bit : 0;
  return {base, base | u, base | u | v, base | v};
}

int edge_between(const std::array<CellEdge, cell_edges>& edges, int a, int b) {
  const auto found = std::find_if(edges.begin(), edges.end(), [&](const CellEdge& edge) {
    return edge.from == std::min(a, b) && edge.to == std::max(a, b);
  });
  CHECK(found != edges.end());
  return static_cast<int>(found - edges.begin());
}

std::array<CellEdge, cell_edges> make_edges() {
  std::array<CellEdge, cell_edges> edges{};
  for (int axis = 0; axis < 3; ++axis) {
    const int along = 4 >> axis;
    const int u = axis == 0 ? 2 : 4;
    const int v = axis == 2 ? 2 : 1;
    for (int k = 0; k < 4; ++k) {
      const int from = ((k & 2) != 0 ? u : 0) | ((k & 1) != 0 ? v : 0);
      edges[static_cast<size_t>(4 * axis + k)] = {static_cast<uint8_t>(from),
                                                  static_cast<uint8_t>(from | along)};
    }
  }
  return edges;
}

/// Sheets are the classes of crossed edges that the faces link.
struct Links {
  std::array<int, cell_edges> root{};

  Links() {
    for (int i = 0; i < cell_edges; ++i) root[static_cast<size_t>(i)] = i;
  }
  int find(int edge) const {
    while (root[static_cast<size_t>(edge)] != edge) edge = root[static_cast<size_t>(edge)];
    return edge;
  }
  void link(int a, int b) { root[static_cast<size_t>(find(a))] = find(b); }
};

struct FaceEdges {
  std::array<int, 4> corners;
  std::array<int, 4> edges;  ///< edges[i] joins corners i and i + 1
};

bool is_rock(int signs, int corner) {
  return ((signs >> corner) & 1) != 0;
}

bool is_ambiguous(int signs, const FaceEdges& face) {
  for (size_t i = 0; i < 4; ++i)
    if (is_rock(signs, face.corners[i]) == is_rock(signs, face.corners[(i + 1) % 4])) return false;
  return true;
}

void link_face(int signs, const FaceEdges& face, bool join_air, Links& links) {
  if (is_ambiguous(signs, face)) {
    for (size_t i = 0; i < 4; ++i)
      if (is_rock(signs, face.corners[i]) == join_air) links.link(face.edges[i], face.edges[(i + 3) % 4]);
    return;
  }
  int first = -1;
  for (size_t i = 0; i < 4; ++i) {
    if (is_rock(signs, face.corners[i]) == is_rock(signs, face.corners[(i + 1) % 4])) continue;
    if (first < 0) {
      first = face.edges[i];
    } else {
      links.link(first, face.edges[i]);
    }
  }
}

CellCase make_case(int signs, const std::array<CellEdge, cell_edges>& edges,
                   const std::array<FaceEdges, cell_faces>& faces, bool join_air) {
  Links links;
  for (const FaceEdges& face : faces) link_face(signs, face, join_air, links);
  CellCase result;
  std::array<uint8_t, cell_edges> sheet_of_root{};
  sheet_of_root.fill(no_sheet);
  for (size_t e = 0; e < cell_edges; ++e) {
    result.sheet_of_edge[e] = no_sheet;
    if (is_rock(signs, edges[e].from) == is_rock(signs, edges[e].to)) continue;
    uint8_t& sheet = sheet_of_root[static_cast<size_t>(links.find(static_cast<int>(e)))];
    if (sheet == no_sheet) sheet = result.sheets++;
    CHECK(result.sheets <= result.edges_of_sheet.size());
    result.sheet_of_edge[e] = sheet;
    result.edges_of_sheet[sheet] = static_cast<uint16_t>(result.edges_of_sheet[sheet] | (1U << e));
  }
  for (size_t f = 0; f < cell_faces; ++f) {
    if (!is_ambiguous(signs, faces[f])) continue;
    const uint8_t one = result.sheet_of_edge[static_cast<size_t>(faces[f].edges[0])];
    const uint8_t other = result.sheet_of_edge[static_cast<size_t>(faces[f].edges[2])];
    if (one == other) result.pinched_face = static_cast<uint8_t>(f);
  }
  return result;
}

CellTables make_tables() {
  CellTables tables{};
  tables.edges = make_edges();
  std::array<FaceEdges, cell_faces> faces{};
  for (int f = 0; f < cell_faces; ++f) {
    FaceEdges& face = faces[static_cast<size_t>(f)];
    face.corners = face_corners(f);
    for (size_t i = 0; i < 4; ++i)
      face.edges[i] = edge_between(tables.edges, face.corners[i], face.corners[(i + 1) % 4]);
  }
  for (int signs = 0; signs < 256; ++signs) {
    tables.joined[static_cast<size_t>(signs)] = make_case(signs, tables.edges, faces, true);
    tables.split[static_cast<size_t>(signs)] = make_case(signs, tables.edges, faces, false);
    const CellCase& joined = tables.joined[static_cast<size_t>(signs)];
    const bool plain = joined.sheets == 1 && joined.pinched_face == no_face;
    tables.only_sheet[static_cast<size_t>(signs)] = plain ? joined.edges_of_sheet[0] : uint16_t{0};
    for (const int neighbour : {1, 2, 4})
      if (is_rock(signs, 0) != is_rock(signs, neighbour)) ++tables.first_edges[static_cast<size_t>(signs)];
  }
  return tables;
}

}  // namespace

const CellTables& cell_tables() {
  static const CellTables tables = make_tables();
  return tables;
}

}  // namespace scree
