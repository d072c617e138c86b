// Questions about space as values, as they cross the wire: each is one of the functions of query.h with its
// arguments. One that comes from outside is untrusted until validate() has passed it. Metres.
#pragma once

#include <variant>

#include "shared/query/query.h"

namespace scree {

/// A later release has it: asked for nothing that this one knows.
struct UnknownQuestion {
  bool operator==(const UnknownQuestion&) const = default;
};

struct RayQuestion {
  glm::vec3 from_m{0.0F};
  glm::vec3 unit{0.0F};
  float most_m = 0.0F;

  bool operator==(const RayQuestion&) const = default;
};

struct SphereQuestion {
  glm::vec3 from_m{0.0F};
  glm::vec3 unit{0.0F};
  float most_m = 0.0F;
  float radius_m = 0.0F;

  bool operator==(const SphereQuestion&) const = default;
};

struct CapsuleQuestion {
  glm::vec3 a_m{0.0F};
  glm::vec3 b_m{0.0F};
  glm::vec3 unit{0.0F};
  float most_m = 0.0F;
  float radius_m = 0.0F;

  bool operator==(const CapsuleQuestion&) const = default;
};

/// overlap_sphere()
struct InSphereQuestion {
  glm::vec3 centre_m{0.0F};
  float radius_m = 0.0F;

  bool operator==(const InSphereQuestion&) const = default;
};

/// overlap_box()
struct InBoxQuestion {
  glm::vec3 lo_m{0.0F};
  glm::vec3 hi_m{0.0F};

  bool operator==(const InBoxQuestion&) const = default;
};

struct NearestQuestion {
  glm::vec3 place_m{0.0F};
  float most_m = 0.0F;

  bool operator==(const NearestQuestion&) const = default;
};

struct SolidQuestion {
  glm::vec3 place_m{0.0F};

  bool operator==(const SolidQuestion&) const = default;
};

/// box_content(): of the terrain alone, whatever the mask says.
struct ContentQuestion {
  glm::vec3 lo_m{0.0F};
  glm::vec3 hi_m{0.0F};

  bool operator==(const ContentQuestion&) const = default;
};

/// solids_in()
struct BodiesQuestion {
  glm::vec3 lo_m{0.0F};
  glm::vec3 hi_m{0.0F};

  bool operator==(const BodiesQuestion&) const = default;
};

using AskedFor = std::variant<UnknownQuestion, RayQuestion, SphereQuestion, CapsuleQuestion, InSphereQuestion,
                              InBoxQuestion, NearestQuestion, SolidQuestion, ContentQuestion, BodiesQuestion>;

struct Question {
  AskedFor asks;
  QueryMask mask{};

  bool operator==(const Question&) const = default;
};

/// Answers to casts and the nearest surface; to overlaps; whether a place is solid; of a box's content; of
/// the bodies in a box.
using QuestionAnswer = std::variant<std::optional<Hit>, Overlapping, bool, BoxContent, std::vector<PieceId>>;

/// Refuses what the function would refuse, and what is unknown.
Result<void> validate(const Question& question);

/// Asks. The cost is as the function says.
QueryResult<QuestionAnswer> ask(const QueryScene& scene, const Question& question);

/// How far from a place the question reaches at most. validate() has passed it.
double reach_from(const Question& question, const glm::dvec3& place_m);

/// A box around all that decides the answer. validate() has passed it.
SpaceBox bounds_of(const Question& question);

}  // namespace scree
