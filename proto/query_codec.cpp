#include "proto/query_codec.h"

#include <algorithm>
#include <fmt/format.h>

#include "proto/limits.h"
#include "shared/base/overloaded.h"
#include "shared/base/text.h"
#include "shared/query/limits.h"

namespace scree {

namespace {

using WireIds = google::protobuf::RepeatedField<uint32_t>;

void write_mask(wire::QueryMask& to, const QueryMask& from) {
  to.set_no_terrain(!from.terrain);
  to.set_no_pieces(!from.pieces);
  to.set_no_props(!from.bodies);
  if (from.groups != QueryMask().groups) to.set_groups(from.groups);
  to.mutable_except()->Add(from.except.begin(), from.except.end());
}

QueryMask read_mask(const wire::QueryMask& from, FieldChecker& check) {
  QueryMask mask;
  mask.terrain = !from.no_terrain();
  mask.pieces = !from.no_pieces();
  mask.bodies = !from.no_props();
  if (from.has_groups()) mask.groups = from.groups();
  if (static_cast<size_t>(from.except_size()) > limits::query_excepted_max)
    check.refuse(fmt::format("a mask excepts {} ids, which is over the limit of {}", from.except_size(),
                             limits::query_excepted_max));
  else
    mask.except.assign(from.except().begin(), from.except().end());
  return mask;
}

/// Writes the place and the way of a cast.
template <typename Cast>
void write_way(Cast& to, glm::vec3 unit, float most_m) {
  scree::write(*to.mutable_direction(), unit);
  to.set_most_m(most_m);
}

void write_box(wire::SpaceBox& to, glm::vec3 lo_m, glm::vec3 hi_m) {
  scree::write(*to.mutable_lo(), lo_m);
  scree::write(*to.mutable_hi(), hi_m);
}

struct AskedWriting {
  wire::Question& to;

  void operator()(const UnknownQuestion&) const {}
  void operator()(const RayQuestion& from) const {
    scree::write(*to.mutable_ray()->mutable_from(), from.from_m);
    write_way(*to.mutable_ray(), from.unit, from.most_m);
  }
  void operator()(const SphereQuestion& from) const {
    scree::write(*to.mutable_ball()->mutable_from(), from.from_m);
    write_way(*to.mutable_ball(), from.unit, from.most_m);
    to.mutable_ball()->set_radius_m(from.radius_m);
  }
  void operator()(const CapsuleQuestion& from) const {
    scree::write(*to.mutable_capsule()->mutable_a(), from.a_m);
    scree::write(*to.mutable_capsule()->mutable_b(), from.b_m);
    write_way(*to.mutable_capsule(), from.unit, from.most_m);
    to.mutable_capsule()->set_radius_m(from.radius_m);
  }
  void operator()(const InSphereQuestion& from) const {
    scree::write(*to.mutable_in_ball()->mutable_centre(), from.centre_m);
    to.mutable_in_ball()->set_radius_m(from.radius_m);
  }
  void operator()(const InBoxQuestion& from) const { write_box(*to.mutable_in_box(), from.lo_m, from.hi_m); }
  void operator()(const NearestQuestion& from) const {
    scree::write(*to.mutable_nearest()->mutable_place(), from.place_m);
    to.mutable_nearest()->set_most_m(from.most_m);
  }
  void operator()(const SolidQuestion& from) const { scree::write(*to.mutable_solid(), from.place_m); }
  void operator()(const ContentQuestion& from) const {
    write_box(*to.mutable_content(), from.lo_m, from.hi_m);
  }
  void operator()(const BodiesQuestion& from) const { write_box(*to.mutable_bodies(), from.lo_m, from.hi_m); }
};

template <typename Box>
Box read_space_box(const wire::SpaceBox& from, FieldChecker& check) {
  return {check.vec3(from.lo(), "lower corner of a box"), check.vec3(from.hi(), "upper corner of a box")};
}

constexpr const char* place_asked = "place of a question";
constexpr const char* direction_asked = "direction of a question";
constexpr const char* length_asked = "length of a question";
constexpr const char* radius_asked = "radius of a question";

AskedFor read_asked(const wire::Question& from, FieldChecker& check) {
  switch (from.kind_case()) {
    case wire::Question::kRay:
      return RayQuestion{check.vec3(from.ray().from(), place_asked),
                         check.vec3(from.ray().direction(), direction_asked),
                         check.finite(from.ray().most_m(), length_asked)};
    case wire::Question::kBall:
      return SphereQuestion{check.vec3(from.ball().from(), place_asked),
                            check.vec3(from.ball().direction(), direction_asked),
                            check.finite(from.ball().most_m(), length_asked),
                            check.finite(from.ball().radius_m(), radius_asked)};
    case wire::Question::kCapsule:
      return CapsuleQuestion{check.vec3(from.capsule().a(), place_asked),
                             check.vec3(from.capsule().b(), place_asked),
                             check.vec3(from.capsule().direction(), direction_asked),
                             check.finite(from.capsule().most_m(), length_asked),
                             check.finite(from.capsule().radius_m(), radius_asked)};
    case wire::Question::kInBall:
      return InSphereQuestion{check.vec3(from.in_ball().centre(), place_asked),
                              check.finite(from.in_ball().radius_m(), radius_asked)};
    case wire::Question::kInBox:
      return read_space_box<InBoxQuestion>(from.in_box(), check);
    case wire::Question::kNearest:
      return NearestQuestion{check.vec3(from.nearest().place(), place_asked),
                             check.finite(from.nearest().most_m(), length_asked)};
    case wire::Question::kSolid:
      return SolidQuestion{check.vec3(from.solid(), place_asked)};
    case wire::Question::kContent:
      return read_space_box<ContentQuestion>(from.content(), check);
    case wire::Question::kBodies:
      return read_space_box<BodiesQuestion>(from.bodies(), check);
    case wire::Question::KIND_NOT_SET:
      break;
  }
  return UnknownQuestion{};
}

/// Whether ids are left out.
bool write_ids(WireIds& to, const std::vector<PieceId>& from) {
  const size_t count = std::min(from.size(), limits::query_ids_max);
  to.Add(from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count));
  return count < from.size();
}

std::vector<PieceId> read_ids(const WireIds& from, FieldChecker& check) {
  if (static_cast<size_t>(from.size()) > limits::query_ids_max) {
    check.refuse(fmt::format("an answer of more than {} ids", limits::query_ids_max));
    return {};
  }
  return {from.begin(), from.end()};
}

void write_hit(wire::QueryHit& to, const Hit& from) {
  to.set_kind(static_cast<wire::HitKind>(from.kind));
  to.set_id(from.id);
  to.set_distance_m(from.distance_m);
  scree::write(*to.mutable_place(), from.place_m);
  scree::write(*to.mutable_normal(), from.normal);
  to.set_material(static_cast<uint32_t>(from.material));
  to.set_inside(from.inside);
}

Hit read_hit(const wire::QueryHit& from, FieldChecker& check) {
  Hit hit;
  const auto kind = static_cast<uint32_t>(from.kind());
  hit.kind =
      static_cast<HitKind>(check.within(kind, 0, static_cast<uint32_t>(HitKind::body), "kind of a hit"));
  hit.id = from.id();
  hit.distance_m = check.not_negative(from.distance_m(), "distance of a hit");
  hit.place_m = check.vec3(from.place(), "place of a hit");
  hit.normal = check.vec3(from.normal(), "normal of a hit");
  hit.material = static_cast<Material>(
      check.within(from.material(), 0, static_cast<uint32_t>(materials_max) - 1, "material of a hit"));
  hit.inside = from.inside();
  return hit;
}

BoxContent read_content(const wire::BoxHolds& from, FieldChecker& check) {
  BoxContent content;
  content.rock_m3 = from.rock_m3();
  if (!(content.rock_m3 >= 0.0 && content.rock_m3 <= 1e9)) check.refuse("rock of a box that no box holds");
  if (static_cast<size_t>(from.masses_size()) > materials_max) {
    check.refuse("masses of more materials than there are");
    return content;
  }
  for (const wire::MassOf& mass : from.masses())
    content.masses.push_back(
        {static_cast<Material>(check.within(mass.material(), 0, static_cast<uint32_t>(materials_max) - 1,
                                            "material of a mass")),
         mass.mass()});
  return content;
}

void write_reply(wire::Answered& to, const QuestionReply& from) {
  to.set_more(from.more);
  if (!from.answer) {
    to.set_refusal(showable(from.refusal, limits::reason_bytes_max));
    to.set_refusal_name(showable(from.refusal_name, limits::refusal_name_bytes_max));
    return;
  }
  const auto more = [&](bool left_out) { to.set_more(from.more || left_out); };
  std::visit(Overloaded{[&](const std::optional<Hit>& hit) {
                          if (hit)
                            write_hit(*to.mutable_hit(), *hit);
                          else
                            to.set_nothing(true);
                        },
                        [&](const Overlapping& found) {
                          to.mutable_overlaps()->set_terrain(found.terrain);
                          more(write_ids(*to.mutable_overlaps()->mutable_ids(), found.ids));
                        },
                        [&](bool solid) { to.set_solid(solid); },
                        [&](const BoxContent& content) {
                          wire::BoxHolds& holds = *to.mutable_content();
                          holds.set_rock_m3(content.rock_m3);
                          for (const MaterialMass& one : content.masses) {
                            wire::MassOf& mass = *holds.add_masses();
                            mass.set_material(static_cast<uint32_t>(one.material));
                            mass.set_mass(one.mass);
                          }
                        },
                        [&](const std::vector<PieceId>& ids) {
                          more(write_ids(*to.mutable_bodies()->mutable_ids(), ids));
                        }},
             *from.answer);
}

QuestionReply read_reply(const wire::Answered& from, FieldChecker& check) {
  QuestionReply reply;
  reply.more = from.more();
  reply.refusal_name = check.text(from.refusal_name(), limits::refusal_name_bytes_max, "name of a reason");
  switch (from.kind_case()) {
    case wire::Answered::kHit:
      reply.answer = std::optional<Hit>(read_hit(from.hit(), check));
      break;
    case wire::Answered::kNothing:
      reply.answer = std::optional<Hit>();
      break;
    case wire::Answered::kOverlaps:
      reply.answer = Overlapping{from.overlaps().terrain(), read_ids(from.overlaps().ids(), check)};
      break;
    case wire::Answered::kSolid:
      reply.answer = from.solid();
      break;
    case wire::Answered::kContent:
      reply.answer = read_content(from.content(), check);
      break;
    case wire::Answered::kBodies:
      reply.answer = read_ids(from.bodies().ids(), check);
      break;
    case wire::Answered::kRefusal:
      reply.refusal = check.text(from.refusal(), limits::reason_bytes_max, "reason");
      break;
    case wire::Answered::KIND_NOT_SET:
      break;
  }
  return reply;
}

}  // namespace

void write(wire::Query& to, const QueryMessage& from) {
  to.set_query(from.query);
  to.set_as_of(from.as_of);
  for (const Question& question : from.questions) {
    wire::Question& added = *to.add_questions();
    if (!(question.mask == QueryMask())) write_mask(*added.mutable_mask(), question.mask);
    std::visit(AskedWriting{added}, question.asks);
  }
}

void write(wire::Answer& to, const AnswerMessage& from) {
  to.set_query(from.query);
  to.set_tick(from.tick);
  for (const QuestionReply& reply : from.answers) write_reply(*to.add_answers(), reply);
  to.set_refusal(showable(from.refusal, limits::reason_bytes_max));
  to.set_refusal_name(showable(from.refusal_name, limits::refusal_name_bytes_max));
}

QueryMessage read(const wire::Query& from, FieldChecker& check) {
  QueryMessage query;
  query.query = from.query();
  query.as_of = from.as_of();
  if (static_cast<size_t>(from.questions_size()) > limits::questions_max) {
    check.refuse(fmt::format("{} questions in a message are over the limit of {}", from.questions_size(),
                             limits::questions_max));
    return query;
  }
  for (const wire::Question& question : from.questions()) {
    if (check.failed()) break;
    Question one;
    if (question.has_mask()) one.mask = read_mask(question.mask(), check);
    one.asks = read_asked(question, check);
    query.questions.push_back(std::move(one));
  }
  return query;
}

AnswerMessage read(const wire::Answer& from, FieldChecker& check) {
  AnswerMessage answer;
  answer.query = from.query();
  answer.tick = from.tick();
  if (static_cast<size_t>(from.answers_size()) > limits::questions_max) {
    check.refuse(fmt::format("an answer to more than {} questions", limits::questions_max));
    return answer;
  }
  for (const wire::Answered& reply : from.answers()) {
    if (check.failed()) break;
    answer.answers.push_back(read_reply(reply, check));
  }
  answer.refusal = check.text(from.refusal(), limits::reason_bytes_max, "reason");
  answer.refusal_name = check.text(from.refusal_name(), limits::refusal_name_bytes_max, "name of a reason");
  return answer;
}

}  // namespace scree
