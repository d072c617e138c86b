#include "server/rules/prelude.h"

namespace scree {

namespace {

// Scripts never get the metatable: __metatable hides it, so that nobody gives vectors a __gc.
constexpr std::string_view prelude_text = R"LUA(
---@class vec
---@field x number
---@field y number
---@field z number
local methods = {}
local meta = { __index = methods, __metatable = "vec", __name = "vec" }

local function parts(value)
  if type(value) ~= "table" then error("a vec is needed, not " .. type(value), 3) end
  local x, y, z = value.x or value[1], value.y or value[2], value.z or value[3]
  if type(x) ~= "number" or type(y) ~= "number" or type(z) ~= "number" then
    error("a vec has three numbers: x, y and z", 3)
  end
  return x, y, z
end

local function made(x, y, z) return setmetatable({ x = x, y = y, z = z }, meta) end

--- vec(1, 2, 3), or of a table with x, y and z or with three numbers.
function vec(x, y, z)
  if type(x) == "table" then return made(parts(x)) end
  if type(x) ~= "number" or type(y) ~= "number" or type(z) ~= "number" then
    error("vec needs three numbers, or a table of three", 2)
  end
  return made(x, y, z)
end

function meta.__add(a, b)
  local ax, ay, az = parts(a)
  local bx, by, bz = parts(b)
  return made(ax + bx, ay + by, az + bz)
end

function meta.__sub(a, b)
  local ax, ay, az = parts(a)
  local bx, by, bz = parts(b)
  return made(ax - bx, ay - by, az - bz)
end

--- By a number, or part by part by another vec.
function meta.__mul(a, b)
  if type(a) == "number" then a, b = b, a end
  local x, y, z = parts(a)
  if type(b) == "number" then return made(x * b, y * b, z * b) end
  local bx, by, bz = parts(b)
  return made(x * bx, y * by, z * bz)
end

function meta.__div(a, b)
  local x, y, z = parts(a)
  if type(b) ~= "number" then error("a vec is divided by a number", 2) end
  return made(x / b, y / b, z / b)
end

function meta.__unm(a)
  local x, y, z = parts(a)
  return made(-x, -y, -z)
end

function meta.__eq(a, b) return a.x == b.x and a.y == b.y and a.z == b.z end

function meta.__tostring(a)
  local x, y, z = parts(a)
  return string.format("(%.6g, %.6g, %.6g)", x, y, z)
end

--- Its length, metres.
function methods.length(a)
  local x, y, z = parts(a)
  return math.sqrt(x * x + y * y + z * z)
end

--- The same direction with length 1; of a vec without length vec(0, 0, 0).
function methods.unit(a)
  local x, y, z = parts(a)
  local length = math.sqrt(x * x + y * y + z * z)
  if length == 0 then return made(0, 0, 0) end
  return made(x / length, y / length, z / length)
end

function methods.dot(a, b)
  local ax, ay, az = parts(a)
  local bx, by, bz = parts(b)
  return ax * bx + ay * by + az * bz
end

function methods.cross(a, b)
  local ax, ay, az = parts(a)
  local bx, by, bz = parts(b)
  return made(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx)
end

--- How far two places lie apart, metres.
function methods.distance(a, b)
  local ax, ay, az = parts(a)
  local bx, by, bz = parts(b)
  local x, y, z = bx - ax, by - ay, bz - az
  return math.sqrt(x * x + y * y + z * z)
end

vector_metatable = meta
)LUA";

}  // namespace

std::string_view rules_prelude() {
  return prelude_text;
}

Script::Ended load_prelude(Script& script, ScriptBudget& budget) {
  const Script::Ended loaded = script.load_text("prelude", rules_prelude(), budget);
  if (loaded) script.take_vectors("vector_metatable");
  return loaded;
}

}  // namespace scree
