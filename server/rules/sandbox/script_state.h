// The inside of a Script: Lua's machine, its memory and its budget. Lua is compiled as C: it reports errors
// by longjmp. A function that may raise one (its comment says so, and it gets a lua_State first) is called
// only where no object with a destructor lives. All others are noexcept and raise none.
#pragma once

#include <array>
#include <deque>
#include <lua.hpp>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "server/rules/sandbox/script.h"
#include "server/rules/sandbox/script_limits.h"

namespace scree {

/// Registry slots of functions whose last ScriptFunction is gone.
struct ReleasedSlots {
  std::mutex mutex;
  std::vector<int> slots;
};

enum class ScriptDeath : uint8_t { none, too_long, out_of_memory };

struct ScriptState {
  ScriptOptions options;
  std::filesystem::path folder;  // canonical
  lua_State* lua = nullptr;      // the main coroutine
  lua_State* current = nullptr;  // the running one
  lua_State* scratch = nullptr;  // whose stack holds what a ScriptWriter has written
  std::deque<BoundFunction> functions;
  std::shared_ptr<ReleasedSlots> released = std::make_shared<ReleasedSlots>();

  // Memory (memory.cpp).
  size_t memory_limit = SIZE_MAX;  // while the library is opened: none
  size_t memory = 0;
  size_t memory_most = 0;
  std::unordered_set<const void*> long_texts;
  std::array<uint32_t, 24> long_texts_by_size{};  // index: bits of the size
  size_t granted = 0;                             // since the last look
  bool long_text_is_new = false;                  // since the cycle of collection began
  int looks_since_step = 0;
  int looks_since_cycle = 0;
  size_t collect_at = 0;  // memory at which a cycle of collection begins
  size_t granted_since_step = 0;
  size_t granted_per_step = 0;  // more where there are many metatables
  size_t granted_since_full = SIZE_MAX / 2;
  bool collecting = false;

  // The running call (meter.cpp).
  bool running = false;
  ScriptDeath dead = ScriptDeath::none;
  bool death_told = false;  // fault describes it
  std::string death_reason;
  int64_t work_given = 0;
  int64_t work_left = 0;
  double cpu_begin_s = 0;
  double cpu_limit_s = 0;  // of the thread's clock
  double cpu_known_s = 0;  // when the steady clock showed wall_known_s
  double wall_known_s = 0;
  ScriptFault fault;

  // All calls.
  int64_t work_used = 0;
  double cpu_used_s = 0;

  // Library.
  std::array<uint64_t, 4> random{};
  std::string text;  // what a noexcept helper hands to its caller that may raise
};

/// Any coroutine of the script will do.
ScriptState& state_of(lua_State* lua) noexcept;

// meter.cpp
/// Whether the call is over: then raise_death() is next.
bool look(ScriptState& state) noexcept;
void die(ScriptState& state, ScriptDeath death, std::string_view reason) noexcept;
/// Lets the running coroutine call the hook before its next instruction.
void hook_soon(ScriptState& state) noexcept;
/// Sets the coroutine's interval to what the state of things asks for.
void set_interval(lua_State* lua, ScriptState& state) noexcept;
/// Raises.
[[noreturn]] void raise_death(lua_State* lua);
/// Takes off work, and looks. Raises where the call is over.
void charge(lua_State* lua, int64_t work);
/// The same for bytes that a function touches.
void charge_bytes(lua_State* lua, size_t bytes);
/// Raises where the call is over.
void raise_if_dead(lua_State* lua);
/// Takes the message on top of the stack, puts the place before it and raises.
[[noreturn]] void raise_here(lua_State* lua);
/// Begins a call; false where the budget has nothing left, with the fault said.
bool begin_call(ScriptState& state, const ScriptBudget& budget) noexcept;
void end_call(ScriptState& state, ScriptBudget& budget) noexcept;

// memory.cpp
void* allocate_for_script(void* state, void* block, size_t old_bytes, size_t bytes) noexcept;
/// Memory outside Lua that the script holds.
void hold_outside(ScriptState& state, size_t bytes) noexcept;
void free_outside(ScriptState& state, size_t bytes) noexcept;
/// Takes steps of collection as memory was granted. Raises where a metatable has weak keys.
void collect(lua_State* lua);
/// The same between calls, which may be too short for a hook. Raises nothing.
void collect_after_call(ScriptState& state) noexcept;
/// All that can be freed. Raises nothing.
void collect_all(ScriptState& state) noexcept;
/// Stops Lua's own collection. Raises; called once.
int prepare_collection(lua_State* lua);
/// Notes a metatable, whose weak mode collect() looks at. Raises.
void note_metatable(lua_State* lua, int index);

// traceback.cpp
/// Lua's message handler: fills the fault, where the death has not done so.
int note_error(lua_State* lua);
/// From a level of the stack on: in a message handler, 0 is the handler.
void fill_traceback(lua_State* lua, int level, std::vector<std::string>& lines) noexcept;
/// The place of a level of the stack, "file:line: "; empty where there is none.
std::string place_at(lua_State* lua, int level) noexcept;

// library.cpp and the files beside it: each may raise, and is called once.
int open_sandbox(lua_State* lua);
void open_base(lua_State* lua);
void open_coroutines(lua_State* lua);
void open_strings(lua_State* lua);
void open_patterns(lua_State* lua);
void open_tables(lua_State* lua);
void open_math(lua_State* lua);
void open_require(lua_State* lua);
/// The hidden table behind a read-only global one, on the stack; made where it is missing. Raises.
void push_library(lua_State* lua, const char* name);
/// As Lua's luaL_tolstring, but no addresses. Raises.
const char* push_text_of(lua_State* lua, int index, size_t* bytes);
/// Lua's load in pieces; leaves a function or a message, and returns Lua's status. Raises where the call is
/// over.
int load_in_pieces(lua_State* lua, std::string_view text, const char* chunk);
void seed_random(ScriptState& state, uint64_t seed) noexcept;

// files.cpp
/// Reads a file of the folder into state.text; else the reason is there.
bool read_script_file(ScriptState& state, std::string_view name) noexcept;

// bound.cpp
/// The function that Lua calls for a BoundFunction, its upvalue.
int call_bound(lua_State* lua);
/// Moves what was written to the stack of `lua`, and returns how many values that is.
int take_written(ScriptState& state, lua_State* lua, const ScriptWriter& writer) noexcept;

/// Keys in the registry, by their addresses.
extern const char registry_libraries, registry_metatables, registry_types, registry_patterns,
    registry_modules, registry_handles, registry_scratch, registry_vectors;

}  // namespace scree
