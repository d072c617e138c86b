#include "client/viewer/viewing/hud_facts.h"

#include <cmath>
#include <cstdio>
#include <glm/trigonometric.hpp>

#include "client/session/edit_reach.h"
#include "client/viewer/base/limits.h"
#include "shared/field/mass.h"

namespace scree {
namespace {

std::string place_of(const Camera& camera) {
  char text[96];
  const auto degrees = [](float radians) { return static_cast<double>(glm::degrees(radians)); };
  std::snprintf(text, sizeof text, "at %.1f, %.1f, %.1f m, yaw %.0f, pitch %.0f degrees",
                static_cast<double>(camera.eye_m.x), static_cast<double>(camera.eye_m.y),
                static_cast<double>(camera.eye_m.z), std::remainder(degrees(camera.yaw), 360.0),
                degrees(camera.pitch));
  return text;
}

/// Seconds for which a hit is marked at the cross, and a refusal, which has words to read.
constexpr double hit_shown_s = 0.25, refusal_shown_s = 1.5;

std::vector<CarriedRow> carried_rows(const Mirror& mirror, const Palette& palette) {
  std::vector<CarriedRow> rows;
  const double voxel_m = mirror.terrain().voxel_size_m;
  for (const MaterialMass& one : mirror.carried()) {
    const MaterialRow& row = palette.row_or_first(one.material);
    rows.push_back({row.name, row.look.colour,
                    static_cast<double>(one.mass) / units_per_voxel * voxel_m * voxel_m * voxel_m});
  }
  return rows;
}

void mark_strike(HudFacts& facts, const ViewerSession::Answer& answer, double now_s) {
  const bool refused = !answer.refused.empty();
  if (answer.number == 0 || now_s - answer.at_s > (refused ? refusal_shown_s : hit_shown_s)) return;
  facts.mark = refused ? StrikeMark::refused : StrikeMark::hit;
  facts.refused = answer.refused;
}

}  // namespace

HudFacts FactFinder::find(Visit& visit, double now_s) {
  ViewerSession& session = visit.session;
  const Mirror* mirror = session.mirror();
  if (mirror != nullptr && now_s >= next_count_s_) {
    next_count_s_ = now_s + limits::count_interval_s;
    count(*mirror, session);
  }
  HudFacts facts = counted_;
  facts.connection = session.description();
  facts.lost = !session.connected();
  facts.bytes_per_s = session.received_bytes_per_s();
  facts.notice = session.notice(now_s);
  facts.retry_s = session.next_try_s(now_s);
  mark_strike(facts, session.answer(), now_s);
  facts.latency = session.latency();
  facts.predictions = session.predictions();
  facts.driver = visit.view->renderer().description();
  facts.camera = place_of(visit.camera);
  facts.tick_rate_hz = session.tick_rate_hz();
  facts.pace = session.pace().factor();
  facts.lost_ticks = session.pace().lost_ticks();
  facts.is_replay = session.is_replay();
  if (mirror != nullptr) {
    facts.tick = mirror->tick();
    facts.voxel_size_m = mirror->terrain().voxel_size_m;
    facts.pieces_near = mirror->pieces().size();
    facts.props_near = mirror->props().size();
    facts.kept_near = mirror->kept().size();
    facts.carried = carried_rows(*mirror, session.palette());
    facts.store_room_m3 = store_room_m3(mirror->status());
    facts.status = mirror->status();
    facts.mismatches = mirror->mismatches();
  }
  MethodSwitch& methods = visit.view->methods();
  facts.stones = methods.stones();
  if (DrawMethod* method = methods.shown()) {
    facts.method = methods.shown_name();
    facts.draw = method->stats();
    facts.gpu_times = visit.view->renderer().gpu_times();
    facts.memory = facts.draw.memory;
  }
  if (DrawMethod* method = methods.preparing()) {
    const DrawStats stats = method->stats();
    facts.preparing = {std::string(methods.preparing_name()), stats.resident, stats.waiting,
                       methods.was_loaded()};
  }
  facts.memory.insert(facts.memory.end(), mirror_memory_.begin(), mirror_memory_.end());
  return facts;
}

void FactFinder::count(const Mirror& mirror, const ViewerSession& session) {
  counted_ = {};
  counted_.held_chunks = mirror.held_chunks().size();
  for (const ChunkCoord chunk : mirror.field().edited_chunks()) {
    ++counted_.edited_chunks;
    counted_.edited_bricks += mirror.field().edited_bricks(chunk).size();
  }
  size_t volume_bytes = 0;
  for (const auto& [id, motion] : mirror.pieces()) volume_bytes += motion.volume->window.codes.size();
  mirror_memory_ = {{"edited bricks", counted_.edited_bricks * sizeof(Brick), 0},
                    {"volumes", volume_bytes, 0},
                    {"to be applied", session.waiting_bytes(), 0}};
}

}  // namespace scree
