// The rows of functions, events and types (server/rules/api.h) taken apart: by what annotations for editors
// and the reference are made.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/rules/api.h"

namespace scree {

struct WordedField {
  std::string name;
  bool optional = false;
  std::string type;
  std::string what;  ///< may be empty
};

/// Those of "at: vec, mask?: mask, reply?: fun(reply: reply)". What stands in brackets is not taken apart.
std::vector<WordedField> arguments_of(std::string_view text);
/// Those of lines "at: vec -- its centre".
std::vector<WordedField> fields_of_type(std::string_view text);
/// The parts of "table<string, number>, number".
std::vector<std::string> types_of(std::string_view text);

/// "world.ray", "person:name", "log".
std::string whole_name(const ApiFunction& row);
/// "mask?" of a field that may be left out.
std::string name_of(const WordedField& field);
/// The text with each line but the first begun by `indent`.
std::string indented(std::string_view text, std::string_view indent);

}  // namespace scree
