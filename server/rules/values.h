// The values of a world on their way to and from scripts. A place is vec(x, y, z), or any table {x =, y =,
// z =} or {1, 2, 3}; a turn is {x =, y =, z =, w =} or {axis =, degrees =}; a material has its name, or its
// number. Metres. Readers refuse with the value's name: "argument 1 (carve).at is nil, not a vec".
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

#include "server/rules/rules_moment.h"
#include "server/rules/sandbox/script_value.h"
#include "shared/base/digest.h"
#include "shared/base/ids.h"
#include "shared/base/result.h"
#include "shared/field/mass.h"
#include "shared/material/material.h"
#include "shared/operation/store.h"

namespace scree {

/// Types of handles. Their numbers: a session, a PieceId of a piece or a prop, a JointId.
inline constexpr std::string_view person_type = "person", body_type = "body", joint_type = "joint";

/// A number that a float has.
Result<float> read_float(const ScriptValue& value);
Result<uint32_t> read_whole(const ScriptValue& value);

Result<glm::vec3> read_vec(const ScriptValue& value);
void write_vec(ScriptWriter& to, glm::vec3 value);
/// A direction of length 1 from a vec of any length but 0.
Result<glm::vec3> read_unit(const ScriptValue& value);

/// The turn has length 1. Where no axis is said, it is the upright one.
Result<glm::quat> read_turn(const ScriptValue& value);
void write_turn(ScriptWriter& to, const glm::quat& value);

/// A material of the world's palette; the error lists its names.
Result<Material> read_material(const ScriptValue& value, const RulesMoment& moment);
/// Its name.
void write_material(ScriptWriter& to, Material material, const RulesMoment& moment);

/// "world" or a person, or the name of a store; {token = "00…ab"} and {session = 7} of persons who are not
/// here; "own" in requests of persons alone.
Result<StoreName> read_store(const ScriptValue& value, const RulesMoment& moment);
void write_store(ScriptWriter& to, const StoreName& store, const RulesMoment& moment);

/// A handle, or its number.
Result<PieceId> read_body(const ScriptValue& value);
Result<PieceId> read_joint(const ScriptValue& value);
/// The session.
Result<uint64_t> read_person(const ScriptValue& value);
inline void write_body(ScriptWriter& to, PieceId id) {
  to.handle({body_type, id});
}
inline void write_joint(ScriptWriter& to, PieceId id) {
  to.handle({joint_type, id});
}
inline void write_person(ScriptWriter& to, uint64_t session) {
  to.handle({person_type, session});
}
/// The person whose party that is, or nil: nobody's, or of somebody who left.
void write_party(ScriptWriter& to, uint64_t party, const RulesMoment& moment);

/// 64 hexadecimal digits.
Result<Digest> read_digest(const ScriptValue& value);

/// Volume of solid rock of that mass in the world of the moment, and the mass of a volume.
double cubic_metres(MassUnits mass, const RulesMoment& moment);
Result<MassUnits> read_mass(const ScriptValue& value, const RulesMoment& moment);

}  // namespace scree
