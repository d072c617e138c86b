#include "bench/support/span_cases.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>

#include "content/builtin_palette.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

constexpr float voxel_m = 0.25F;
constexpr float level_m = 9.0F;  ///< of a beam's middle: more than a brick above the ground
constexpr float half_width_m = 1.0F;
/// At the limit of a clamped square plate the bending is w L²/n: 42.85 exactly (Fox 1974). Straight yield
/// lines give an upper bound, 48.
constexpr double clamped_plate_n = 42.85;

/// A box of any size, of fills that overlap: two that meet in a plane of voxels would not touch.
void fill(Field& field, glm::vec3 lo, glm::vec3 hi) {
  constexpr float most_m = 12.0F, overlap_m = 0.6F;
  PieceTable none;
  for (float x = lo.x; x < hi.x; x += most_m)
    for (float y = lo.y; y < hi.y; y += most_m)
      for (float z = lo.z; z < hi.z; z += most_m) {
        const glm::vec3 from(x, y, z);
        const glm::vec3 to = glm::min(from + most_m + overlap_m, hi);
        apply(FillOperation{box(0.5F * (from + to), 0.5F * (to - from))}, field, none);
      }
}

/// Blocks of 6 m to the left of 0 and to the right of the span.
void add_blocks(Field& field, float span_m, float offset_m) {
  fill(field, {-6.0F + offset_m, -0.5F, -6.0F}, {offset_m, 17.0F, 6.0F});
  fill(field, {span_m + offset_m, -0.5F, -6.0F}, {span_m + 6.0F + offset_m, 17.0F, 6.0F});
}

void add_beam(Field& field, float from_m, float to_m, float height_m, float offset_m) {
  const float y = level_m + offset_m, z = offset_m;
  fill(field, {from_m + offset_m, y - 0.5F * height_m, z - half_width_m},
       {to_m + offset_m, y + 0.5F * height_m, z + half_width_m});
}

glm::vec3 on_beam(float x_m, float offset_m) {
  return {x_m + offset_m, level_m + offset_m, offset_m};
}

BuildSpan cantilever(float height_m, float offset_m) {
  return [=](Field& field, float span_m) {
    fill(field, {-6.0F + offset_m, -0.5F, -6.0F}, {offset_m, 17.0F, 6.0F});
    add_beam(field, -0.5F, span_m, height_m, offset_m);
    return on_beam(0.5F * span_m, offset_m);
  };
}

/// On two posts, or three, which are so thin that they hold its ends by little.
BuildSpan on_posts(float height_m, float offset_m, int spans) {
  return [=](Field& field, float span_m) {
    constexpr float half_post_m = 0.25F;
    add_beam(field, -half_post_m, static_cast<float>(spans) * span_m + half_post_m, height_m, offset_m);
    for (int i = 0; i <= spans; ++i) {
      const float x = static_cast<float>(i) * span_m + offset_m;
      fill(field, {x - half_post_m, -0.5F, offset_m - half_width_m},
           {x + half_post_m, level_m + offset_m, offset_m + half_width_m});
    }
    return on_beam(0.4F * span_m, offset_m);
  };
}

/// Clamped at both ends, with a post under its middle.
BuildSpan clamped_on_post(float height_m, float offset_m) {
  return [=](Field& field, float span_m) {
    add_blocks(field, 2.0F * span_m, offset_m);
    add_beam(field, -0.5F, 2.0F * span_m + 0.5F, height_m, offset_m);
    fill(field, {span_m + offset_m - 0.25F, -0.5F, offset_m - half_width_m},
         {span_m + offset_m + 0.25F, level_m + offset_m, offset_m + half_width_m});
    return on_beam(0.4F * span_m, offset_m);
  };
}

/// A square roof between four blocks.
BuildSpan clamped_plate(float height_m, float offset_m) {
  return [=](Field& field, float span_m) {
    const float lo = offset_m, hi = offset_m + span_m, thick_m = 5.0F;
    fill(field, {lo - thick_m, -0.5F, lo - thick_m}, {lo, 17.0F, hi + thick_m});
    fill(field, {hi, -0.5F, lo - thick_m}, {hi + thick_m, 17.0F, hi + thick_m});
    fill(field, {lo - 1.0F, -0.5F, lo - thick_m}, {hi + 1.0F, 17.0F, lo});
    fill(field, {lo - 1.0F, -0.5F, hi}, {hi + 1.0F, 17.0F, hi + thick_m});
    fill(field, {lo - 0.5F, level_m + offset_m - 0.5F * height_m, lo - 0.5F},
         {hi + 0.5F, level_m + offset_m + 0.5F * height_m, hi + 0.5F});
    return glm::vec3(0.5F * (lo + hi), level_m + offset_m, 0.5F * (lo + hi));
  };
}

/// A square plate on a post under each corner.
BuildSpan plate_on_posts(float height_m, float offset_m) {
  return [=](Field& field, float span_m) {
    const float lo = offset_m, hi = offset_m + span_m, half_post_m = 0.5F;
    fill(field, {lo - half_post_m, level_m + offset_m - 0.5F * height_m, lo - half_post_m},
         {hi + half_post_m, level_m + offset_m + 0.5F * height_m, hi + half_post_m});
    for (const float x : {lo, hi})
      for (const float z : {lo, hi})
        fill(field, {x - half_post_m, -0.5F, z - half_post_m},
             {x + half_post_m, level_m + offset_m, z + half_post_m});
    return glm::vec3(0.5F * (lo + hi), level_m + offset_m, 0.5F * (lo + hi));
  };
}

/// Span at which w L²/n in a section of that height reaches the strength of rock.
double span_of(double n, float height_m) {
  const MaterialRow& rock = builtin_palette().row(material::rock);
  constexpr double gravity_m_s2 = 9.80665;
  return std::sqrt(n / 6.0 * static_cast<double>(rock.bearing.bending_pa) * static_cast<double>(height_m) /
                   (static_cast<double>(rock.density_kg_m3) * gravity_m_s2));
}

}  // namespace

const TerrainSource& span_ground() {
  static const TerrainSource ground{
      TerrainKind::flat, 1, voxel_m, {}, {material::rock, material::rock, material::rock, 1.0F, 1.5F}};
  return ground;
}

BuildSpan clamped_beam(float height_m, float offset_m) {
  return [=](Field& field, float span_m) {
    add_blocks(field, span_m, offset_m);
    add_beam(field, -0.5F, span_m + 0.5F, height_m, offset_m);
    return on_beam(0.5F * span_m, offset_m);
  };
}

BuildSpan parabolic_arch(float rise_m, float thickness_m) {
  return [=](Field& field, float span_m) {
    add_blocks(field, span_m, 0.0F);
    const auto height = [&](float x) {
      const float t = 2.0F * x / span_m - 1.0F;
      return level_m - 5.0F + rise_m * (1.0F - t * t);
    };
    PieceTable none;
    for (float x = -1.0F; x < span_m + 1.0F; x += 0.25F) {
      const float y = height(x);
      apply(FillOperation{capsule({x, y, -half_width_m}, {x, y, half_width_m}, 0.5F * thickness_m)}, field,
            none);
    }
    return glm::vec3(0.5F * span_m, height(0.5F * span_m), 0.0F);
  };
}

SpansFound search_span(const BuildSpan& build, float span_m) {
  MapField field(span_ground());
  const glm::vec3 at = build(field, span_m) / voxel_m;
  const std::vector<BrickCoord> changed{
      brick_of(VoxelCoord{floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)})};
  return find_spans(field, builtin_palette(), changed);
}

double found_span_m(const SpanCase& one) {
  const auto breaks = [&](double span_m) {
    return !search_span(one.build, static_cast<float>(span_m)).overloads.empty();
  };
  double stands_m = 0.5 * one.theory_m, breaks_m = 1.4 * one.theory_m;
  if (breaks(stands_m) || !breaks(breaks_m)) return 0.0;
  while (breaks_m - stands_m > 0.01 * one.theory_m) {
    const double between_m = 0.5 * (stands_m + breaks_m);
    (breaks(between_m) ? breaks_m : stands_m) = between_m;
  }
  return 0.5 * (stands_m + breaks_m);
}

std::vector<SpanCase> span_cases(bool quick) {
  std::vector<SpanCase> cases;
  const auto add = [&](std::string_view kind, float height_m, float offset_m, double n, BuildSpan build) {
    cases.push_back({fmt::format("{}_{:.0f}_cm_at_{:.0f}", kind, 100.0F * height_m, 100.0F * offset_m),
                     span_of(n, height_m), std::move(build)});
  };
  const std::vector<float> offsets_m = quick ? std::vector{0.13F} : std::vector{0.0F, 0.13F, 0.6F};
  for (const float height_m : quick ? std::vector{1.5F} : std::vector{0.5F, 0.75F, 1.0F, 1.5F, 2.0F, 3.0F})
    for (const float offset_m : offsets_m) {
      add("sticking_out", height_m, offset_m, 2.0, cantilever(height_m, offset_m));
      add("clamped", height_m, offset_m, 12.0, clamped_beam(height_m, offset_m));
      add("clamped_on_post", height_m, offset_m, 12.0, clamped_on_post(height_m, offset_m));
    }
  for (const float height_m : quick ? std::vector{1.5F} : std::vector{1.0F, 1.5F, 2.0F, 3.0F})
    for (const float offset_m : offsets_m) {
      add("on_two_posts", height_m, offset_m, 8.0, on_posts(height_m, offset_m, 1));
      add("on_three_posts", height_m, offset_m, 8.0, on_posts(height_m, offset_m, 2));
    }
  for (const float height_m : quick ? std::vector{0.5F} : std::vector{0.5F, 0.75F})
    for (const float offset_m : offsets_m) {
      add("clamped_plate", height_m, offset_m, clamped_plate_n, clamped_plate(height_m, offset_m));
      add("plate_on_posts", height_m + 0.25F, offset_m, 8.0, plate_on_posts(height_m + 0.25F, offset_m));
    }
  return cases;
}

}  // namespace scree
