// The functions that scripts find, as rows of tables: name, arguments, words and an example beside the code.
// The reference (docs/rules-reference.md), the annotations for editors and `scree rules check` are made of
// the same rows, so they cannot say anything else.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/rules/rules_moment.h"
#include "server/rules/sandbox/script.h"
#include "shared/base/result.h"

namespace scree {

class Mod;

/// A call of a function by a script's handler, or by its files while they load.
struct RulesCall {
  Mod& mod;
  RulesMoment& moment;
  ScriptCall& call;

  ScriptValue argument(int number, std::string_view name) const { return call.argument(number, name); }
  ScriptWriter& results() const { return call.results(); }
};

struct ApiFunction {
  /// "world" of world.ray(); "" of a global; "person:" of a method of handles.
  std::string_view table;
  std::string_view name;
  /// In the notation of LuaLS: "at: vec, radius: number, mask?: mask".
  std::string_view arguments;
  std::string_view returns;  ///< likewise: "hit?"; empty: nothing
  std::string_view what;     ///< one or two sentences
  /// Lines that run within on.start() of a flat world; a test runs each.
  std::string_view example;
  Result<void> (*run)(RulesCall& call) = nullptr;
  bool at_load = false;  ///< files may call it while they load; else a handler only
};

/// A happening that a script may have a handler for.
struct ApiEvent {
  std::string_view name;       ///< of on.NAME
  std::string_view arguments;  ///< what the handler gets, as fields of one table: "by: person?, at: vec"
  std::string_view returns;    ///< what it may return; empty: nothing
  std::string_view what;
  std::string_view example;  ///< the handler, whole
};

/// A table that functions take or give, by its fields.
struct ApiType {
  std::string_view name;
  std::string_view fields;  ///< a line each: "radius?: number -- metres"; empty: it is no table
  std::string_view what;
};

/// All rows, by part (server/rules/api/).
std::span<const ApiFunction> base_api();    ///< on, after, every, log, vec
std::span<const ApiFunction> world_api();   ///< time, settings, requests about terrain, questions about space
std::span<const ApiFunction> body_api();    ///< pieces, props, joints
std::span<const ApiFunction> region_api();  ///< regions, ledger, stores of rock
std::span<const ApiFunction> person_api();  ///< persons
std::span<const ApiFunction> show_api();    ///< signs, lines, cues, messages
std::span<const ApiFunction> store_api();   ///< values that are kept
inline constexpr size_t api_event_count = 22;
std::span<const ApiEvent> api_events();
std::span<const ApiType> api_types();

/// The reply to a request, as scripts get it.
void write_reply(ScriptWriter& to, const Reply& reply, const RulesMoment& moment);

/// All functions, in the order of the reference.
std::vector<ApiFunction> all_api();

}  // namespace scree
