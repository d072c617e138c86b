// Solids bounded by polygons, for the cutters `slice` and `conform`. Voxels, in double precision;
// deterministic.
//
// A face is a plane and directed edges in it, counter-clockwise seen from outside, in any order: one loop or
// several, so that a cap with holes or with several islands needs no triangulation. A mesh is closed when
// every directed edge occurs as often as its reverse.
#pragma once

#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "shared/field/window.h"

namespace scree {

/// dot(normal, p) = offset; the normal has unit length.
struct Plane {
  glm::dvec3 normal{0.0};
  double offset = 0.0;

  double distance(glm::dvec3 p) const { return glm::dot(normal, p) - offset; }
};

struct PolygonEdge {
  uint32_t from = 0;
  uint32_t to = 0;
};

/// A face's `neighbour` is the index of the seed of the cell across it, or this: the solid's own surface.
inline constexpr uint32_t own_surface = UINT32_MAX;

struct PolygonFace {
  Plane plane;  ///< its normal points outwards
  uint32_t neighbour = own_surface;
  uint32_t first_edge = 0;
  uint32_t edges = 0;
};

struct PolygonMesh {
  std::vector<glm::dvec3> vertices;
  std::vector<PolygonEdge> edges;  ///< face by face
  std::vector<PolygonFace> faces;

  bool empty() const { return faces.empty(); }
  /// Adds a face of the edges from `first_edge` on; none if there are no edges.
  void end_face(const Plane& plane, uint32_t neighbour, size_t first_edge);
  void clear();
};

struct PolygonBounds {
  glm::dvec3 lo{1e30};
  glm::dvec3 hi{-1e30};

  void add(glm::dvec3 p);
  void add(const PolygonBounds& other);
};

PolygonBounds bounds_of(const PolygonMesh& mesh);

/// Whether every directed edge occurs as often as its reverse.
bool is_closed(const PolygonMesh& mesh);

/// The surface of a volume as triangles; closed, as outside the volume's window is air (surface_nets.h).
PolygonMesh polygonise(const Window& volume);

/// A box's six faces.
PolygonMesh box_mesh(const PolygonBounds& bounds);

/// Volume, and first moments of it about the origin, of a closed mesh: sums of signed tetrahedra.
struct PolygonMoments {
  double volume = 0.0;
  glm::dvec3 first{0.0};
};
PolygonMoments moments_of(const PolygonMesh& mesh);

/// Cuts off the part of a closed mesh beyond a plane, and caps the hole (paper, 2.3) with a face of the given
/// neighbour. The mesh stays closed whatever rounding does, also where the plane grazes vertices, edges or
/// faces. Each vertex is on one side (beyond, or not), and each edge is cut once for both its faces. The cap
/// consists of the reverses of the edges that closed the faces. Not thread-safe: it keeps its memory.
class Slicer {
 public:
  void slice(PolygonMesh& mesh, const Plane& plane, uint32_t neighbour);

 private:
  struct Crossing {
    uint32_t vertex = 0;
    int sign = 0;  ///< +1 where the face's loop enters the kept side, −1 where it leaves
    double along = 0.0;
  };

  bool classify(const PolygonMesh& mesh, const Plane& plane);
  uint32_t copied(const PolygonMesh& mesh, uint32_t vertex);
  uint32_t crossing(const PolygonMesh& mesh, PolygonEdge edge);
  void clip_face(const PolygonMesh& mesh, const PolygonFace& face, const Plane& plane);
  void close_face(glm::dvec3 along);
  void close(uint32_t from, uint32_t to);

  std::vector<double> distances_;
  std::vector<uint32_t> copied_;  ///< a kept vertex's number in out_
  /// Cut edges by their lower vertex: linked lists, as a vertex has few edges.
  struct CutEdge {
    uint32_t other = 0;
    uint32_t vertex = 0;
    uint32_t next = 0;
  };
  std::vector<uint32_t> first_cut_;
  std::vector<CutEdge> cuts_;
  std::vector<Crossing> crossings_;
  std::vector<PolygonEdge> cap_;
  PolygonMesh out_;
};

}  // namespace scree
