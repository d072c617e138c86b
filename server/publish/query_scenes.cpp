#include "server/publish/query_scenes.h"

#include <algorithm>
#include <glm/common.hpp>
#include <unordered_set>

#include "server/publish/limits.h"
#include "shared/base/check.h"
#include "shared/base/overloaded.h"
#include "shared/query/vectors.h"

namespace scree {

namespace {

/// What making a scene costs, steps of QueryCost: a body, and a brick that is laid over.
constexpr uint64_t body_steps = 2;
constexpr uint64_t brick_steps = 8;

/// Voxels around a question's box that its answer may depend on.
constexpr int query_margin_voxels = 9;

Tick ticks_in(double seconds, uint32_t tick_rate_hz) {
  return std::max<Tick>(1, static_cast<Tick>(seconds * static_cast<double>(tick_rate_hz)));
}

VoxelCoord voxel_of(const glm::dvec3& place_m, double voxel_m) {
  return {floor_to_int(place_m.x / voxel_m), floor_to_int(place_m.y / voxel_m),
          floor_to_int(place_m.z / voxel_m)};
}

VoxelBox voxels_about(const SpaceBox& box_m, double voxel_m) {
  const VoxelBox box{voxel_of(box_m.lo, voxel_m), voxel_of(box_m.hi, voxel_m) + VoxelCoord{1, 1, 1}};
  return box.grown(query_margin_voxels);
}

/// A cast's length; nothing of other questions.
std::optional<float> length_of(const Question& question) {
  return std::visit(
      [](const auto& q) -> std::optional<float> {
        if constexpr (requires { q.unit; }) return q.most_m;
        return std::nullopt;
      },
      question.asks);
}

Question shortened(const Question& question, float most_m) {
  Question shorter = question;
  std::visit(
      [most_m](auto& q) {
        if constexpr (requires { q.unit; }) q.most_m = most_m;
      },
      shorter.asks);
  return shorter;
}

/// Where a cast begins, and its way.
std::vector<std::pair<glm::dvec3, glm::dvec3>> ways_of(const Question& question) {
  using Ways = std::vector<std::pair<glm::dvec3, glm::dvec3>>;
  return std::visit(Overloaded{[](const RayQuestion& q) {
                                 return Ways{{q.from_m, q.unit}};
                               },
                               [](const SphereQuestion& q) {
                                 return Ways{{q.from_m, q.unit}};
                               },
                               [](const CapsuleQuestion& q) {
                                 return Ways{{q.a_m, q.unit}, {q.b_m, q.unit}};
                               },
                               [](const auto&) { return Ways(); }},
                    question.asks);
}

bool reads_terrain(const Question& question) {
  if (std::holds_alternative<BodiesQuestion>(question.asks)) return false;
  return question.mask.terrain || std::holds_alternative<ContentQuestion>(question.asks);
}

}  // namespace

QueryScenes::QueryScenes(const TerrainSource& source, uint32_t tick_rate_hz, const PublishedState& state)
    : source_(source),
      state_(state),
      asked_back_(ticks_in(limits::query_past_s, tick_rate_hz)),
      past_(ticks_in(limits::query_past_kept_s, tick_rate_hz)),
      idle_ticks_(ticks_in(limits::query_idle_s, tick_rate_hz)) {}

void QueryScenes::restart() {
  scenes_.clear();
  field_.reset();
  maker_ = SceneMaker();
  past_.restart(state_);
}

void QueryScenes::before(const TickDelta& delta) {
  scenes_.clear();
  past_.before(delta, state_);
}

void QueryScenes::after(const TickDelta& delta) {
  past_.after(delta, state_);
  if (field_ == nullptr) return;
  const auto note = [this](ChunkCoord chunk) {
    field_->note(chunk);
    maker_.forget(chunk);
  };
  for (const BrickState& brick : delta.bricks) note(chunk_of(brick.coord));
  for (const BrickCoord brick : delta.reverted) note(chunk_of(brick));
  for (const ChunkState& chunk : delta.chunks) note(chunk.chunk);
}

bool QueryScenes::may_ask_for(Tick tick) const {
  return tick <= state_.tick() && state_.tick() - tick <= asked_back_ && past_.find(tick) != nullptr;
}

bool QueryScenes::begin() {
  asked_ = state_.tick();
  if (field_ == nullptr) field_ = std::make_unique<PublishedField>(source_, state_);
  return field_->follow(limits::query_chunks_followed);
}

void QueryScenes::rest() {
  if (field_ == nullptr || state_.tick() < asked_ + idle_ticks_) return;
  scenes_.clear();
  field_.reset();
  maker_ = SceneMaker();
}

const QueryScenes::OfTick* QueryScenes::scene_of(Tick tick, uint64_t& cost) {
  if (const auto found = scenes_.find(tick); found != scenes_.end()) return &found->second;
  const PastTick* const past = past_.find(tick);
  if (past == nullptr) return nullptr;
  const std::vector<const BrickBefore*> changed = past_.changed_since(tick);
  const size_t bodies = past->pieces.size() + past->props.size();
  cost += body_steps * bodies + brick_steps * changed.size();
  OfTick made;
  if (!changed.empty()) lay_over(made, changed);
  maker_.begin(bodies);
  past_.add_bodies(*past, maker_);
  made.scene = std::make_unique<HeldScene>(made.layer == nullptr ? maker_.make(*field_)
                                                                 : maker_.make_apart(*made.layer));
  return &scenes_.emplace(tick, std::move(made)).first->second;
}

void QueryScenes::lay_over(OfTick& scene, const std::vector<const BrickBefore*>& changed) const {
  scene.layer = std::make_unique<MapField>(field_.get());
  std::unordered_set<BrickCoord, CoordHash> done;
  for (const BrickBefore* const before : changed) {
    if (!done.insert(before->coord).second) continue;
    if (!before->known)
      scene.unknown.push_back(before->coord);
    else if (before->brick != nullptr)
      scene.layer->set_brick(before->coord, *before->brick, before->materials);
    else
      scene.layer->set_brick(before->coord, Brick(field_->generated_brick(before->coord)), BrickMaterials());
  }
}

bool QueryScenes::is_way_generated(const Question& question, float from_m) const {
  const auto voxel_m = static_cast<double>(source_.voxel_size_m);
  const double step_m = 0.5 * voxel_m * chunk_size, most_m = static_cast<double>(*length_of(question));
  const auto ways = ways_of(question);
  return std::all_of(ways.begin(), ways.end(), [&](const auto& way) {
    for (double along_m = static_cast<double>(from_m); along_m < most_m + step_m; along_m += step_m)
      if (!field_->has_generated(
              chunk_of(voxel_of(way.first + way.second * std::min(along_m, most_m), voxel_m))))
        return false;
    return true;
  });
}

bool QueryScenes::generate_some(const Question& question, float& progress) const {
  const VoxelBox box = voxels_about(bounds_of(question), static_cast<double>(source_.voxel_size_m));
  const auto looked_at = static_cast<size_t>(progress);
  size_t index = 0, generated = 0;
  for_each_chunk(box, [&](ChunkCoord chunk) {
    if (index++ < looked_at || generated == limits::query_chunks_at_once) return;
    progress = static_cast<float>(index);
    if (field_->has_generated(chunk)) return;
    static_cast<void>(field_->chunk_bricks(chunk));
    ++generated;
  });
  return generated == limits::query_chunks_at_once;
}

QueryScenes::Step QueryScenes::try_step(const Question& question, Tick tick, float& progress) {
  Step step;
  const OfTick* const there = scene_of(tick, step.cost);
  if (there == nullptr) return step;
  const auto voxel_m = static_cast<double>(source_.voxel_size_m);
  const bool reads = reads_terrain(question);
  if (reads && !there->unknown.empty()) {
    const VoxelBox box = voxels_about(bounds_of(question), voxel_m);
    for (const BrickCoord brick : there->unknown) {
      const VoxelCoord first = first_voxel(brick);
      if (!common(box, {first, first + VoxelCoord{brick_size, brick_size, brick_size}}).empty()) return step;
    }
  }
  const QueryScene& scene = *there->scene;
  const auto ask_now = [&](const Question& asked) {
    auto found = ask(scene, asked);
    CHECK(found.has_value());
    step.cost += 1 + found->cost.steps;
    step.answer = std::move(found->answer);
  };
  step.outcome = Outcome::goes_on;
  const std::optional<float> length_m = length_of(question);
  if (reads && !length_m && generate_some(question, progress)) return step;
  if (reads && length_m && !is_way_generated(question, progress)) {
    progress += limits::query_probe_m;
    if (progress < *length_m) {
      ask_now(shortened(question, progress));
      if (!std::get<std::optional<Hit>>(step.answer)) return step;
    }
  }
  ask_now(question);
  step.outcome = Outcome::answered;
  return step;
}

/// What was read halfway is forgotten.
QueryScenes::Step QueryScenes::step(const Question& question, Tick tick, float& progress) {
  CHECK(field_ != nullptr);
  const size_t before = field_->generated_chunks();
  Step step;
  try {
    step = try_step(question, tick, progress);
  } catch (const ChunkUnreadable&) {
    scenes_.clear();
    for (const ChunkCoord chunk : field_->take_missing()) {
      maker_.forget(chunk);
      missing_.push_back(chunk);
    }
    step.outcome = Outcome::missing;
    step.cost = body_steps * (state_.pieces().size() + state_.props().size());
  }
  const size_t after = field_->generated_chunks();
  if (after > before) step.cost += limits::query_chunk_steps * (after - before);
  return step;
}

}  // namespace scree
