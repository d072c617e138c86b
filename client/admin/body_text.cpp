// Lists of bodies and joints, and answers to questions about space, in lines and as JSON.
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "client/admin/admin.h"
#include "shared/base/overloaded.h"
#include "shared/field/mass.h"

namespace scree {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(glm::vec3 v) {
  return Json::array({v.x, v.y, v.z});
}

Json json_of(const glm::quat& turn) {
  return Json::array({turn.w, turn.x, turn.y, turn.z});
}

/// To centimetres, and no "-0.00".
std::string words_of(glm::vec3 v) {
  const glm::vec3 shown = glm::round(100.0F * v) / 100.0F + 0.0F;
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", shown.x, shown.y, shown.z);
}

std::string kind_of(const BodyRow& row) {
  if (!row.is_prop) return row.kept ? "kept piece" : "piece";
  return row.motion == PropMotion::dynamic ? "prop" : std::string(name_of(row.motion)) + " prop";
}

Json json_of(const BodyRow& row) {
  Json json{{"id", row.id},
            {"kind", row.is_prop ? "prop" : "piece"},
            {"place_m", json_of(dequantise(row.pose).position_m)},
            {"turn_wxyz", json_of(dequantise(row.pose).rotation)},
            {"velocity_m_s", json_of(row.velocity_m_s)},
            {"speed_m_s", glm::length(row.velocity_m_s)},
            {"mass_kg", row.mass_kg}};
  if (!row.is_prop) json["kept"] = row.kept;
  if (row.is_prop) json["motion"] = name_of(row.motion);
  if (row.is_prop) json["tag"] = row.tag;
  return json;
}

Json json_of(const JointSide& side) {
  return {{"body", side.body}, {"place_m", json_of(side.place_m)}};
}

Json json_of(const KnownJoint& known) {
  const Joint& joint = known.joint;
  Json json{
      {"id", known.id}, {"kind", name_of(joint.kind)}, {"a", json_of(joint.a)}, {"b", json_of(joint.b)}};
  if (joint.limits) json["limits"] = {joint.limits->low, joint.limits->high};
  if (joint.motor.greatest > 0.0F)
    json["motor"] = {{"speed", joint.motor.speed}, {"greatest", joint.motor.greatest}};
  if (traits_of(joint.kind).has_length) json["length_m"] = joint.length_m;
  if (joint.break_force_n > 0.0F) json["break_force_n"] = joint.break_force_n;
  if (joint.break_torque_nm > 0.0F) json["break_torque_nm"] = joint.break_torque_nm;
  json["touches"] = joint.touches;
  return json;
}

std::string words_of(const JointSide& side) {
  if (side.holds_terrain()) return "terrain at " + words_of(side.place_m);
  return fmt::format("body {} at {} of it", side.body, words_of(side.place_m));
}

std::string words_of(const KnownJoint& known) {
  const Joint& joint = known.joint;
  std::string line = fmt::format("{:>8}  {:<8}  {}, {}", known.id, name_of(joint.kind), words_of(joint.a),
                                 words_of(joint.b));
  const bool turns = joint.kind == JointKind::hinge;
  if (joint.limits)
    line += fmt::format(", from {:g} to {:g} {}", joint.limits->low, joint.limits->high, turns ? "rad" : "m");
  if (joint.motor.greatest > 0.0F)
    line += fmt::format(", motor {:g} {} by {:g} {} at most", joint.motor.speed, turns ? "rad/s" : "m/s",
                        joint.motor.greatest, turns ? "N m" : "N");
  if (traits_of(joint.kind).has_length) line += fmt::format(", {:.2f} m", joint.length_m);
  return line;
}

template <typename Row>
std::string list_json(const char* name, const std::vector<Row>& rows, uint32_t left_out) {
  Json list = Json::array();
  for (const Row& row : rows) list.push_back(json_of(row));
  return Json{{name, std::move(list)}, {"left_out", left_out}}.dump(2) + "\n";
}

std::string rest_of(const AdminListMessage& list) {
  return list.left_out == 0 ? "" : fmt::format("{} more: name a smaller box\n", list.left_out);
}

constexpr const char* hit_names[] = {"terrain", "piece", "prop"};

/// What an answer is said by.
struct Terms {
  const Palette& palette;
  float voxel_size_m;

  std::string name(Material material) const {
    return palette.has(material) ? palette.row(material).name
                                 : fmt::format("material {}", row_number(material));
  }
  double kg(const MaterialMass& one) const {
    if (!palette.has(one.material)) return 0.0;
    const double voxels = static_cast<double>(one.mass) / units_per_voxel, side_m = voxel_size_m;
    return voxels * side_m * side_m * side_m * palette.row(one.material).density_kg_m3;
  }
};

Json json_of(const Hit& hit, const Terms& terms) {
  Json json{{"kind", hit_names[static_cast<size_t>(hit.kind)]}};
  if (hit.kind != HitKind::terrain) json["id"] = hit.id;
  json["distance_m"] = hit.distance_m;
  json["place_m"] = json_of(hit.place_m);
  json["normal"] = json_of(hit.normal);
  if (hit.kind != HitKind::body) json["material"] = terms.name(hit.material);
  json["inside"] = hit.inside;
  return json;
}

Json json_of(const QuestionAnswer& answer, const Terms& terms) {
  return std::visit(
      Overloaded{[&](const std::optional<Hit>& hit) {
                   return Json{{"hit", hit ? json_of(*hit, terms) : Json(nullptr)}};
                 },
                 [](const Overlapping& found) {
                   return Json{{"terrain", found.terrain}, {"ids", found.ids}};
                 },
                 [](bool solid) {
                   return Json{{"solid", solid}};
                 },
                 [&](const BoxContent& content) {
                   Json masses = Json::array();
                   for (const MaterialMass& one : content.masses)
                     masses.push_back(
                         {{"material", terms.name(one.material)}, {"kg", terms.kg(one)}, {"mass", one.mass}});
                   return Json{{"rock_m3", content.rock_m3}, {"masses", masses}};
                 },
                 [](const std::vector<PieceId>& ids) {
                   return Json{{"ids", ids}};
                 }},
      answer);
}

std::string words_of(const Hit& hit, const Terms& terms) {
  std::string what = hit_names[static_cast<size_t>(hit.kind)];
  if (hit.kind != HitKind::terrain) what += fmt::format(" {}", hit.id);
  if (hit.kind != HitKind::body) what += " of " + terms.name(hit.material);
  return fmt::format("{}, {:.3f} m away at {}, normal {}{}", what, hit.distance_m, words_of(hit.place_m),
                     words_of(hit.normal), hit.inside ? ", from inside" : "");
}

std::string words_of(const std::vector<PieceId>& ids) {
  return ids.empty() ? "no body" : fmt::format("bodies {}", fmt::join(ids, " "));
}

std::string words_of(const QuestionAnswer& answer, const Terms& terms) {
  return std::visit(
      Overloaded{[&](const std::optional<Hit>& hit) { return hit ? words_of(*hit, terms) : "nothing"; },
                 [](const Overlapping& found) {
                   return (found.terrain ? "terrain, " : "no terrain, ") + words_of(found.ids);
                 },
                 [](bool solid) { return std::string(solid ? "solid" : "not solid"); },
                 [&](const BoxContent& content) {
                   std::string line = fmt::format("{:.3f} m3 of rock", content.rock_m3);
                   for (const MaterialMass& one : content.masses)
                     line += fmt::format(", {}: {:.0f} kg", terms.name(one.material), terms.kg(one));
                   return line;
                 },
                 [](const std::vector<PieceId>& ids) { return words_of(ids); }},
      answer);
}

}  // namespace

std::string bodies_json(const AdminListMessage& list) {
  return list_json("bodies", list.bodies, list.left_out);
}

std::string bodies_lines(const AdminListMessage& list) {
  if (list.bodies.empty()) return "no body\n";
  std::string lines = "      id  kind            m/s          kg  place in metres, tag\n";
  for (const BodyRow& row : list.bodies) {
    lines +=
        fmt::format("{:>8}  {:<14} {:>5.1f} {:>11.1f}  {}", row.id, kind_of(row),
                    glm::length(row.velocity_m_s), row.mass_kg, words_of(dequantise(row.pose).position_m));
    if (row.tag != 0) lines += fmt::format(", tag {}", row.tag);
    lines += "\n";
  }
  return lines + rest_of(list);
}

std::string joints_json(const AdminListMessage& list) {
  return list_json("joints", list.joints, list.left_out);
}

std::string joints_lines(const AdminListMessage& list) {
  std::string lines;
  for (const KnownJoint& joint : list.joints) lines += words_of(joint) + "\n";
  return list.joints.empty() ? "no joint\n" : lines + rest_of(list);
}

bool names_materials(const SpaceAnswer& said) {
  if (std::holds_alternative<BoxContent>(said.answer)) return true;
  const auto* hit = std::get_if<std::optional<Hit>>(&said.answer);
  return hit != nullptr && *hit && (*hit)->kind != HitKind::body;
}

std::string answer_json(const SpaceAnswer& said, const Palette& palette) {
  Json json{{"tick", said.tick}};
  json.update(json_of(said.answer, {palette, said.voxel_size_m}));
  if (said.more) json["more"] = true;
  return json.dump(2) + "\n";
}

std::string answer_lines(const SpaceAnswer& said, const Palette& palette) {
  return fmt::format("{}{} (tick {})\n", words_of(said.answer, {palette, said.voxel_size_m}),
                     said.more ? " and more" : "", said.tick);
}

}  // namespace scree
