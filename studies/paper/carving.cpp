#include <fmt/format.h>

#include "bench/peers/csg_list.h"
#include "client/render/grid/grid_shape.h"
#include "shared/base/quantile.h"
#include "shared/base/random.h"
#include "studies/paper/measure.h"
#include "studies/paper/session.h"

namespace scree::paper {
namespace {

constexpr float carve_radius_m = 1.5F;
constexpr uint32_t carve_seeds = 8;
constexpr float carve_speed_m_s = 3.0F;
/// Half the side of the square about the origin in which carves fall.
constexpr float half_width_m = 13.0F;
constexpr double fresh_s = 2.0, quiet_s = 4.0, grid_s = 3.0, returned_s = 3.0, settled_s = 0.5;
/// Reaches the ground from the high camera.
constexpr GridShape session_grid{96, 4, GridSpacing::uniform};
constexpr int compared_frames = 9;

/// When what happens, in ticks.
struct Timetable {
  Tick fresh_until, carved_until, switched_at, returned_at, end;
};

Timetable timetable_of(const Plan& plan, uint32_t tick_rate_hz) {
  const auto ticks = [&](double seconds) {
    return static_cast<Tick>(seconds * plan.session_seconds_scale * tick_rate_hz);
  };
  Timetable course{};
  course.fresh_until = ticks(fresh_s);
  course.carved_until = course.fresh_until + static_cast<Tick>(plan.carves) * plan.carve_every;
  course.switched_at = course.carved_until + ticks(quiet_s);
  course.returned_at = course.switched_at + ticks(grid_s);
  course.end = course.returned_at + ticks(returned_s);
  return course;
}

glm::vec2 carved_place(int carve) {
  Random random(static_cast<uint64_t>(carve) + 1);
  const auto off = [&] { return (random.unit() * 2.0F - 1.0F) * half_width_m; };
  const float x = off(), z = off();
  return {x, z};
}

/// What draws a session; all outlive it.
struct Shown {
  DrawMethod& first;
  DrawMethod& grid;
  peers::CsgListMethod* list = nullptr;  ///< `first`, where it is the paper's
  DrawMethod* renewed = nullptr;         ///< an atlas that is to see nothing but the session's end
};

/// Draws the session as it stands, by the method that saw it and by the new one, in turns.
Result<void> compare_with_new(Stage& stage, PaperSession& session, const Shown& methods,
                              CarvingFound& found) {
  session.show(*methods.renewed, stage.pool);
  std::vector<double> lived_ms, new_ms;
  for (int i = 0; i <= compared_frames; ++i) {
    const Result<double> by_lived = session.draw(methods.first), by_new = session.draw(*methods.renewed);
    if (!by_lived || !by_new) return fail((!by_lived ? by_lived : by_new).error().message);
    if (i == 0) continue;  // warms up
    lived_ms.push_back(*by_lived);
    new_ms.push_back(*by_new);
  }
  found.atlas_lived_ms = quantile(lived_ms, 0.5);
  found.atlas_new_ms = quantile(new_ms, 0.5);
  return {};
}

Result<SessionFound> run_carving(Stage& stage, const Plan& plan, const Timetable& course,
                                 const Shown& methods, const std::function<void(Tick)>& told,
                                 CarvingFound& found) {
  PaperSession session(stage, session_config(), plan.session_picture(), high_camera());
  for (DrawMethod* method : {&methods.first, &methods.grid}) {
    session.show(*method, stage.pool);
    if (const Result<double> warm = session.draw(*method); !warm) return fail(warm.error().message);
  }
  int carves = 0;
  for (Tick at = 0; at < course.end; ++at) {
    std::vector<Command> commands;
    if (at >= course.fresh_until && at < course.carved_until &&
        (at - course.fresh_until) % plan.carve_every == 0) {
      commands.push_back(
          carve_at(session.world(), carved_place(carves++), carve_radius_m, carve_seeds, carve_speed_m_s));
      const Shape& ball = std::get<CarveRequest>(commands.back().body).shape;
      if (methods.list != nullptr)
        if (Result<void> added = methods.list->carve({ball.a, ball.radius_m}); !added)
          return fail(added.error().message);
    }
    SessionTick& tick = session.step(commands);
    tick.switched = at == course.switched_at || at == course.returned_at;
    told(at);
    if (at % plan.ticks_a_frame != 0) continue;
    const bool by_grid = at >= course.switched_at && at < course.returned_at;
    const Result<double> frame = session.draw(by_grid ? methods.grid : methods.first);
    if (!frame) return fail(frame.error().message);
    tick.draw_ms = *frame;
  }
  if (methods.renewed != nullptr)
    if (Result<void> compared = compare_with_new(stage, session, methods, found); !compared)
      return fail(compared.error().message);
  return SessionFound{"", session.ticks()};
}

Result<double> fresh_grid_ms(Stage& stage, const Plan& plan, DrawMethod& grid) {
  PaperSession session(stage, session_config(), plan.session_picture(), high_camera());
  session.show(grid, stage.pool);
  std::vector<double> frames_ms;
  for (int i = 0; i <= compared_frames; ++i) {
    const Result<double> frame = session.draw(grid);
    if (!frame) return fail(frame.error().message);
    if (i > 0) frames_ms.push_back(*frame);
  }
  return quantile(frames_ms, 0.5);
}

}  // namespace

Result<CarvingFound> measure_carving(Stage& stage, const Plan& plan, const Progress& progress) {
  const uint32_t rate_hz = session_config().tick_rate_hz;
  const Timetable course = timetable_of(plan, rate_hz);
  const auto seconds = [&](Tick tick) { return static_cast<double>(tick) / rate_hz; };
  auto march = make_method("raymarch", stage.pool), renewed = make_method("raymarch", stage.pool),
       grid = make_method("grid", stage.pool);
  for (const auto* made : {&march, &renewed, &grid})
    if (!*made) return fail(made->error().message);
  auto list = peers::make_csg_list_method({});
  if (!list) return fail(list.error().message);
  (*grid)->set_options(values_of(session_grid));
  CarvingFound found{
      .fresh_until_s = seconds(course.fresh_until),
      .switched_at_s = seconds(course.switched_at),
      .returned_at_s = seconds(course.returned_at),
      .settle_s = settled_s * plan.session_seconds_scale,
      .carves = plan.carves,
      .grid = fmt::format("{} cells a side, {} voxels apart", session_grid.resolution, session_grid.scale)};
  const Result<double> fresh_ms = fresh_grid_ms(stage, plan, **grid);
  if (!fresh_ms) return fail(fresh_ms.error().message);
  found.grid_fresh_ms = *fresh_ms;
  const auto told = [&](double from) {
    return [&progress, &course, from](Tick at) {
      progress(from + 0.5 * static_cast<double>(at) / static_cast<double>(course.end));
    };
  };
  auto atlas = run_carving(stage, plan, course, {**march, **grid, nullptr, renewed->get()}, told(0.0), found);
  if (!atlas) return fail(atlas.error().message);
  auto listed = run_carving(stage, plan, course, {**list, **grid, list->get(), nullptr}, told(0.5), found);
  if (!listed) return fail(listed.error().message);
  found.atlas = {"Scree: raymarch by an atlas of bricks", std::move(atlas->ticks)};
  found.list = {"the paper's way: raymarch by a list of carves, on its own noise", std::move(listed->ticks)};
  return found;
}

}  // namespace scree::paper
