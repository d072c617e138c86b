// What a frame costs by each preset of --quality: standing, while every frame brings a carve, and standing
// before the dust and the contact shadows of a blast. Times
// depend on what else the machine does; the presets are measured in turns, and the processor's time is told
// beside the clock's.
#include <ctime>
#include <fmt/format.h>

#include "bench/support/benches.h"
#include "bench/support/drawing.h"
#include "client/render/scene/quality.h"
#include "client/viewer/events/dust.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr int width = 1280;
constexpr int height = 720;
constexpr int rounds = 3;
constexpr int carves = 6;  ///< a round
constexpr float carved_half_width_m = 12.0F;
constexpr float carve_radius_m = 2.0F;
constexpr int blast_pieces = 64;
constexpr double blast_age_s = 0.4;

/// Milliseconds of a frame in the median.
struct Times {
  std::vector<double> clock_ms;
  std::vector<double> processor_ms;
};

/// The processor time of all threads.
double processor_now_ms() {
  return static_cast<double>(std::clock()) * 1000.0 / static_cast<double>(CLOCKS_PER_SEC);
}

struct Subject {
  Quality quality;
  Drawing drawing;
  Times standing;
  Times carving;
  Times blasting;
};

/// What pieces of 0.7 m throw in the middle of the picture; of the pieces themselves, only what they darken.
void show_blast(Stage& stage, const Drawing& drawing) {
  Dust dust;
  std::vector<PieceEvent> events;
  std::vector<Contact> contacts;
  for (int i = 0; i < blast_pieces; ++i) {
    const float x_m = 14.0F + 0.5F * static_cast<float>(i % 8), z_m = 8.0F + 0.5F * static_cast<float>(i / 8);
    const glm::vec3 place_m(x_m, ground_height_m({TerrainKind::canyon, 1, 0.25F}, x_m, z_m) + 0.4F, z_m);
    events.push_back(
        {PieceEventKind::crack, place_m, 0.7F, 1000.0F, material::rock, static_cast<PieceId>(i)});
    contacts.push_back({place_m, 0.43F});
  }
  dust.add(events, 0.0);
  stage.renderer->set_particles(dust.at(blast_age_s, drawing.camera.eye_m));
  stage.renderer->set_contacts(std::move(contacts));
}

Result<void> draw(Stage& stage, Subject& subject, Times& times, bool carve, uint64_t seed) {
  stage.renderer->set_fineness(traits_of(subject.quality).fineness);
  stage.renderer->set_view_radius(traits_of(subject.quality).view_radius_m);
  const double processor_ms = processor_now_ms();
  Stopwatch stopwatch;
  if (carve) {
    subject.drawing.carve(1, carved_half_width_m, carve_radius_m, seed);
    subject.drawing.finish();
  }
  const Result<void> drawn =
      stage.renderer->draw_unseen(subject.drawing.method(), subject.drawing.camera, width, height);
  if (!drawn) return drawn;
  times.clock_ms.push_back(stopwatch.lap_ms());
  times.processor_ms.push_back(processor_now_ms() - processor_ms);
  return {};
}

Result<std::unique_ptr<Subject>> prepare(Stage& stage, const MethodEntry& entry, Quality quality) {
  Result<std::unique_ptr<DrawMethod>> method = entry.make(stage.pool, traits_of(quality).view_radius_m);
  if (!method) return fail(method.error().message);
  auto subject = std::unique_ptr<Subject>(
      new Subject{quality, Drawing(stage, {TerrainKind::canyon, 1, 0.25F}, std::move(*method)), {}, {}, {}});
  Camera& camera = subject->drawing.camera;
  camera.eye_m = {30.0F, 9.0F, 19.0F};
  camera.yaw = 1.1F;
  camera.pitch = -0.12F;
  subject->drawing.finish();
  Times warm;
  if (Result<void> drawn = draw(stage, *subject, warm, false, 0); !drawn) return fail(drawn.error().message);
  return subject;
}

Result<void> measure(Stage& stage, const MethodEntry& entry, bool quick, BenchReport& report) {
  std::vector<std::unique_ptr<Subject>> subjects;
  for (const Quality quality : all_kinds<Quality>) {
    Result<std::unique_ptr<Subject>> subject = prepare(stage, entry, quality);
    if (!subject) return fail(subject.error().message);
    subjects.push_back(std::move(*subject));
  }
  for (int round = 0; round < (quick ? 1 : rounds); ++round)
    for (const auto& subject : subjects)
      for (int i = 0; i < (quick ? 1 : carves); ++i) {
        const auto seed = static_cast<uint64_t>(30 + round * carves + i);
        TRY(draw(stage, *subject, subject->standing, false, seed));
        TRY(draw(stage, *subject, subject->carving, true, seed));
        show_blast(stage, subject->drawing);
        const Result<void> drawn = draw(stage, *subject, subject->blasting, false, seed);
        stage.renderer->set_particles({});
        stage.renderer->set_contacts({});
        if (!drawn) return drawn;
      }
  for (const auto& subject : subjects) {
    const std::string name = fmt::format("{}_{}", entry.name, name_of(subject->quality));
    report.metric(name + "_standing_ms", quantile(subject->standing.clock_ms, 0.5));
    report.metric(name + "_standing_processor_ms", quantile(subject->standing.processor_ms, 0.5));
    report.metric(name + "_carving_ms", quantile(subject->carving.clock_ms, 0.5));
    report.metric(name + "_carving_processor_ms", quantile(subject->carving.processor_ms, 0.5));
    report.metric(name + "_blasting_ms", quantile(subject->blasting.clock_ms, 0.5));
    report.metric(name + "_blasting_processor_ms", quantile(subject->blasting.processor_ms, 0.5));
    report.metric(name + "_draws", static_cast<double>(subject->drawing.method().stats().draws));
  }
  return {};
}

}  // namespace

BenchReport run_quality_bench(const BenchOptions& options) {
  BenchReport report;
  const Result<std::unique_ptr<Stage>> stage = stage_of(report, traits_of(Quality::high).view_radius_m);
  report.check("draws", stage.has_value(), stage ? (*stage)->renderer->description() : stage.error().message);
  if (!stage) return report;
  for (const char* name : {"mesh", "raymarch"}) {
    const Result<void> measured = measure(**stage, *method_named(name), options.quick, report);
    report.check(fmt::format("{}_draws", name), measured.has_value(),
                 measured ? "" : measured.error().message);
  }
  return report;
}

}  // namespace scree
