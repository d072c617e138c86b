-- Plots: everybody builds on land of his own. `/claim` takes the plot on which one stands, or the next free
-- one; `/invite NAME` lets somebody build there, too; `/leave` gives it up. Nobody else changes anything.
--
-- Anybody may say any name: on a server that strangers reach, let access tokens state names (docs/host.md).
local size = 16 -- metres, of a plot's side
local high, deep = 30, 8

local plots = {} -- by key "plot X Z": { x, z, owner, friends }, kept by the same key

local function key_of(x, z) return "plot " .. x .. " " .. z end
local function cell_at(at) return math.floor(at.x / size + 0.5), math.floor(at.z / size + 0.5) end
local function middle_of(plot) return vec(plot.x * size, 0, plot.z * size) end

local function plot_of(name)
  for key, plot in pairs(plots) do
    if plot.owner == name then return plot, key end
  end
end

-- The plot's region lets those build whose team is its key, or that of a friend's plot, or the friend's own.
local function team_of(name)
  local _, key = plot_of(name)
  return key or ("guest " .. name):sub(1, 24)
end

local function set_region(plot, key)
  local teams = { key }
  for _, friend in ipairs(plot.friends) do teams[#teams + 1] = team_of(friend) end
  local middle = middle_of(plot)
  local half = vec(size / 2, (high + deep) / 2, size / 2)
  regions.set{ name = key, at = middle + vec(0, (high - deep) / 2, 0), half = half,
    forbid = { "edits", "dents" }, editors = "persons", teams = teams }
  show.marker(key, plot.owner .. "'s plot", middle + vec(0, 6, 0))
end

local function set_all_regions()
  for key, plot in pairs(plots) do set_region(plot, key) end
end

local function greet(person)
  local plot = plot_of(person:name())
  person:set_team(team_of(person:name()))
  show.line("plot", plot and "your plot is at " .. plot.x * size .. ", " .. plot.z * size or "say /claim to get a plot",
    { to = person })
end

-- Outwards from the middle, ring by ring.
local function next_free()
  for ring = 0, 8 do
    for x = -ring, ring do
      for z = -ring, ring do
        if math.max(math.abs(x), math.abs(z)) == ring and not plots[key_of(x, z)] then return x, z end
      end
    end
  end
end

local function claim(person)
  local name = person:name()
  if plot_of(name) then return "you have a plot: /leave it first" end
  local x, z
  local at = person:place()
  if at then x, z = cell_at(at) else x, z = next_free() end
  if not x then return "all plots are taken" end
  local key = key_of(x, z)
  if plots[key] then return "this is " .. plots[key].owner .. "'s plot" end
  plots[key] = { x = x, z = z, owner = name, friends = {} }
  store.set(key, plots[key])
  set_all_regions() -- friends' teams may have changed
  greet(person)
  return "the plot at " .. x * size .. ", " .. z * size .. " is yours"
end

local function invite(person, friend)
  local plot, key = plot_of(person:name())
  if not plot then return "you have no plot: /claim one" end
  plot.friends[#plot.friends + 1] = friend
  store.set(key, plot)
  set_region(plot, key)
  return friend .. " may build on your plot now"
end

local function leave(person)
  local _, key = plot_of(person:name())
  if not key then return "you have no plot" end
  plots[key] = nil
  store.set(key, nil)
  regions.remove(key)
  show.remove(key)
  set_all_regions()
  greet(person)
  return "your plot is free again"
end

local function obey(person, text)
  if text == "/claim" then return claim(person) end
  if text == "/leave" then return leave(person) end
  local friend = text:match("^/invite (.+)$")
  if friend then return invite(person, friend) end
  if text:sub(1, 1) == "/" then return "there are /claim, /invite NAME and /leave" end
end

on.say(function(e) return obey(e.by, e.text) end)
-- The same from a program's buttons: "claim", "leave", "invite NAME".
on.message(function(e)
  if e.channel == "plots" then e.by:say(obey(e.by, "/" .. e.bytes)) end
end)

local edits = { carve = true, fill = true, paint = true, dig = true, place = true, blast = true, cut_out = true }

on.request(function(r)
  local at = r.at or r.from
  if not edits[r.kind] or not at then return end
  local x, z = cell_at(at)
  local plot, name = plots[key_of(x, z)], r.by:name()
  if not plot then return "this land is nobody's: say /claim there" end
  if plot.owner == name then return end
  for _, friend in ipairs(plot.friends) do
    if friend == name then return end
  end
  return "this is " .. plot.owner .. "'s plot"
end)

on.join(function(e)
  greet(e.person)
  e.person:say("say /claim to get a plot, and build on it")
end)

on.start(function()
  for _, key in ipairs(store.keys("plot ")) do plots[key] = store.get(key) end
  for _, person in ipairs(persons.all()) do greet(person) end -- after a reload
end)
