// Draws the pictures of docs/: small scenes, simulated tick by tick and drawn at chosen ticks. Every run
// gives the same pictures, except for differences between graphics drivers.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "bench/support/canyon_show.h"
#include "bench/support/scratch.h"
#include "bench/support/stage.h"
#include "client/render/methods.h"
#include "client/render/scene/joint_lines.h"
#include "client/render/scene/look_at.h"
#include "client/viewer/events/dust.h"
#include "client/viewer/events/piece_event_detector.h"
#include "client/viewer/pictures/png.h"
#include "client/viewer/session/overlay.h"
#include "server/store/recorder.h"
#include "server/world/world.h"
#include "tools/scenes/build.h"
#include "tools/scenes/structures.h"

namespace scree {
namespace {

constexpr float view_radius_m = 48.0F;
constexpr int width = 560;
constexpr int height = 315;
const TerrainSource canyon{TerrainKind::canyon, 1, 0.25F};

[[noreturn]] void give_up(const std::string& why) {
  std::fprintf(stderr, "scree-pictures: %s\n", why.c_str());
  std::exit(1);
}

WorldConfig canyon_world() {
  WorldConfig config;
  config.terrain = canyon;
  return config;
}

/// A world, and the means to take pictures of it at any tick.
class Film {
 public:
  Film(Stage& stage, std::string folder, const WorldConfig& config = canyon_world())
      : stage_(stage), folder_(std::move(folder)), world_(config) {
    world_.want_physics(true);
    piece_events_.step(scene(), -1.0 / world_.config().tick_rate_hz, *world_.config().palette);
    stage_.renderer->set_terrain(config.terrain);
    stage_.renderer->set_palette(config.palette);
  }

  /// Builds the scene that the configuration is of.
  void build(const SceneSetup& scene) {
    if (const Result<void> built = build_scene(world_, scene); !built) give_up(built.error().message);
    follow_props(world_.keyframe());
  }
  void run(int ticks) {
    for (int i = 0; i < ticks; ++i) step({});
  }
  /// Props at these places, all in one tick; and joints likewise.
  std::vector<JointFrame> add(const std::vector<std::pair<Prop, glm::vec3>>& props) {
    std::vector<Command> commands;
    for (const auto& [prop, place_m] : props) commands.push_back({0, 0, AddPropRequest{prop, place_m}});
    std::vector<JointFrame> frames;
    for (const Reply& reply : step(commands)->replies) {
      const Pose& pose = props_.at(reply.prop.value_or(0)).pose;
      frames.push_back({reply.prop.value_or(0), pose.position_m, pose.rotation});
    }
    return frames;
  }
  void join(const std::vector<Joint>& joints) {
    std::vector<Command> commands;
    for (const Joint& joint : joints) commands.push_back({0, 0, AddJointRequest{joint}});
    step(commands);
  }
  void ask(const CarveRequest& carve) { step({{0, 0, carve}}); }
  void ask(const FillRequest& fill) { step({{0, 0, fill}}); }
  /// Until nothing moves any more.
  void settle() {
    constexpr int ticks_max = 3600;
    for (int i = 0; !pieces_.empty(); ++i) {
      if (i == ticks_max) give_up("a scene does not come to rest");
      step({});
    }
  }

  /// `name`.png, drawn by a method made for it.
  void shoot(const std::string& name, const Camera& camera, std::string_view method = "raymarch",
             bool overlay = false) {
    const MethodEntry& entry = *method_named(method);
    if (const auto missing = entry.missing()) give_up("method " + std::string(method) + " needs " + *missing);
    Result<std::unique_ptr<DrawMethod>> drawn = entry.make(stage_.pool, view_radius_m);
    if (!drawn) give_up(drawn.error().message);
    MirrorChanges all;
    for (const auto& [id, piece] : pieces_) all.pieces_added.push_back(id);
    (*drawn)->changed(all);
    do {
      (*drawn)->update(scene(), camera);
      std::this_thread::yield();
    } while (!(*drawn)->complete());
    if (const Result<void> shown = stage_.renderer->set_props(props_); !shown) give_up(shown.error().message);
    stage_.renderer->set_contacts(contacts_of(scene(), camera.eye_m));
    stage_.renderer->set_particles(dust_.at(now_s(), camera.eye_m));
    LineList lines;
    add_joints(lines, joints_, scene(), camera.eye_m);
    if (overlay && physics_) add_physics(lines, *physics_, scene());
    const Result<Image> image = stage_.renderer->draw_image(**drawn, camera, width, height, lines);
    if (!image) give_up(image.error().message);
    const std::string file = folder_ + "/" + name + ".png";
    if (const Result<void> written = write_png(file, *image); !written) give_up(written.error().message);
    std::printf("%s: tick %llu, %zu pieces, %zu props\n", file.c_str(),
                static_cast<unsigned long long>(world_.tick()), pieces_.size(), props_.size());
  }

 private:
  std::shared_ptr<const TickDelta> step(const std::vector<Command>& commands) {
    const std::shared_ptr<const TickDelta> delta = world_.step(commands);
    for (const Reply& reply : delta->replies)
      if (!reply.refusal.empty()) give_up(reply.refusal);
    for (const SpawnedPiece& piece : delta->spawned) volumes_[piece.id] = piece.volume;
    pieces_.clear();
    for (const PieceState& piece : delta->pieces)
      pieces_[piece.id] = {volumes_.at(piece.id), dequantise(piece.pose)};
    follow_props(*delta);
    if (delta->physics) physics_ = delta->physics;
    dust_.add(piece_events_.step(scene(), now_s(), *world_.config().palette), now_s());
    return delta;
  }
  void follow_props(const TickDelta& delta) {
    for (const AddedJoint& added : delta.joints_added) joints_.insert_or_assign(added.id, *added.joint);
    for (const EndedJoint& ended : delta.joints_removed) joints_.erase(ended.id);
    for (const SpawnedProp& prop : delta.props_spawned) props_of_[prop.id] = prop.prop;
    props_.clear();
    for (const PieceState& prop : delta.props)
      props_[prop.id] = {props_of_.at(prop.id), dequantise(prop.pose)};
  }
  Scene scene() const { return {world_.field(), pieces_, props_}; }
  double now_s() const { return static_cast<double>(world_.tick()) / world_.config().tick_rate_hz; }

  Stage& stage_;
  std::string folder_;
  World world_;
  ScenePieces pieces_;
  std::map<PieceId, std::shared_ptr<const Volume>> volumes_;
  SceneProps props_;
  std::map<PieceId, std::shared_ptr<const Prop>> props_of_;
  SceneJoints joints_;
  std::shared_ptr<const PhysicsMessage> physics_;
  PieceEventDetector piece_events_;
  Dust dust_;
};

float ground_m(float x, float z) {
  return ground_height_m(canyon, x, z);
}

/// A blow against the cliff: the hole, the cracks about the impact, the flight, the heap, the ground.
void draw_blast(Film& film) {
  const glm::vec3 impact_m(1.6F, 5.0F, 20.0F);
  const Camera camera = look_at({11.0F, 5.6F, 25.5F}, {2.2F, 2.5F, 20.0F});
  film.shoot("cliff", camera);
  film.ask(strike(crater({0.6F, 5.0F, 20.0F}, 2.4F), impact_m, 80, 2.0F));
  film.run(6);
  film.shoot("fracture", camera);
  film.run(60);
  film.shoot("flight", camera);
  film.run(75);
  film.shoot("rest", camera);
  film.shoot("overlay", camera, "raymarch", true);
  film.settle();
  film.shoot("merged", camera);
}

/// A tower, built of rock, loses its foot.
void draw_tower(Film& film) {
  const float x = 9.0F, z = -27.0F, base_m = ground_m(x, z);
  for (const float up_m : {1.5F, 4.5F, 7.5F})
    film.ask(FillRequest{box({x, base_m + up_m, z}, {1.3F, 2.0F, 1.3F})});
  const Camera camera = look_at({x + 13.0F, base_m + 5.0F, z + 11.0F}, {x, base_m + 4.2F, z});
  film.shoot("tower_before", camera);
  const glm::vec3 foot_m(x, base_m + 1.3F, z);
  film.ask(strike(sphere(foot_m, 2.1F), foot_m + glm::vec3(1.0F, 0.0F, 1.0F), 30, 6.0F));
  film.run(120);
  film.shoot("tower_during", camera);
  film.settle();
  film.shoot("tower_after", camera);
}

/// Two walls, broken into as many pieces: uniform on the left, even on the right.
void draw_patterns(Film& film) {
  const float x = 9.0F, middle_z = -24.0F;
  const float up_m = std::max(ground_m(x, middle_z - 3.0F), ground_m(x, middle_z + 3.0F)) + 2.0F;
  for (const auto& [pattern, z] :
       {std::pair(SeedPattern::uniform, middle_z + 3.0F), std::pair(SeedPattern::even, middle_z - 3.0F)}) {
    const Shape wall = box({x, up_m, z}, {0.6F, 2.0F, 2.5F});
    film.ask(FillRequest{wall});
    CarveRequest carve = strike(box({x, up_m, z}, {0.8F, 2.2F, 2.7F}), {x + 4.0F, up_m, z}, 40, 3.0F);
    carve.pattern = pattern;
    film.ask(carve);
  }
  film.run(12);
  film.shoot("patterns", look_at({x + 7.0F, up_m + 0.8F, middle_z}, {x, up_m - 0.1F, middle_z}));
}

/// The arch, cut at both feet, falls as one.
void draw_arch(Film& film) {
  const Camera camera = look_at({31.0F, 6.0F, 9.0F}, {15.0F, 3.8F, 0.0F});
  for (const float z : {-7.4F, 7.4F}) {
    const glm::vec3 foot_m(15.0F, 1.8F, z);
    film.ask(strike(crater(foot_m, 2.8F), foot_m + glm::vec3(2.0F, 0.0F, 0.0F), 24, 4.0F));
  }
  film.run(30);
  film.shoot("island", camera);
  film.run(45);
  film.shoot("impact", camera);
  film.settle();
  film.shoot("island_after", camera);
}

Prop prop_of(PropPart part, float mass_kg, PropMotion motion = PropMotion::dynamic) {
  return {.parts = {std::move(part)}, .motion = motion, .mass_kg = mass_kg};
}

/// A car, a drawbridge on two ropes, and a rope that hangs between two posts.
void draw_joints(Film& film) {
  const float base_m = ground_m(9.0F, -24.0F);
  film.ask(FillRequest{box({9.0F, base_m, -24.0F}, {7.0F, 0.5F, 5.0F})});
  const auto at = [&](float x, float up, float z) {
    return glm::vec3(9.0F + x, base_m + 0.5F + up, -24.0F + z);
  };
  const auto bar = [](glm::vec3 half_m) { return PropPart{.kind = PropPartKind::box, .half_m = half_m}; };
  const Prop post = prop_of(bar({0.12F, 1.6F, 0.12F}), 50.0F, PropMotion::fixed);
  const Prop wheel = prop_of({.kind = PropPartKind::cylinder,
                              .turn = {0.70710678F, 0.70710678F, 0.0F, 0.0F},
                              .half_m = {0.5F, 0.15F, 0.0F}},
                             40.0F);
  std::vector<std::pair<Prop, glm::vec3>> props{
      {prop_of(bar({1.2F, 0.2F, 0.6F}), 600.0F), at(-3, 0.7F, 2.5F)},
      {prop_of(bar({1.4F, 0.08F, 1.0F}), 200.0F), at(3, 0.6F, 0)}};
  for (const float z : {-1.2F, 1.2F}) props.emplace_back(post, at(1.2F, 1.6F, z));
  props.emplace_back(post, at(-5.0F, 1.6F, -2.0F));
  props.emplace_back(prop_of(bar({0.5F, 1.6F, 0.5F}), 4000.0F), at(-1.0F, 1.65F, -2.0F));
  const size_t first_wheel = props.size();
  for (const float x : {-1.0F, 1.0F})
    for (const float z : {-0.9F, 0.9F}) props.emplace_back(wheel, at(-3.0F + x, 0.6F, 2.5F + z));
  const std::vector<JointFrame> there = film.add(props);
  std::vector<Joint> joints{joint_at(JointKind::hinge, {}, there[1], at(1.5F, -0.2F, 0), {0, 0, 1})};
  for (size_t i = first_wheel; i < there.size(); ++i)
    joints.push_back(joint_at(JointKind::hinge, there[0], there[i], there[i].origin_m, {0, 0, 1}));
  for (const float z : {-1.0F, 1.0F})
    joints.push_back(line_between(JointKind::rope, there[z < 0 ? 2 : 3], at(1.2F, 3.0F, 1.2F * z), there[1],
                                  at(4.3F, 0.7F, z)));
  joints.push_back(line_between(JointKind::rope, there[4], at(-5, 3.1F, -2), there[5], at(-1, 3.1F, -2)));
  joints.back().length_m *= 1.2F;
  film.join(joints);
  film.run(90);
  film.shoot("joints", look_at(at(2, 4, 11), at(-0.3F, 1, 0)));
}

/// One carved scene, some of it in flight, by every method.
void draw_methods(Film& film) {
  const auto hit = [&](glm::vec3 at_m) {
    film.ask(strike(crater(at_m, 2.2F), at_m + glm::vec3(1.5F, 0.5F, 0.0F), 40, 5.0F));
  };
  hit({0.6F, 5.0F, 14.0F});
  hit({0.4F, 8.5F, 17.0F});
  hit({9.0F, ground_m(9.0F, 14.0F), 14.0F});
  film.settle();
  hit({0.6F, 6.0F, 19.0F});
  film.run(30);
  const Camera camera = look_at({14.0F, 7.0F, 22.0F}, {2.0F, 3.0F, 15.0F});
  for (const MethodEntry& entry : all_methods())
    film.shoot("method_" + std::string(entry.name), camera, entry.name);
}

/// A scene as it is built, struck, and at rest, by every method.
void draw_by_all_methods(Stage& stage, const std::string& folder, const std::string& name,
                         const Camera& camera) {
  const ScratchFolder grounds("pictures");
  const Result<SceneSetup> scene = scene_named(name)->set_up(grounds / "");
  if (!scene) give_up(scene.error().message);
  Film film(stage, folder, scene->config);
  film.build(*scene);
  const auto shoot = [&](const std::string& when) {
    for (const MethodEntry& entry : all_methods())
      film.shoot(name + "_" + when + "_" + std::string(entry.name), camera, entry.name);
  };
  shoot("before");
  for (const CarveRequest& strike : scene->strikes) film.ask(strike);
  film.run(36);
  shoot("during");
  film.settle();
  shoot("after");
}

/// Each scene as it is built, struck, and at rest.
void draw_scenes(Stage& stage, const std::string& folder, const std::string& only) {
  const ScratchFolder grounds("pictures");
  for (const SceneRow& row : all_scenes()) {
    if (!only.empty() && only != row.name) continue;
    const Result<SceneSetup> scene = row.set_up(grounds / "");
    if (!scene) give_up(scene.error().message);
    Film film(stage, folder, scene->config);
    film.build(*scene);
    const Camera camera = look_at(scene->eye_m, scene->target_m);
    const std::string name = "scene_" + std::string(row.name);
    film.shoot(name, camera);
    for (const CarveRequest& strike : scene->strikes) {
      film.ask(strike);
      film.run(12);
    }
    film.run(24);
    film.shoot(name + "_struck", camera);
    film.settle();
    film.shoot(name + "_settled", camera);
  }
}

/// The scene of the README's film: `scree replay render` draws it.
void record_show(const std::string& file) {
  const WorldConfig config = canyon_world();
  World world(config);
  auto recorder = Recorder::create(file, {"scree-pictures", config});
  if (!recorder) give_up(recorder.error().message);
  const std::vector<TimedBlow> show = canyon_show();
  for (Tick tick = 1; tick <= canyon_show_ticks; ++tick) {
    std::vector<Command> commands;
    for (const TimedBlow& timed : show)
      if (timed.tick == tick) commands.push_back({0, 0, timed.carve});
    auto delta = world.step(commands);
    for (const Reply& reply : delta->replies)
      if (!reply.refusal.empty()) give_up(reply.refusal);
    (*recorder)->push(std::move(delta), std::move(commands));
  }
  if (const Result<void> finished = (*recorder)->finish(); !finished) give_up(finished.error().message);
}

struct Scenario {
  std::string_view name;
  void (*draw)(Film&);
};

constexpr std::array scenarios{Scenario{"blast", draw_blast},     Scenario{"patterns", draw_patterns},
                               Scenario{"tower", draw_tower},     Scenario{"arch", draw_arch},
                               Scenario{"methods", draw_methods}, Scenario{"joints", draw_joints}};

}  // namespace
}  // namespace scree

int main(int argc, char** argv) {
  using namespace scree;
  std::string folder = "docs/images", only, recording, scene;
  bool scenes = false;
  CLI::App app("Draws the pictures of Scree's documentation.", "scree-pictures");
  app.set_version_flag("--version", SCREE_VERSION);
  app.option_defaults()->always_capture_default();
  app.add_option("--out", folder, "folder for the PNGs");
  app.add_option("--only", only,
                 "draw only one of blast, patterns, tower, arch, methods, joints, street, store");
  app.add_flag("--scenes", scenes, "draw every scene instead of the documentation's pictures");
  app.add_option("--scene", scene, "draw only this scene: " + scene_names())
      ->check([](const std::string& name) {
        return scene_named(name) == nullptr
                   ? "there is no scene '" + name + "'; the scenes are " + scene_names()
                   : "";
      });
  app.add_option("--record", recording,
                 "draw no pictures, but write the recording of the README's film to this file");
  CLI11_PARSE(app, argc, argv);
  if (!recording.empty()) {
    record_show(recording);
    return 0;
  }
  std::filesystem::create_directories(folder);
  const Result<std::unique_ptr<Stage>> stage = Stage::create(view_radius_m);
  if (!stage) give_up(stage.error().message);
  (*stage)->renderer->set_fineness({.render_scale = 2.0F});
  if (scenes || !scene.empty()) {
    draw_scenes(**stage, folder, scene);
    return 0;
  }
  for (const Scenario& scenario : scenarios) {
    if (!only.empty() && only != scenario.name) continue;
    Film film(**stage, folder);
    scenario.draw(film);
  }
  if (only.empty() || only == "street")
    draw_by_all_methods(**stage, folder, "street", look_at({6.5F, 5.5F, 15.5F}, {-2.0F, 3.4F, -4.0F}));
  if (only.empty() || only == "store")
    draw_by_all_methods(**stage, folder, "store", look_at({4.6F, 3.0F, 6.4F}, {-0.6F, 1.1F, -0.8F}));
  return 0;
}
