// Prefabs of scripts: lists of fills, which are put somewhere and turned by quarter turns.
#pragma once

#include <vector>

#include "server/rules/fields.h"
#include "shared/operation/request.h"

namespace scree {

/// Shapes in a prefab, and fills that it takes. Above: refused.
inline constexpr int64_t build_shapes_max = 256;
inline constexpr size_t build_fills_max = 256;

struct BuildOptions {
  glm::vec3 place_m{0.0F};
  int64_t quarter_turns = 0;  ///< about the upright axis, from x towards -z, as a turn of 90 degrees
  uint64_t party = 0;
};

extern const FieldTable build_fields;

Result<void> read_build_options(BuildOptions& to, const ScriptValue& table, const RulesMoment& moment);

/// The fills of a list, each within the reach of an edit.
Result<std::vector<FillRequest>> read_build(const ScriptValue& shapes, const BuildOptions& how,
                                            const RulesMoment& moment);

}  // namespace scree
