#include "bench/peers/body_engines.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/support/text_file.h"
#include "server/formats/world_value.h"
#include "shared/query/query.h"

namespace scree::peers {

namespace {

using nlohmann::json;

constexpr int ground_side = 256;
constexpr float ground_step_m = 0.25F, ground_low_m = -32.0F, ray_from_m = 30.0F, ray_most_m = 60.0F;

json triple(glm::vec3 value) {
  return {value.x, value.y, value.z};
}

json flat(const std::vector<glm::vec3>& corners_m, glm::vec3 shift_m) {
  json numbers = json::array();
  for (const glm::vec3& corner_m : corners_m)
    for (int axis = 0; axis < 3; ++axis) numbers.push_back(corner_m[axis] + shift_m[axis]);
  return numbers;
}

json ground_of(World& world) {
  const HeldScene held = world.scene();
  const QueryMask mask{.terrain = true, .pieces = false, .bodies = false};
  json heights = json::array();
  float lowest_m = ray_from_m;
  for (int z = 0; z < ground_side; ++z)
    for (int x = 0; x < ground_side; ++x) {
      const glm::vec3 from_m{ground_low_m + ground_step_m * static_cast<float>(x), ray_from_m,
                             ground_low_m + ground_step_m * static_cast<float>(z)};
      const auto hit = cast_ray(held.scene(), from_m, {0.0F, -1.0F, 0.0F}, ray_most_m, mask);
      const float height_m = hit && hit->answer ? hit->answer->place_m.y : 0.0F;
      lowest_m = std::min(lowest_m, height_m);
      heights.push_back(height_m);
    }
  return {{"side", ground_side},
          {"step", ground_step_m},
          {"low", ground_low_m},
          {"lowest", lowest_m},
          {"heights", std::move(heights)}};
}

json shape_of(const Prop& prop) {
  const PropPart& part = prop.parts.front();
  if (part.kind == PropPartKind::hull)
    return {{"kind", "hull"}, {"corners", flat(part.corners_m, glm::vec3(0.0F))}};
  return {{"kind", row_of(part.kind).name}, {"half", triple(part.half_m)}};
}

void add_motion(json& body, const Pose& pose, const BodyMotion& motion) {
  body["place"] = triple(pose.position_m);
  body["turn"] = {pose.rotation.x, pose.rotation.y, pose.rotation.z, pose.rotation.w};
  body["velocity"] = triple(motion.velocity_m_s);
  body["spin"] = triple(motion.spin_rad_s);
}

}  // namespace

Result<void> write_bodies(World& world, const std::string& path) {
  const WorldMoment moment = world.moment();
  const TickDelta now = world.keyframe();
  json bodies = json::array();
  const auto add = [&](json body, PieceId id, const std::vector<PieceState>& states) {
    const auto state = std::ranges::lower_bound(states, id, {}, &PieceState::id);
    const auto motion = std::ranges::lower_bound(moment.motion.bodies, id, {}, &BodyMotion::id);
    add_motion(body, dequantise(state->pose), *motion);
    bodies.push_back(std::move(body));
  };
  for (const PieceRecord& piece : moment.pieces)
    add({{"kind", "hull"},
         {"corners", flat(piece.shape->hull_m, piece.shape->centre_m)},
         {"mass", piece.shape->mass_kg},
         {"friction", piece.shape->friction},
         {"restitution", piece.shape->restitution}},
        piece.id, now.pieces);
  for (const PropRecord& record : moment.props) {
    json body = shape_of(*record.prop);
    body["mass"] = record.prop->mass_kg;
    body["friction"] = record.prop->friction;
    body["restitution"] = record.prop->restitution;
    add(std::move(body), record.id, now.props);
  }
  const json scene{{"gravity", 9.81F},
                   {"friction", moment.pieces.empty() ? 0.7F : moment.pieces.front().shape->friction},
                   {"ground", ground_of(world)},
                   {"bodies", std::move(bodies)}};
  return write_text_file(path, scene.dump());
}

Result<SteppedBodies> step_bodies_with(const std::string& engine, const std::string& path, Tick ticks) {
  const auto build =
      std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path().parent_path();
  const auto modules = build / "engines", script = build.parent_path() / "bench/peers/engines/step.mjs";
  if (!std::filesystem::exists(modules / "node_modules/.installed") || !std::filesystem::exists(script))
    return fail("not installed: ./scree bench run bodies installs it, where npm's registry can be reached");
  const std::string command = "SCREE_BENCH_MODULES='" + modules.string() + "' node '" + script.string() +
                              "' " + engine + " '" + path + "' " + std::to_string(ticks);
  std::string told;
  {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
    std::array<char, 4096> part{};
    while (pipe != nullptr && std::fgets(part.data(), part.size(), pipe.get()) != nullptr)
      told += part.data();
  }
  const json answer = json::parse(told, nullptr, false);
  if (!answer.is_object() || !answer.contains("ticksMs")) return fail("it failed; its message is above");
  return SteppedBodies{answer.value("version", ""), answer["ticksMs"].get<std::vector<double>>(),
                       answer.value("awake", size_t{0}), answer.value("through", size_t{0})};
}

}  // namespace scree::peers
