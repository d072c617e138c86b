#include "server/rules/sandbox/script.h"

#include <cstring>

#include "server/rules/sandbox/display.h"
#include "server/rules/sandbox/script_state.h"
#include "shared/base/check.h"

namespace scree {
namespace {

/// An error outside every protected call: only the host's own use of Lua can raise one.
int panic(lua_State* lua) {
  const char* message = lua_tostring(lua, -1);
  check_failed(__FILE__, __LINE__, "no error of Lua reaches the host", message);
  return 0;
}

/// Calls what lies on the stack with `arguments` above it, and fills the fault of an error.
bool call_protected(ScriptState& state, int arguments) {
  lua_State* lua = state.lua;
  const int function = lua_gettop(lua) - arguments;
  lua_pushcfunction(lua, note_error);
  lua_insert(lua, function);
  const int status = lua_pcall(lua, arguments, LUA_MULTRET, function);
  lua_remove(lua, function);
  if (status == LUA_OK && state.dead == ScriptDeath::none) return true;
  if (state.dead != ScriptDeath::none && !state.death_told) {
    state.death_told = true;  // within the last instruction
    const bool memory = state.dead == ScriptDeath::out_of_memory;
    state.fault = {memory ? ScriptFault::Kind::out_of_memory : ScriptFault::Kind::too_long,
                   (memory ? "out of memory: " : "too long: ") + state.death_reason,
                   {}};
  } else if (state.dead == ScriptDeath::none && state.fault.message.empty()) {
    const char* message = lua_tostring(lua, -1);
    state.fault.message = message != nullptr ? message : "an error within an error";
  }
  return false;
}

struct Chunk {
  std::string_view text;
  const char* name;
};

/// Compiles the Chunk that is its argument, and leaves the function.
int compile(lua_State* lua) {
  const Chunk& chunk = *static_cast<const Chunk*>(lua_touserdata(lua, 1));
  if (load_in_pieces(lua, chunk.text, chunk.name) != LUA_OK) return lua_error(lua);
  return 1;
}

bool compile_protected(ScriptState& state, const Chunk& chunk) {
  lua_pushcfunction(state.lua, compile);
  lua_pushlightuserdata(state.lua, const_cast<Chunk*>(&chunk));
  return call_protected(state, 1);
}

/// Every call of a script: `work` runs it and says whether it came to its end.
template <typename Work>
Script::Ended whole_call(ScriptState& state, ScriptBudget& budget, const Work& work) {
  if (!begin_call(state, budget)) return tl::unexpected(state.fault);
  const bool ended = work();
  lua_settop(state.lua, 0);
  if (state.dead == ScriptDeath::out_of_memory) {
    collect_all(state);
    state.fault.message += "; what it no longer needs is freed";
  } else {
    collect_after_call(state);
  }
  end_call(state, budget);
  if (!ended) return tl::unexpected(state.fault);
  return {};
}

Script::Ended run_chunk(ScriptState& state, const Chunk& chunk, ScriptBudget& budget) {
  return whole_call(state, budget,
                    [&] { return compile_protected(state, chunk) && call_protected(state, 0); });
}

Result<void> check_options(ScriptOptions& options, ScriptState& state) {
  if (options.memory_max_bytes < script_memory_min_bytes ||
      options.memory_max_bytes > script_memory_max_bytes)
    return fail("the memory of script " + options.name + " is " + std::to_string(options.memory_max_bytes) +
                " bytes; it must be " + std::to_string(script_memory_min_bytes) + " to " +
                std::to_string(script_memory_max_bytes));
  if (options.work_max <= 0) return fail("the work of a call of script " + options.name + " must be above 0");
  if (!(options.cpu_max_s > 0))
    return fail("the time of a call of script " + options.name + " must be above 0 s");
  if (options.folder.empty()) return {};
  std::error_code error;
  state.folder = std::filesystem::canonical(options.folder, error);
  if (error || !std::filesystem::is_directory(state.folder, error))
    return fail("script " + options.name + " has no folder " + options.folder.string());
  return {};
}

}  // namespace

Script::Script(std::unique_ptr<ScriptState> state) : state_(std::move(state)) {}
Script::Script(Script&&) noexcept = default;

Script& Script::operator=(Script&& other) noexcept {
  std::swap(state_, other.state_);
  return *this;
}

Script::~Script() {
  if (state_ != nullptr) lua_close(state_->lua);
}

Result<Script> Script::create(ScriptOptions options) {
  auto state = std::make_unique<ScriptState>();
  TRY(check_options(options, *state));
  state->options = std::move(options);
  state->lua = lua_newstate(allocate_for_script, state.get());
  CHECK(state->lua != nullptr, "Lua has no memory for a machine");
  ScriptState* address = state.get();
  std::memcpy(lua_getextraspace(state->lua), &address, sizeof address);
  lua_atpanic(state->lua, panic);
  lua_pushcfunction(state->lua, open_sandbox);
  CHECK_EQ(lua_pcall(state->lua, 0, 0, 0), LUA_OK, "the library of scripts opens");
  seed_random(*state, state->options.random_seed);
  collect_all(*state);
  state->memory_limit = state->options.memory_max_bytes;
  collect_all(*state);
  return Script(std::move(state));
}

Script::Ended Script::load(std::string_view path, ScriptBudget& budget) {
  ScriptState& state = *state_;
  if (!read_script_file(state, path))
    return tl::unexpected(ScriptFault{ScriptFault::Kind::error, state.text, {}});
  const std::string text = std::move(state.text);
  const std::string chunk = "@" + std::string(path);
  return run_chunk(state, {text, chunk.c_str()}, budget);
}

Script::Ended Script::load_text(std::string_view chunk, std::string_view text, ScriptBudget& budget) {
  const std::string name = "@" + std::string(chunk);
  return run_chunk(*state_, {text, name.c_str()}, budget);
}

ScriptFunction Script::global_function(std::string_view name) {
  lua_State* lua = state_->lua;
  lua_pushglobaltable(lua);
  lua_pushlstring(lua, name.data(), name.size());
  lua_rawget(lua, -2);
  ScriptFunction function;
  if (lua_isfunction(lua, -1)) function = *ScriptValue(lua, -1, std::string(name)).function();
  lua_pop(lua, 2);
  return function;
}

Script::Ended Script::call(const ScriptFunction& function, const WriteArguments& arguments,
                           ScriptBudget& budget, const ReadResults& results) {
  CHECK(function, "an empty ScriptFunction is not called");
  ScriptState& state = *state_;
  return whole_call(state, budget, [&] {
    lua_State* lua = state.lua;
    lua_settop(state.scratch, 0);
    ScriptWriter writer(state.scratch);
    writer.function(function);
    if (arguments) arguments(writer);
    if (!call_protected(state, take_written(state, lua, writer) - 1)) return false;
    if (!results) return true;
    std::vector<ScriptValue> values;
    for (int i = 1; i <= lua_gettop(lua); ++i) values.emplace_back(lua, i, "result " + std::to_string(i));
    const Result<void> read = results(values);
    if (!read) state.fault.message = read.error().message;
    return read.has_value();
  });
}

tl::expected<std::string, ScriptFault> Script::run(std::string_view line, ScriptBudget& budget) {
  ScriptState& state = *state_;
  std::string shown;
  const std::string expression = "return " + std::string(line);
  const Ended ended = whole_call(state, budget, [&] {
    if (!compile_protected(state, {expression, "@console"})) {
      lua_settop(state.lua, 0);
      if (state.dead != ScriptDeath::none) return false;
      state.fault = {};
      if (!compile_protected(state, {line, "@console"})) return false;
    }
    if (!call_protected(state, 0)) return false;
    shown = display_values(state.lua);
    return true;
  });
  if (!ended) return tl::unexpected(ended.error());
  return shown;
}

void Script::seed(uint64_t random_seed) {
  seed_random(*state_, random_seed);
}

Script::Used Script::used() const {
  return {state_->work_used, state_->cpu_used_s, state_->memory, state_->memory_most};
}

const std::string& Script::name() const {
  return state_->options.name;
}

}  // namespace scree
