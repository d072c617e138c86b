#include "studies/scale/frame_set.h"

#include "bench/support/scratch.h"
#include "client/render/methods.h"

namespace scree {

namespace {

constexpr int frame_width = 640;
constexpr int frame_height = 360;
constexpr int frames_at_once = 2;
constexpr float carved_half_width_m = 40.0F;

}  // namespace

FrameSet::FrameSet(Stage& stage) : stage_(stage), software_(is_software(stage.renderer->description())) {}

Result<void> FrameSet::add(double size, const TerrainSource& terrain, int carves, float radius_m) {
  auto method = TRY(method_named("raymarch")->make(stage_.pool, frame_view_radius_m));
  auto drawing = std::make_unique<Drawing>(stage_, terrain, std::move(method));
  drawing->camera.eye_m = {0.0F, 16.0F, 46.0F};
  drawing->camera.pitch = -0.38F;
  drawing->finish();
  drawing->carve(carves, carved_half_width_m, radius_m, 7);
  drawing->finish();
  drawings_.push_back({size, std::move(drawing)});
  return {};
}

Curve& FrameSet::curve(Axis& axis) const {
  return software_ ? axis.curve("raymarch frame, processor time", scree::measure::frame_ms, Typical::least)
                   : axis.curve("raymarch frame", scree::measure::frame_ms, Typical::least);
}

Result<void> FrameSet::measure(Axis& axis, int rounds) {
  Curve& clock = axis.curve("raymarch frame", scree::measure::frame_ms, Typical::least);
  if (!software_) clock.limit(1000.0 / 60.0, "60 frames a second");
  for (int round = 0; round < rounds; ++round)
    for (const Sized& one : drawings_) {
      const double before_s = cpu_s(CLOCK_PROCESS_CPUTIME_ID);
      const auto ms = TRY(one.drawing->frame_ms(frame_width, frame_height, frames_at_once));
      clock.add(one.size, ms);
      // With the frame that warms up.
      if (software_)
        curve(axis).add(one.size, (cpu_s(CLOCK_PROCESS_CPUTIME_ID) - before_s) * 1e3 / (frames_at_once + 1));
    }
  return {};
}

}  // namespace scree
