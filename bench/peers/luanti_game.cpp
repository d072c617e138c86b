#include "bench/peers/luanti_game.h"

#include "bench/support/text_file.h"

namespace scree::peers {

namespace {

/// Orders come as lines of a file in the world's folder, answers go to another one. Positions of clients do
/// not change: without gravity they stay where they are put. They look down from so high that all carves are
/// in sight: the server sends a block that changed when it is in sight, and not before.
constexpr const char* script = R"LUA(
local orders = assert(io.open(minetest.get_worldpath() .. "/orders", "r"))
local answers = assert(io.open(minetest.get_worldpath() .. "/answers", "w"))

local function answer(...)
  answers:write(table.concat({...}, " "), "\n")
  answers:flush()
end

minetest.register_node("rock:stone", {description = "Stone", tiles = {"rock_stone.png"}})
minetest.register_alias("mapgen_stone", "rock:stone")
minetest.register_alias("mapgen_water_source", "air")
minetest.register_alias("mapgen_river_water_source", "air")

local ground = 8

minetest.register_on_joinplayer(function(player)
  player:set_physics_override({gravity = 0, speed = 0, jump = 0})
  player:set_pos({x = 0, y = ground + 75, z = 0})
  player:set_look_vertical(math.pi / 2)
  answer("joined", player:get_player_name())
end)

-- Takes a ball of nodes out at once: the way of explosions in Lua.
local function carve(centre, radius)
  local begin = minetest.get_us_time()
  local manip = minetest.get_voxel_manip()
  local low, high = manip:read_from_map(vector.subtract(centre, radius), vector.add(centre, radius))
  local area = VoxelArea:new({MinEdge = low, MaxEdge = high})
  local nodes = manip:get_data()
  local air = minetest.get_content_id("air")
  local taken = 0
  for x = -radius, radius do
    for y = -radius, radius do
      for z = -radius, radius do
        if x * x + y * y + z * z <= radius * radius then
          local at = area:index(centre.x + x, centre.y + y, centre.z + z)
          if nodes[at] ~= air then
            nodes[at] = air
            taken = taken + 1
          end
        end
      end
    end
  end
  manip:set_data(nodes)
  manip:write_to_map(true)
  answer("carved", minetest.get_us_time() - begin, taken)
end

local counting, last = false, nil

local function obey(line)
  local word, x, y, z, radius = line:match("^(%a+) ?(%-?%d*) ?(%-?%d*) ?(%-?%d*) ?(%d*)$")
  if word == "carve" then
    carve({x = tonumber(x), y = tonumber(y), z = tonumber(z)}, tonumber(radius))
  elseif word == "steps" then
    counting = true
  end
end

minetest.register_globalstep(function()
  local now = minetest.get_us_time()
  if counting and last then
    answer("step", now - last)
  end
  last = now
  orders:seek("cur", 0)
  for line in orders:lines() do
    obey(line)
  end
end)

-- The world around the place is there before anybody comes.
minetest.after(0, function()
  local reach = 96
  minetest.emerge_area({x = -reach, y = -48, z = -reach}, {x = reach, y = 48, z = reach}, function(_, _, remaining)
    if remaining == 0 then
      answer("ready")
    end
  end)
end)
)LUA";

}  // namespace

Result<void> write_luanti_game(const std::string& folder) {
  TRY(write_text_file(folder + "/game.conf", "title = Scree's peer\n"));
  TRY(write_text_file(folder + "/mods/rock/mod.conf", "name = rock\n"));
  return write_text_file(folder + "/mods/rock/init.lua", script);
}

}  // namespace scree::peers
