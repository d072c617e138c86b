#include <algorithm>
#include <cmath>
#include <ctime>
#include <fmt/format.h>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <string>

#include "bench/support/benches.h"
#include "bench/wire/pose_peers.h"
#include "bench/wire/pose_scenes.h"
#include "proto/known_motions.h"
#include "proto/transforms.h"
#include "server/publish/motions.h"

namespace scree {

namespace {

constexpr uint32_t tick_rate_hz = 60;
constexpr float voxel_size_m = 0.25F;
constexpr double bits_wanted = 3.0, position_wanted_mm = 2.0, rotation_wanted_deg = 0.5;
constexpr double degrees = 180.0 / 3.14159265358979323846;

/// The time of this thread, so that other work of the machine does not count.
double now_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

struct Errors {
  double position_mm = 0.0;
  double rotation_deg = 0.0;

  void add(const Pose& got, const Pose& wanted) {
    position_mm = std::max(position_mm, 1000.0 * glm::distance(got.position_m, wanted.position_m));
    const glm::quat q = glm::inverse(wanted.rotation) * got.rotation;
    const double sine = glm::length(glm::dvec3(q.x, q.y, q.z));
    rotation_deg = std::max(rotation_deg, 2.0 * std::atan2(sine, std::abs(double{q.w})) * degrees);
  }
};

/// The figures of one way to send a scene's poses.
struct Sent {
  size_t bytes = 0, body_ticks = 0, body_steps = 0;
  double follow_ns = 0.0, encode_ns = 0.0, decode_ns = 0.0;
  Errors off_published;  ///< from TickDelta::pieces
  Errors off_exact;      ///< from the bodies, where the scene has them

  double bits() const { return 8.0 * static_cast<double>(bytes) / static_cast<double>(body_ticks); }
};

/// The poses of a step, as a client has them after it.
using Poses = std::map<PieceId, Pose>;
/// Takes a tick; in a step (the flag) sends its poses, adds what that took, and changes what the client has.
using Way = std::function<void(const PoseTick& tick, bool step, Sent& sent, Poses& client)>;

double timed(const std::function<void()>& work) {
  const double start = now_ns();
  work();
  return now_ns() - start;
}

Way floats() {
  return [](const PoseTick& tick, bool step, Sent& sent, Poses& client) {
    if (!step) return;
    std::vector<BodyPose> bodies, got;
    for (size_t i = 0; i < tick.delta->pieces.size(); ++i) {
      const PieceState& piece = tick.delta->pieces[i];
      bodies.push_back({piece.id, tick.exact.empty() ? dequantise(piece.pose) : tick.exact[i]});
    }
    std::vector<uint8_t> bytes;
    sent.encode_ns += timed([&] { bytes = pack_floats(bodies); });
    sent.decode_ns += timed([&] { got = unpack_floats(bytes); });
    sent.bytes += bytes.size();
    for (const BodyPose& body : got) client[body.id] = body.pose;
  };
}

/// Each pose whole when it changed: Frame.transforms.
Way packed() {
  return [last = std::map<PieceId, QuantisedPose>()](const PoseTick& tick, bool step, Sent& sent,
                                                     Poses& client) mutable {
    if (!step) return;
    std::vector<PieceState> moved;
    for (const PieceState& piece : tick.delta->pieces) {
      const auto [at, is_new] = last.try_emplace(piece.id, piece.pose);
      if (is_new || at->second != piece.pose) moved.push_back(piece);
      at->second = piece.pose;
    }
    std::vector<uint8_t> bytes;
    Result<std::vector<PieceState>> got;
    sent.encode_ns += timed([&] { bytes = pack_transforms(moved); });
    sent.decode_ns += timed([&] { got = unpack_transforms(bytes); });
    sent.bytes += bytes.size();
    for (const PieceState& piece : *got) client[piece.id] = dequantise(piece.pose);
  };
}

Way smallest_three() {
  return [server = SmallestThreeDeltas(), far = SmallestThreeDeltas()](const PoseTick& tick, bool step,
                                                                       Sent& sent, Poses& client) mutable {
    if (!step) return;
    std::vector<PieceId> ids;
    for (const PieceState& piece : tick.delta->pieces) ids.push_back(piece.id);
    std::vector<uint8_t> bytes;
    std::vector<PieceState> got;
    sent.encode_ns += timed([&] { bytes = server.pack(tick.delta->pieces); });
    sent.decode_ns += timed([&] { got = far.unpack(bytes, ids); });
    sent.bytes += bytes.size();
    for (const PieceState& piece : got) client[piece.id] = dequantise(piece.pose);
  };
}

/// The server's motions, which follow the bodies once for all clients, and one client that is there from the
/// start.
class Predicted {
 public:
  explicit Predicted(uint32_t every)
      : rules_(motion_rules(tick_rate_hz, every)),
        server_(rules_, voxel_size_m),
        far_(rules_, voxel_size_m) {}

  void send(const PoseTick& tick, bool step, Sent& sent, Poses& client) {
    const TickDelta& delta = *tick.delta;
    state_.apply(delta);
    make_and_end(delta);
    sent.follow_ns += timed([&] { server_.track(delta, state_, step); });
    if (!step) return;
    list();
    std::vector<uint8_t> bytes;
    sent.encode_ns += timed([&] { bytes = encode_motions(wholes_, steps_); });
    Result<std::vector<PieceId>> moved;
    sent.decode_ns += timed([&] { moved = far_.advance(bytes); });
    CHECK(moved.has_value());
    sent.bytes += bytes.size();
    for (const PieceId id : *moved) client[id] = pose_of(*far_.motion(id));
  }

 private:
  /// What operations, or the start, tell the client of its pieces.
  void make_and_end(const TickDelta& delta) {
    std::map<PieceId, const Volume*> spawned;
    for (const SpawnedPiece& piece : delta.spawned) spawned.emplace(piece.id, piece.volume.get());
    for (const AppliedOperation& applied : delta.operations) {
      for (const PieceId id : applied.created)
        far_.add_made(id, *spawned.at(id), parent_of(applied.operation));
      for (const PieceId id : applied.created) spawned.erase(id);
      for (const PieceId id : pieces_ended_by(applied.operation)) far_.remove(id);
    }
    for (const auto& [id, volume] : spawned) far_.add(id, *volume);
  }
  void list() {
    wholes_.clear();
    steps_.clear();
    for (const TrackedMotion& piece : server_.all())
      if (far_.motion(piece.id) != nullptr)
        steps_.push_back({piece.id, &piece.before, piece.before_check, &piece.correction});
      else
        wholes_.push_back({piece.id, piece.motion});
  }

  MotionRules rules_;
  PublishedState state_;
  Motions server_;
  KnownMotions far_;
  std::vector<WholeMotion> wholes_;
  std::vector<MotionStep> steps_;
};

Way predicted(uint32_t every) {
  return [motions = std::make_shared<Predicted>(every)](const PoseTick& tick, bool step, Sent& sent,
                                                        Poses& client) {
    motions->send(tick, step, sent, client);
  };
}

Sent send(const std::vector<PoseTick>& scene, uint32_t every, Way way) {
  Sent sent;
  Poses client;
  for (const PoseTick& tick : scene) {
    const std::vector<PieceState>& pieces = tick.delta->pieces;
    const bool step = tick.delta->tick % every == 0;
    sent.body_ticks += pieces.size();
    way(tick, step, sent, client);
    if (!step) continue;
    sent.body_steps += pieces.size();
    for (size_t i = 0; i < pieces.size(); ++i) {
      const Pose& got = client.at(pieces[i].id);
      sent.off_published.add(got, dequantise(pieces[i].pose));
      if (!tick.exact.empty()) sent.off_exact.add(got, tick.exact[i]);
    }
  }
  return sent;
}

void report_way(BenchReport& report, const std::string& name, const Sent& sent) {
  const auto a_body = [&](double ns) { return ns / static_cast<double>(sent.body_steps); };
  report.metric(name + "_bits", sent.bits());
  report.metric(name + "_off_mm", sent.off_published.position_mm);
  report.metric(name + "_off_deg", sent.off_published.rotation_deg);
  if (sent.off_exact.position_mm > 0.0 || sent.off_exact.rotation_deg > 0.0) {
    report.metric(name + "_off_body_mm", sent.off_exact.position_mm);
    report.metric(name + "_off_body_deg", sent.off_exact.rotation_deg);
  }
  if (sent.follow_ns > 0.0) report.metric(name + "_follow_ns", a_body(sent.follow_ns));
  report.metric(name + "_encode_ns", a_body(sent.encode_ns));
  report.metric(name + "_decode_ns", a_body(sent.decode_ns));
}

void report_scene(BenchReport& report, const std::string& name, const std::vector<PoseTick>& scene) {
  for (const uint32_t every : {1U, 3U}) {
    const std::string at = name + (every == 1 ? "_60hz_" : "_20hz_");
    report_way(report, at + "floats", send(scene, every, floats()));
    report_way(report, at + "packed", send(scene, every, packed()));
    report_way(report, at + "deltas", send(scene, every, smallest_three()));
    const Sent motions = send(scene, every, predicted(every));
    report_way(report, at + "motions", motions);
    if (every != 1) continue;
    const bool is_exact = !scene.front().exact.empty();
    const Errors& off = is_exact ? motions.off_exact : motions.off_published;
    report.check(
        name,
        motions.bits() <= bits_wanted && off.position_mm <= position_wanted_mm &&
            off.rotation_deg <= rotation_wanted_deg,
        fmt::format(
            "{:.2f} bits a body a tick, at most {:.2f} mm and {:.2f} degrees off {}; wanted {}, {}, {}",
            motions.bits(), off.position_mm, off.rotation_deg, is_exact ? "the bodies" : "what is published",
            bits_wanted, position_wanted_mm, rotation_wanted_deg));
  }
}

}  // namespace

BenchReport run_transforms_bench(const BenchOptions& options) {
  BenchReport report;
  report_scene(report, "boxes", pushed_boxes(options.quick ? 300 : 1200));
  options.progress(0.6);
  report_scene(report, "blast", blast(600));
  options.progress(1.0);
  return report;
}

}  // namespace scree
