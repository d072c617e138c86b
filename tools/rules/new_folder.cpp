#include "tools/rules/new_folder.h"

#include <filesystem>

#include "server/rules/mod_name.h"
#include "tools/rules/types_text.h"
#include "tools/rules/written_file.h"

namespace scree {

namespace {

constexpr std::string_view init_text =
    R"LUA(-- A tiny game: who digs most? docs/rules-reference.md has all events and functions.

-- Cubic metres by name. What is kept by store.set outlives a restart of the server.
local dug = {}

local function show_score()
  local best, most = nil, 0
  for name, volume in pairs(dug) do
    if volume > most then best, most = name, volume end
  end
  if best then
    show.line("score", string.format("%s leads with %.1f m³", best, most))
  else
    show.line("score", "Who digs most?")
  end
end

on.start(function()
  dug = store.get("dug", {})
  show_score()
end)

on.join(function(e) e.person:say("Dig, " .. e.person:name() .. "!") end)

on.dig(function(e)
  if not e.by then return end
  local name = e.by:name()
  dug[name] = (dug[name] or 0) + e.volume
  store.set("dug", dug)
  show_score()
end)

-- Text that this returns refuses a request.
on.request(function(r)
  if r.kind == "blast" then return "this game is about digging" end
end)
)LUA";

constexpr std::string_view test_text =
    R"LUA(-- Run by `scree rules test FOLDER`: each test has a world of its own.

test("who digs leads", function(t)
  t:world{ terrain = "flat" }
  local anna = t:join("anna")
  expect(t:heard(anna, "Dig, anna!"))
  local reply = t:dig(anna, { at = vec(0, 0, 0), radius = 1 })
  expect(reply.done, reply.refusal)
  t:step(2)
  expect(t:sign(anna, "score").text:find("anna leads", 1, true))
end)

test("the score outlives a restart", function(t)
  t:dig(t:join("anna"), { at = vec(0, 0, 0), radius = 1 })
  t:step(2)
  t:restart()
  expect(t:sign(t:join("ben"), "score").text:find("anna leads", 1, true))
end)

test("nobody blasts", function(t)
  local reply = t:blast(t:join("anna", { role = "director" }), { at = vec(0, 0, 0) })
  equal(reply.refusal, "this game is about digging")
end)
)LUA";

}  // namespace

Result<void> make_rules_folder(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path path = fs::path(folder).lexically_normal();
  const std::string name = (path.has_filename() ? path : path.parent_path()).filename().string();
  if (!is_mod_name(name))
    return fail("'" + name + "' is no name of rules: 1 to " + std::to_string(limits::mod_name_bytes_max) +
                " of A-Z, a-z, 0-9, _ and -");
  if (fs::exists(path, error)) return fail(folder + " is there already: choose another name");
  TRY(write_new_file(folder + "/init.lua", init_text, Existing::refused));
  TRY(write_new_file(folder + "/tests/first.lua", test_text, Existing::refused));
  return write_types(folder);
}

}  // namespace scree
