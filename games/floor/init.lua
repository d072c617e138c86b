-- Floor: the ground is taken from under you. Tiles stand on pillars in a pit, and vanish faster and faster;
-- who stands longest wins. The world's persons walk.
local across, size = 5, 3 -- tiles in a row, metres from tile to tile
local deep = 7            -- metres from the tiles to the bottom
local warning_s, pause_s = 1.5, 8
local half = across * size / 2
local lookout = vec(0, 0.5, half + 5) -- where those stand who are out

local tiles = {}   -- those that are left: { at, key }
local playing = {} -- by person: true while in
local game = { number = 0, phase = "pause", next = 3 }

local function save() store.set("number", game.number) end

local function tile_at(x, z) return vec((x - (across + 1) / 2) * size, -0.375, (z - (across + 1) / 2) * size) end

local function build()
  local middle = vec(0, 0.5 - deep / 2, 0)
  for quarter = 0, 3 do
    local off = vec((quarter % 2 - 0.5) * half, 0, (quarter // 2 - 0.5) * half)
    world.dig{ shape = "box", at = middle + off, half = vec(half / 2 + 0.5, deep / 2, half / 2 + 0.5) }
  end
  tiles = {}
  for x = 1, across do
    for z = 1, across do
      local at = tile_at(x, z)
      world.fill{ shape = "box", at = at, half = vec(1.375, 0.375, 1.375), material = "concrete" }
      local pillar = vec(at.x, -deep / 2, at.z)
      world.fill{ shape = "box", at = pillar, half = vec(0.5, deep / 2, 0.5), material = "concrete" }
      tiles[#tiles + 1] = at
    end
  end
end

local function still_in()
  local all = {}
  for _, person in ipairs(persons.all()) do
    if playing[person] then all[#all + 1] = person end
  end
  return all
end

local function show_state()
  if game.phase == "pause" then
    show.line("1 round", "the floor is built", { lasts = math.max(1, game.next - world.time()), counts = true })
    show.remove("2 left")
  else
    show.line("1 round", "round " .. game.number)
    show.bar("2 left", #tiles .. " tiles, still in: " .. #still_in(), #tiles / (across * across))
  end
end

local function pause(words)
  if words then say(words) end
  game.phase, game.next = "pause", world.time() + pause_s
  playing = {}
  build()
  show_state()
end

local function begin_round()
  local all = persons.all()
  if #all == 0 then
    game.next = world.time() + 1
    return
  end
  game.number = game.number + 1
  game.phase, game.wait, game.next = "play", 3, world.time() + 3
  game.began = #all
  playing = {}
  for i, person in ipairs(all) do
    local tile = tiles[(i * 7) % #tiles + 1]
    person:stand(vec(tile.x, 0.3, tile.z))
    playing[person] = true
  end
  save()
  say("round " .. game.number .. ": stay on the floor")
  show_state()
end

local function take_tile()
  local at = table.remove(tiles, math.random(#tiles))
  world.paint{ shape = "box", at = at, half = vec(1.5, 0.5, 1.5), material = "timber" }
  show.cue("rattle", at, { size = 2 })
  after(warning_s, function()
    if game.phase ~= "play" then return end
    -- With the top of its pillar, on which one could stand.
    world.carve{ shape = "box", at = at - vec(0, 0.7, 0), half = vec(1.45, 1.2, 1.45), pieces = 9, speed = 1 }
    show.cue("crack", at, { size = 2, energy = 1e5 })
  end)
  game.wait = math.max(0.4, game.wait * 0.93)
  game.next = world.time() + game.wait
  show_state()
end

local function out(person, why)
  playing[person] = nil
  say(person:name() .. " " .. why)
  show_state()
end

local function end_if_decided()
  local left = still_in()
  if #left > 1 or (#left == 1 and game.began == 1) then return end
  pause(left[1] and left[1]:name() .. " is the last on the floor, and wins" or "nobody is left")
end

every(0.1, function()
  if game.phase == "pause" then
    if world.time() >= game.next then begin_round() end
    return
  end
  for _, person in ipairs(persons.all()) do
    local at = person:place()
    local off = at and math.max(math.abs(at.x), math.abs(at.z)) > half + 1
    if playing[person] and at and (at.y < -1.5 or off) then
      person:stand(lookout)
      out(person, off and "left the floor" or "fell")
    end
  end
  end_if_decided()
  if game.phase == "play" and #tiles > 0 and world.time() >= game.next then take_tile() end
end)

on.join(function(e)
  e.person:stand(lookout)
  e.person:say(game.phase == "pause" and "the round begins soon" or "wait for the next round")
end)
on.leave(function(e) if playing[e.person] then out(e.person, "left") end end)
on.request(function(r) if r.kind ~= "stand" or r.away then return "here one only walks" end end)

on.start(function(e)
  game.number = store.get("number", 0)
  world.set{ persons = "walk" }
  pause(e.restarted and "the server is back, and the floor is built anew" or nil)
end)
