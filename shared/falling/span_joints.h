// The joints between the bodies of a search for spans (span_bodies.h): what each resists, and the sections in
// which it may break. Lengths in voxels, forces in newtons; the modulus of elasticity is 1 of all materials,
// because the forces depend on ratios alone.
#pragma once

#include <vector>

#include "shared/falling/span_section.h"
#include "shared/falling/spring_frame.h"

namespace scree {

/// A section in which a joint may break.
struct SpanCheck {
  SpanSection section;
  double at = 0.0;        ///< place along the axis
  int layer = 0;          ///< of voxels; for the face, the first beyond it
  double strength = 0.0;  ///< tension that it bears, newtons by voxel²
  /// Weight between it and the bodies' face: positive on the lower side of the face, and its moment.
  double newtons = 0.0;
  glm::dvec3 weight_moment{0.0};
};

struct SpanJoint {
  SpringFrame::Spring spring;
  int axis = 0;
  int face = 0;                   ///< the first layer of voxels beyond it
  uint32_t lower = 0, upper = 0;  ///< bodies
  glm::dvec3 place{0.0};          ///< of the spring: the elastic centre
  std::vector<SpanContact> contacts;
  std::vector<SpanCheck> checks;
  uint32_t group = 0;  ///< joints of one group make up one plane section through what they join
};

struct SpanJoints {
  std::vector<SpanJoint> joints;
  std::vector<Six> loads;  ///< of each body that does not hold: they are the first
};

/// `bodies` must have been made of that field, with voxels of `voxel_m`.
SpanJoints join_spans(SpanBodies& bodies, float voxel_m);

/// How a joint's forces strain one of its sections.
struct SpanStrain {
  double bent = 0.0;     ///< tension at the edge, of bending and torsion
  double pressed = 0.0;  ///< pressure over the section, negative when pulled
  /// The tension of as much bending as a section that is cracked through and pressed can bear, by turning
  /// about its edge.
  double rocking = 0.0;
};
SpanStrain strain_of(const SpanJoint& joint, const SpanCheck& check, glm::dvec3 place, const Six& forces);

}  // namespace scree
