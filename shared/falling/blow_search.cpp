#include "shared/falling/blow_search.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "shared/base/check.h"
#include "shared/falling/leverage.h"
#include "shared/falling/load_flow.h"
#include "shared/falling/punch.h"
#include "shared/falling/span_section.h"
#include "shared/falling/spans.h"
#include "shared/falling/support_network.h"
#include "shared/falling/support_parts.h"
#include "shared/falling/support_search.h"
#include "shared/field/material_window.h"

namespace scree {

namespace {

/// Massive rock is at most so many bricks wide to each side of what is struck, and one more deep.
constexpr int massive_side_max = 3;
/// Voxels of the lever by which a force bends such rock at most: the search's reach.
constexpr double massive_lever = 60.0;
/// Forces that are tried on spans are powers of this, newtons; how many; and the products of blocks that all
/// tries may take, some 4 ms.
constexpr double span_step = 2.0;
constexpr int span_tries = 8;
constexpr size_t span_products_max = 12000;

LoadDirection direction_of(glm::dvec3 force) {
  const glm::dvec3 size = glm::abs(force);
  const int axis = size.y >= size.x && size.y >= size.z ? 1 : size.x >= size.z ? 0 : 2;
  return {axis, force[axis] > 0.0};
}

std::vector<BrickCoord> bricks_of(const std::vector<VoxelCoord>& voxels) {
  std::set<BrickCoord> bricks;
  for (const VoxelCoord voxel : voxels) bricks.insert(brick_of(voxel));
  return {bricks.begin(), bricks.end()};
}

const MaterialRow& struck_row(const Field& field, const Palette& palette, VoxelCoord voxel) {
  const float dx = field.source().voxel_size_m;
  return palette.row_or_first(material_at(
      field,
      glm::vec3(static_cast<float>(voxel.x), static_cast<float>(voxel.y), static_cast<float>(voxel.z)) * dx));
}

/// Whether only full bricks and ground lie behind the brick.
bool is_massive(const Field& field, const Ground& ground, BrickCoord brick, LoadDirection direction,
                int side) {
  const auto full = [&](BrickCoord at) {
    return ground.holds(at) || solid_bits(field.brick(at)) == ~BrickBits{};
  };
  for (int depth = 1; depth <= side + 1; ++depth)
    for (int i = -side; i <= side; ++i)
      for (int j = -side; j <= side; ++j) {
        BrickCoord at = brick;
        along_axis(at, direction.axis) += direction.up ? depth : -depth;
        along_axis(at, (direction.axis + 1) % 3) += i;
        along_axis(at, (direction.axis + 2) % 3) += j;
        if (!full(at)) return false;
      }
  return true;
}

/// Bricks to each side that a square tower must have so that the force does not bend it too much at the
/// search's reach: W = a³/6.
int massive_side(const Field& field, const Palette& palette, const BlowLoad& load) {
  const auto bends_pa = static_cast<double>(struck_row(field, palette, load.on.front()).bearing.bending_pa);
  const auto face_m2 = static_cast<double>(field.source().voxel_size_m * field.source().voxel_size_m);
  for (int side = 1;; ++side) {
    const double wide = (2 * side + 1) * brick_size;
    const double bears = wide * wide * wide / 6.0 / massive_lever * bends_pa * face_m2;
    if (glm::length(load.newtons) <= bears || side > massive_side_max) return side;
  }
}

/// What breaks, and the part of the force at which it does.
struct Break {
  Overload overload;
  double share = 1.0;
};

class BlowSearch {
 public:
  BlowSearch(Field& field, const Palette& palette, const BlowLoad& load, int reach_bricks,
             const Holding* holding)
      : field_(field),
        palette_(palette),
        load_(load),
        newtons_(glm::length(load.newtons)),
        direction_(direction_of(load.newtons)),
        bricks_(bricks_of(load.on)),
        holding_(holding),
        parts_(field, palette, bricks_, reach_bricks, support_parts_max, holding) {
    found_.parts = parts_.parts().size();
    for (const VoxelCoord voxel : load.on)
      if (const auto part = part_of(voxel)) struck_.insert(*part);
  }

  BlowFound run() {
    if (parts_.overflow()) found_.given_up = true;
    if (parts_.overflow() || struck_.empty()) return found_;
    if (const auto plug = find_plug(field_, palette_, load_, direction_))
      enter({plug->overload, plug->newtons / newtons_});
    const bool held = std::ranges::any_of(struck_, [&](uint32_t part) { return parts_.parts()[part].held; });
    if (!held) {
      try_flow();
      if (const auto lever = find_lever(parts_, field_, palette_, force()))
        enter({lever->overload, lever->share});
    }
    try_spans();
    if (best_) {
      found_.overload = std::move(best_->overload);
      found_.share = best_->share;
    }
    return found_;
  }

 private:
  std::optional<uint32_t> part_of(VoxelCoord voxel) const {
    const BrickCoord brick = brick_of(voxel);
    const VoxelCoord at = voxel - first_voxel(brick);
    for (uint32_t i = 0; i < parts_.parts().size(); ++i)
      if (parts_.parts()[i].brick == brick && parts_.parts()[i].bits.has(at)) return i;
    return std::nullopt;
  }
  PointForce force() const {
    return {load_.at, load_.newtons, std::vector<uint32_t>(struck_.begin(), struck_.end())};
  }

  /// The weakest stays; of equals, the first.
  void enter(Break one) {
    if (one.share >= 1.0 || (best_ && one.share >= best_->share)) return;
    one.share = std::max(one.share, 0.0);
    best_ = std::move(one);
  }

  /// The load that reaches no ground, in grams; nothing when the flow was given up. `overloaded`: of each
  /// part, where it is not null.
  std::optional<int64_t> left(const SupportNetwork& network, bool weighs, int64_t blow_grams,
                              std::vector<bool>* overloaded) const {
    LoadFlow flow;
    network.add_to(flow, direction_, weighs);
    const uint32_t striker = flow.add_node(blow_grams);
    constexpr int64_t unlimited = INT64_MAX / 4;
    for (const uint32_t part : struck_) flow.link(striker, part, unlimited, 0);
    if (!flow.run(flow_steps_per_part * parts_.parts().size())) return std::nullopt;
    if (overloaded != nullptr) {
      *overloaded = flow.smallest_overloaded();
      overloaded->resize(parts_.parts().size());
    }
    return flow.left();
  }

  void try_flow() {
    constexpr double grams = 1000.0;
    const SupportNetwork network(parts_, palette_, field_.source().voxel_size_m, LoadKind::blow);
    const auto blow = static_cast<int64_t>(newtons_ / static_cast<double>(standard_gravity) * grams);
    bool weighs = direction_.axis == 1 && !direction_.up;
    std::vector<bool> overloaded;
    std::optional<int64_t> excess = left(network, weighs, blow, &overloaded);
    if (excess && *excess > 0 && weighs && left(network, true, 0, nullptr) != 0) {
      weighs = false;
      excess = left(network, false, blow, &overloaded);
    }
    if (!excess) found_.given_up = true;
    if (!excess || *excess == 0) return;
    Break one{{}, static_cast<double>(blow - *excess) / static_cast<double>(blow)};
    for (auto& [mass, overload] : network.masses(overloaded)) {
      if (one.overload.voxels == 0) one.overload.start = overload.start;
      one.overload.voxels += overload.voxels;
      one.overload.necks.insert(one.overload.necks.end(), overload.necks.begin(), overload.necks.end());
    }
    if (one.overload.voxels >= overload_voxels_min && !one.overload.necks.empty()) enter(std::move(one));
  }

  SpansFound spans_under(SpanSearch& spans, double share) {
    const SpanForce force{load_.on.front(), load_.at, load_.newtons * share};
    SpansFound found = spans.run(share > 0.0 ? &force : nullptr);
    found_.span_bricks = found.bricks_read;
    found_.span_joints = found.joints;
    found_.span_products += found.products;
    return found;
  }

  /// Looks for the least force that breaks a span, among some that do not depend on the blow's: from the one
  /// on at which the first section would crack if all were elastic. The greatest tension grows with the
  /// force, ever faster, so that a line to it from the tension without force reaches no farther.
  void try_spans() {
    const double most_n = (best_ ? best_->share : 1.0) * newtons_;
    double greatest_n = 1.0;
    while (greatest_n * span_step <= most_n) greatest_n *= span_step;
    SpanSearch spans(field_, palette_, bricks_, struck_parts_max, holding_);
    SpansFound found = spans_under(spans, greatest_n / newtons_);
    if (found.overloads.empty()) return;
    const double weight = spans_under(spans, 0.0).strain;
    if (weight >= 1.0) return;  // it has stood so far: nobody knows by what
    const double cracks_n = greatest_n * (1.0 - weight) / std::max(found.strain - weight, 1e-6);
    double tried_n = 1.0;
    while (tried_n < cracks_n) tried_n *= span_step;
    for (int i = 0; i < span_tries && tried_n <= greatest_n; ++i, tried_n *= span_step) {
      if (found_.span_products > span_products_max) return;
      SpansFound part = spans_under(spans, tried_n / newtons_);
      if (part.overloads.empty()) continue;
      enter({std::move(part.overloads.front()), tried_n / newtons_});
      return;
    }
  }

  Field& field_;
  const Palette& palette_;
  const BlowLoad& load_;
  double newtons_;
  LoadDirection direction_;
  std::vector<BrickCoord> bricks_;
  const Holding* holding_;
  SupportParts parts_;
  std::set<uint32_t> struck_;  ///< parts
  std::optional<Break> best_;
  BlowFound found_;
};

}  // namespace

bool surely_holds(const Field& field, const Palette& palette, const BlowLoad& load) {
  const Ground ground(field);
  const LoadDirection direction = direction_of(load.newtons);
  const int side = massive_side(field, palette, load);
  return std::ranges::all_of(bricks_of(load.on), [&](BrickCoord brick) {
    return ground.holds(brick) ||
           (side <= massive_side_max && is_massive(field, ground, brick, direction, side));
  });
}

BlowFound find_break(Field& field, const Palette& palette, const BlowLoad& load, int reach_bricks,
                     const Holding* holding) {
  CHECK(!load.on.empty() && glm::length(load.newtons) > 0.0);
  return BlowSearch(field, palette, load, reach_bricks, holding).run();
}

}  // namespace scree
