// Questions about space: where does a ray hit, what is near, what does a box hold. The same scene gives the
// same bits on the server and on every client.
//
// Terrain is hit where its drawn polygons are (surface_nets, as `scree export` writes them), a piece where
// its own are, posed; a body where its convex parts are, within 1/65536 m. Nothing passes between polygons.
// A question with numbers that are not finite, or beyond limits.h, is refused with the reason; so each has a
// most that it can cost. Every answer tells what it cost. Reading generates ground that nobody read before,
// which costs more than all else (QueryCost::chunks). All lengths in metres, world axes.
//
// Among things hit at the same distance the terrain comes first, then the smaller id. A start that lies in
// rock or in a body hits it at 0 (`inside`). A ray from a place on a surface hits it only where it goes in,
// and a ball that touches a surface may leave it. A hit's place is rounded to floats: a ray back from it
// starts a little out along the normal.
#pragma once

#include <optional>
#include <vector>

#include "shared/base/result.h"
#include "shared/field/material_window.h"
#include "shared/query/scene.h"

namespace scree {

/// What a question is about.
struct QueryMask {
  bool terrain = true;
  bool pieces = true;
  bool bodies = true;
  uint32_t groups = 0xFFFFFFFFU;  ///< of bodies: those that have a bit of these
  std::vector<PieceId> except{};  ///< limits::query_excepted_max at most

  bool operator==(const QueryMask&) const = default;
};

enum class HitKind : uint8_t { terrain = 0, piece = 1, body = 2 };

struct Hit {
  HitKind kind = HitKind::terrain;
  PieceId id = 0;                     ///< of a piece or a body
  float distance_m = 0.0F;            ///< that the ray or the body went
  glm::vec3 place_m{0.0F};            ///< on what was hit
  glm::vec3 normal{0.0F};             ///< of length 1, away from what was hit
  Material material{material::rock};  ///< of terrain and pieces, half a voxel below the place
  bool inside = false;                ///< began inside: distance 0, place the start, normal against the cast

  bool operator==(const Hit&) const = default;
};

struct QueryCost {
  /// Blocks, polygons, solids and rounds that were looked at, 64 voxels of a box: 0.2 µs each or less (bench
  /// run query). The same for the same question, whatever the scene kept.
  uint32_t steps = 0;
  /// Times that it came into another chunk: so many may have been generated, and some of those beside.
  uint32_t chunks = 0;
  /// Whether all ground on the way is here. If not, the answer may differ once it has arrived.
  bool exact = true;
};

template <typename T>
struct Answered {
  T answer{};
  QueryCost cost;
};

template <typename T>
using QueryResult = Result<Answered<T>>;

/// `unit` has length 1, within a thousandth. At most limits::query_cast_max_m far.
QueryResult<std::optional<Hit>> cast_ray(const QueryScene& scene, glm::vec3 from_m, glm::vec3 unit,
                                         float most_m, const QueryMask& mask = {});

/// A ball's middle moves so. Radius within limits.h; the ball sweeps limits::query_volume_max_m3 at most.
QueryResult<std::optional<Hit>> cast_sphere(const QueryScene& scene, glm::vec3 from_m, glm::vec3 unit,
                                            float most_m, float radius_m, const QueryMask& mask = {});

/// All places within the radius of the segment from a to b move so. Its box sweeps that volume at most.
QueryResult<std::optional<Hit>> cast_capsule(const QueryScene& scene, glm::vec3 a_m, glm::vec3 b_m,
                                             glm::vec3 unit, float most_m, float radius_m,
                                             const QueryMask& mask = {});

struct Overlapping {
  bool terrain = false;
  std::vector<PieceId> ids;  ///< in order

  bool operator==(const Overlapping&) const = default;
};

/// What has a place within the ball.
QueryResult<Overlapping> overlap_sphere(const QueryScene& scene, glm::vec3 centre_m, float radius_m,
                                        const QueryMask& mask = {});

/// What has a place within the box, along the world's axes. The box has limits::query_volume_max_m3 at most.
QueryResult<Overlapping> overlap_box(const QueryScene& scene, glm::vec3 lo_m, glm::vec3 hi_m,
                                     const QueryMask& mask = {});

/// The place of a surface that is nearest, limits::query_nearest_max_m away at most: of terrain and pieces
/// also from inside (`inside`; the distance is that to the surface). Inside a body it is the place itself.
QueryResult<std::optional<Hit>> nearest_surface(const QueryScene& scene, glm::vec3 place_m, float most_m,
                                                const QueryMask& mask = {});

/// Whether a place lies in rock or in a body.
QueryResult<bool> is_solid(const QueryScene& scene, glm::vec3 place_m, const QueryMask& mask = {});

struct BoxContent {
  double rock_m3 = 0.0;   ///< terrain, by the ramp of a voxel's mass (field/mass.h)
  MaterialMasses masses;  ///< of the terrain, as the ledger counts it: of rubble that of its stones

  bool operator==(const BoxContent&) const = default;
};

/// The terrain of the voxels whose places lie in the box (lo in it, hi not), which has
/// limits::query_volume_max_m3 at most.
QueryResult<BoxContent> box_content(const QueryScene& scene, glm::vec3 lo_m, glm::vec3 hi_m);

/// The solids whose positions lie in the box (lo in it, hi not), which may be of any size, in order.
QueryResult<std::vector<PieceId>> solids_in(const QueryScene& scene, glm::vec3 lo_m, glm::vec3 hi_m,
                                            const QueryMask& mask = {});

}  // namespace scree
