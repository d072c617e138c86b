// Values of scripts as JSON text, and back: what a game keeps from day to day. What is read is what was
// written: integers and floats differ (1, 1.0), infinities and NaN stay ({"$float": "inf"}), text that is no
// UTF-8 stays ({"$bytes": "ff00"}), and so do keys that are numbers or booleans ({"$pairs": [[1, "a"]]}). A
// table whose keys are 1 to n is an array, one with text as keys an object, in the order of their bytes:
// equal values give equal text. An empty table is []. Refused with the place, `kept.items[3]`: functions,
// coroutines and handles, a table in itself, nesting over script_json_depth_max, text over the limit.
// Metatables are neither written nor asked.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "server/rules/sandbox/script_value.h"
#include "shared/base/result.h"

namespace scree {

Result<std::string> to_json_text(const ScriptValue& value, size_t bytes_max);
/// Writes one value, or nothing and refuses.
Result<void> write_json(ScriptWriter& to, std::string_view text);

}  // namespace scree
