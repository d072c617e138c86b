// How long a carve takes, from asking to seeing it, by stages, with 100 viewers that carve; and how many
// frames a viewer that predicts waits for its own.
#include <fmt/format.h>
#include <thread>

#include "bench/support/benches.h"
#include "bench/wire/askers.h"
#include "client/cache/join_server.h"
#include "client/viewer/session/viewer_session.h"
#include "server/app/live_server.h"
#include "shared/base/random.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr double frame_s = 1.0 / 60.0;
constexpr double ms_per_s = 1000.0;
constexpr uint64_t frames_per_strike = 30;
constexpr float strikes_within_m = 12.0F;

/// A viewer without a window, frame by frame.
class FrameViewer {
 public:
  explicit FrameViewer(uint16_t port) {
    ServerEndpoint server;
    server.port = port;
    session_.emplace(std::make_unique<ServerConnector>(server), SessionChoice{.interest_radius_m = 48.0F});
  }

  /// Frames for so long. `strikes`: one every half a second; counts frames until it is in the field that is
  /// drawn. The frame that follows the strike is the first.
  void run_frames(const TerrainSource& terrain, double seconds, bool strikes) {
    const double end_s = steady_now_s() + seconds;
    Tool tool;
    tool.radius_m = 1.0F;
    for (double due_s = steady_now_s(); due_s < end_s; due_s += frame_s) {
      std::this_thread::sleep_for(std::chrono::duration<double>(std::max(0.0, due_s - steady_now_s())));
      const double now_s = steady_now_s();
      if (strikes && !struck_m_ && ++frame_ % frames_per_strike == 0) strike(terrain, tool, now_s);
      session_->step(now_s, camera_);
      if (struck_m_) check_drawn(terrain);
    }
    struck_m_.reset();
  }
  void predict(bool on) { session_->predict(on); }
  bool joined() const { return session_->joined(steady_now_s()); }
  uint64_t mismatches() { return session_->mirror() == nullptr ? 0 : session_->mirror()->mismatches(); }
  /// The frames of the strikes since the last call.
  std::vector<double> drain_frames() { return std::exchange(frames_, {}); }
  size_t unpredicted() const { return unpredicted_; }

 private:
  void strike(const TerrainSource& terrain, const Tool& tool, double now_s) {
    const auto around = [&] { return (random_.unit() * 2.0F - 1.0F) * strikes_within_m; };
    glm::vec3 from_m{around(), 0.0F, around()};
    from_m.y = ground_height_m(terrain, from_m.x, from_m.z) + 6.0F;
    const glm::vec3 down{0.0F, -1.0F, 0.0F};
    struck_m_ = session_->aim(from_m, down);
    if (!struck_m_) return;
    waited_ = 0;
    const size_t before = session_->predictions();
    session_->strike(tool, from_m, down, now_s);
    unpredicted_ += session_->predictions() == before ? 1 : 0;
  }
  void check_drawn(const TerrainSource& terrain) {
    ++waited_;
    // Where the ray met the rock there is air now, and a good part of the ball beneath.
    const glm::vec3 in_ball_m = *struck_m_ - glm::vec3(0.0F, 0.4F, 0.0F);
    if (sample(session_->field(), in_ball_m / terrain.voxel_size_m).distance_voxels <= 0.0F) return;
    frames_.push_back(static_cast<double>(waited_));
    struck_m_.reset();
  }

  std::optional<ViewerSession> session_;
  Camera camera_;
  Random random_{5};
  uint64_t frame_ = 0;
  uint64_t waited_ = 0;
  std::optional<glm::vec3> struck_m_;
  std::vector<double> frames_;
  size_t unpredicted_ = 0;
};

void report_stage(BenchReport& report, const std::string& name, const std::vector<double>& ms) {
  report.metric(name + "_median_ms", quantile(ms, 0.5));
  report.metric(name + "_p99_ms", quantile(ms, 0.99));
}

void report_way(BenchReport& report, const AskedTimes& times, double tick_ms) {
  std::vector<double> total, network;
  for (const RequestLatency& each : times.reply) {
    total.push_back(each.total_ms);
    network.push_back(each.network_ms());
  }
  report_stage(report, "applied", times.applied);
  report_stage(report, "reply", total);
  report_stage(report, "network", network);
  for (const LatencyStageRow& stage : latency_stages) {
    std::vector<double> ms;
    for (const RequestLatency& each : times.reply)
      ms.push_back(static_cast<double>(each.server.*stage.us) / ms_per_s);
    report_stage(report, std::string(stage.name), ms);
  }
  report.metric("asked", static_cast<double>(times.asked));
  report.metric("refused", static_cast<double>(times.refused));
  const double median_ms = quantile(times.applied, 0.5), p99_ms = quantile(times.applied, 0.99);
  report.check(
      "applied",
      !times.applied.empty() && times.refused == 0 && median_ms <= tick_ms + 2.0 &&
          p99_ms <= 2.0 * tick_ms + 5.0,
      fmt::format("median {:.1f} ms, p99 {:.1f} ms, {} of {} refused; wanted {:.1f} and {:.1f}, none",
                  median_ms, p99_ms, times.refused, times.asked, tick_ms + 2.0, 2.0 * tick_ms + 5.0));
}

void report_frames(BenchReport& report, const std::vector<double>& predicted, size_t unpredicted,
                   const std::vector<double>& without) {
  report.metric("predicted_frames_median", quantile(predicted, 0.5));
  report.metric("predicted_frames_worst", quantile(predicted, 1.0));
  report.metric("unpredicted_frames_median", quantile(without, 0.5));
  report.metric("unpredicted_frames_worst", quantile(without, 1.0));
  report.check(
      "prediction", !predicted.empty() && unpredicted == 0 && quantile(predicted, 1.0) <= 1.0,
      fmt::format("{} strikes, each in frame {:.0f} at the latest, {} not predicted; wanted the next "
                  "frame, none",
                  predicted.size(), quantile(predicted, 1.0), unpredicted));
}

}  // namespace

BenchReport run_latency_bench(const BenchOptions& options) {
  BenchReport report;
  const double seconds = options.quick ? 3.0 : 30.0;
  LiveConfig config;
  config.world.service.sessions_max = 128;
  const auto server = LiveServer::start(config);
  if (!server) {
    report.check("server_starts", false, server.error().message);
    return report;
  }
  const TerrainSource terrain = config.world.terrain;
  const auto askers = Askers::connect({.port = (*server)->port(), .terrain = terrain});
  if (!askers) {
    report.check("viewers_join", false, askers.error().message);
    return report;
  }
  (*askers)->start();
  FrameViewer viewer((*server)->port());
  viewer.run_frames(terrain, 4.0, false);
  options.progress(0.1);
  const uint64_t late_before = (*server)->report().late_ticks;
  (*askers)->count(true);
  viewer.run_frames(terrain, seconds, true);
  const std::vector<double> predicted = viewer.drain_frames();
  const size_t unpredicted = viewer.unpredicted();
  options.progress(0.55);
  viewer.predict(false);
  viewer.run_frames(terrain, seconds, true);
  (*askers)->count(false);
  const uint64_t late = (*server)->report().late_ticks - late_before;
  viewer.run_frames(terrain, 0.5, false);
  (*askers)->stop();
  options.progress(1.0);
  report_way(report, (*askers)->times(), ms_per_s / config.world.tick_rate_hz);
  report_frames(report, predicted, unpredicted, viewer.drain_frames());
  report.metric("late_ticks", static_cast<double>(late));
  report.check("sound", (*askers)->lost() == 0 && viewer.mismatches() == 0,
               fmt::format("{} viewers lost, {} frames with another hash; wanted none", (*askers)->lost(),
                           viewer.mismatches()));
  return report;
}

}  // namespace scree
