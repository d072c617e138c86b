#include "studies/matrix/drawn.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <thread>

#include "bench/support/surface_distance.h"
#include "client/render/scene/look_at.h"
#include "shared/base/quantile.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr int judged_width = 240;
constexpr int judged_height = 180;
/// Beyond, something else is seen.
constexpr double apart_voxels_max = 3.0;
constexpr float jump_m = 1.0F;
/// When the pieces of the first blow are in the air.
constexpr Tick picture_tick = 21;

/// At the blows, with the cliff behind them.
Camera session_camera() {
  return look_at({20.0F, 6.0F, 17.0F}, {9.0F, 0.5F, 10.0F});
}

/// Metres along the camera's forward() to the field's surface in the middle of each pixel, as DepthImage.
std::vector<float> traced_depths(const Field& field, const Camera& camera, float reach_m) {
  const float dx = field.source().voxel_size_m;
  const glm::vec3 forward = camera.forward(), right = camera.right(), up = glm::cross(right, forward);
  const float pixel = 2.0F * std::tan(camera.field_of_view * 0.5F) / static_cast<float>(judged_height);
  std::vector<float> depths;
  for (int y = 0; y < judged_height; ++y)
    for (int x = 0; x < judged_width; ++x) {
      const float aside = (static_cast<float>(x) + 0.5F - 0.5F * judged_width) * pixel;
      const float down = (static_cast<float>(y) + 0.5F - 0.5F * judged_height) * pixel;
      const glm::vec3 way = glm::normalize(forward + right * aside - up * down);
      const auto distance = trace(field, camera.eye_m / dx, way, 1.5F * reach_m / dx);
      depths.push_back(distance ? *distance * dx * glm::dot(way, forward)
                                : std::numeric_limits<float>::infinity());
    }
  return depths;
}

/// Where one thing hides another one behind it.
bool on_outline(const std::vector<float>& depths_m, size_t i) {
  const auto jumps = [&](size_t other) {
    return other < depths_m.size() && !(std::abs(depths_m[i] - depths_m[other]) < jump_m);
  };
  return jumps(i + 1) || jumps(i - 1) || jumps(i + judged_width) || jumps(i - judged_width);
}

double median_of(const std::vector<double>& values) {
  return quantile(values, 0.5);
}

/// The times of a session's frames.
struct Frames {
  std::vector<double> update_ms, shown_ms, draw_ms, whole_ms, flight_ms;

  void add(const DrawnFrame& time, bool in_flight) {
    update_ms.push_back(time.update_ms);
    shown_ms.push_back(time.shown_ms);
    draw_ms.push_back(time.draw_ms);
    whole_ms.push_back(time.update_ms + time.draw_ms);
    if (in_flight) flight_ms.push_back(time.draw_ms);
  }
};

/// The time to draw what stands, by the median of so many frames; the first one, which warms up, aside.
Result<double> draw_again(SessionDrawer& drawer, MatrixSession& session, int frames) {
  std::vector<double> times_ms;
  for (int i = 0; i <= frames; ++i) {
    const Result<DrawnFrame> time = drawer.frame(session);
    if (!time) return fail(time.error().message);
    if (i > 0) times_ms.push_back(time->draw_ms);
  }
  return median_of(times_ms);
}

}  // namespace

SessionDrawer::SessionDrawer(Stage& stage, std::unique_ptr<DrawMethod> method, const DrawPlan& plan)
    : stage_(stage), method_(std::move(method)), plan_(plan) {
  stage_.renderer->set_terrain(matrix_terrain);
  stage_.renderer->set_fineness(traits_of(plan.quality).fineness);
  stage_.renderer->set_view_radius(traits_of(plan.quality).view_radius_m);
}

Result<std::unique_ptr<SessionDrawer>> SessionDrawer::create(Stage& stage, const MethodEntry& entry,
                                                             const DrawPlan& plan) {
  Result<std::unique_ptr<DrawMethod>> method = entry.make(stage.pool, traits_of(plan.quality).view_radius_m);
  if (!method) return fail(method.error().message);
  return std::unique_ptr<SessionDrawer>(new SessionDrawer(stage, std::move(*method), plan));
}

Result<DrawnFrame> SessionDrawer::frame(MatrixSession& session) {
  const Camera camera = session_camera();
  const Scene scene{session.world().field(), session.pieces()};
  method_->changed(session.drain_changes());
  DrawnFrame time;
  Stopwatch whole, stopwatch;
  method_->update(scene, camera);
  time.update_ms = stopwatch.lap_ms();
  while (!method_->complete()) {
    std::this_thread::yield();
    method_->update(scene, camera);
  }
  time.shown_ms = whole.lap_ms();
  stage_.renderer->set_contacts(contacts_of(scene, camera.eye_m));
  stopwatch.lap_ms();
  if (Result<void> drawn = stage_.renderer->draw_unseen(*method_, camera, plan_.width, plan_.height); !drawn)
    return fail(drawn.error().message);
  time.draw_ms = stopwatch.lap_ms();
  return time;
}

double SessionDrawer::memory_mib() const {
  size_t bytes = 0;
  for (const MemoryCount& count : method_->stats().memory) bytes += count.cpu_bytes + count.gpu_bytes;
  return static_cast<double>(bytes) / (1024.0 * 1024.0);
}

Result<Image> SessionDrawer::picture() {
  return stage_.renderer->draw_image(*method_, session_camera(), plan_.width, plan_.height);
}

Result<SessionDrawer::Difference> SessionDrawer::difference(MatrixSession& session) {
  const Field& field = session.world().field();
  const Camera camera = session_camera();
  const ScenePieces none;
  MirrorChanges changes = session.drain_changes();
  for (const auto& [id, piece] : session.pieces()) changes.pieces_removed.push_back(id);
  method_->changed(changes);
  do method_->update(Scene{field, none}, camera);
  while (!method_->complete());
  Result<DepthImage> drawn = stage_.renderer->draw_depths(*method_, camera, judged_width, judged_height);
  if (!drawn) return fail(drawn.error().message);
  const float near_m = std::min(0.5F * traits_of(plan_.quality).view_radius_m, 0.9F * method_->reach_m());
  const std::vector<float> traced = traced_depths(field, camera, near_m);
  const auto voxel_m = static_cast<double>(field.source().voxel_size_m);
  SurfaceDistance distance;
  double judged = 0.0, missed = 0.0;
  for (size_t i = 0; i < traced.size(); ++i) {
    if (!(std::min(traced[i], drawn->metres[i]) < near_m)) continue;
    const double apart = std::abs(static_cast<double>(traced[i]) - static_cast<double>(drawn->metres[i]));
    const double voxels = std::min(apart / voxel_m, apart_voxels_max);
    judged += 1.0;
    missed += voxels >= apart_voxels_max ? 1.0 : 0.0;
    if (!on_outline(traced, i)) distance.add(voxels);
  }
  if (judged == 0.0) return fail("nothing near is drawn");
  return Difference{distance.rms(), 100.0 * missed / judged};
}

Result<DrawnFigures> measure_drawn(Stage& stage, const MethodEntry& entry, const Simulated& simulated,
                                   const SessionPlan& plan, const DrawnExtras& extras) {
  const DrawPlan how;
  const auto drawer = SessionDrawer::create(stage, entry, how);
  if (!drawer) return fail(drawer.error().message);
  MatrixSession session(config_of(simulated, matrix_terrain), simulated.pattern, plan);
  DrawnFigures figures;
  Frames frames;
  double ticks_ms = 0.0;
  const int again = extras.judged ? 3 : 1;
  const Result<double> fresh = draw_again(**drawer, session, again);
  if (!fresh) return fail(fresh.error().message);
  figures.fresh_ms = *fresh;
  while (!session.ended()) {
    const auto delta = session.step();
    ticks_ms += delta->times.total_ms();
    if (delta->tick % how.ticks_per_frame != 1 && !session.ended()) continue;
    const Result<DrawnFrame> time = (*drawer)->frame(session);
    if (!time) return fail(time.error().message);
    frames.add(*time, !delta->pieces.empty());
    if (extras.picture == nullptr || delta->tick != picture_tick) continue;
    Result<Image> image = (*drawer)->picture();
    if (!image) return fail(image.error().message);
    *extras.picture = std::move(*image);
  }
  if (!session.refusal().empty()) return fail(session.refusal());
  const Result<double> settled = draw_again(**drawer, session, again);
  if (!settled) return fail(settled.error().message);
  figures.settled_ms = *settled;
  figures.frame_ms = median_of(frames.whole_ms);
  figures.update_ms = median_of(frames.update_ms);
  figures.shown_ms = median_of(frames.shown_ms);
  figures.flight_ms = median_of(frames.flight_ms);
  figures.tick_ms = ticks_ms / static_cast<double>(plan.ticks);
  figures.memory_mib = (*drawer)->memory_mib();
  if (!extras.judged) return figures;
  const auto difference = (*drawer)->difference(session);
  if (!difference) return fail(difference.error().message);
  figures.depth_voxels = difference->depth_voxels;
  figures.silhouette_percent = difference->silhouette_percent;
  return figures;
}

}  // namespace scree
