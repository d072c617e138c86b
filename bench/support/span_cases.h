// Beams, plates and arches of rock with what theory says of them: for the bench `beams`, and for tests.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "shared/falling/spans.h"
#include "shared/field/field.h"

namespace scree {

/// Builds a structure of that span in a field of flat ground; its result is a place on it.
using BuildSpan = std::function<glm::vec3(Field& field, float span_m)>;

/// Flat ground of rock.
const TerrainSource& span_ground();

struct SpanCase {
  std::string name;
  double theory_m = 0.0;  ///< span at which it breaks under its own weight
  BuildSpan build;
};

/// What a search finds around one brick of the structure.
SpansFound search_span(const BuildSpan& build, float span_m);

/// The least span at which it breaks, within a hundredth of the theory's; 0 where it breaks at half of
/// that or stands at 1.4 times as much.
double found_span_m(const SpanCase& one);

/// Beams that stick out, that are clamped, that rest on posts, and plates: by height, and by where they lie
/// between the voxels. `quick`: a few of them.
std::vector<SpanCase> span_cases(bool quick);

/// A parabolic arch of that rise and thickness between two blocks, and the flat beam in its place.
BuildSpan parabolic_arch(float rise_m, float thickness_m);
BuildSpan clamped_beam(float height_m, float offset_m);

}  // namespace scree
