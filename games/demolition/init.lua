-- Demolition: two teams with three towers each. Who brings down tonnes of the other team's towers scores;
-- one's own count against. A round lasts three minutes, then all towers stand again.
local round_s, pause_s = 180, 20
local teams = { "red", "blue" }
local side = { red = -1, blue = 1 } -- of x, where the team's towers stand
local colours = { red = "#ff7766", blue = "#77aaff" }
local largest = 1.5 -- radius of a carve, metres

-- A tower in fills, about the middle of its foot: four legs, a slab, a shaft, a roof.
local tower = {
  { shape = "box", at = vec(0, 4.5, 0), half = vec(3, 0.5, 3), material = "concrete" },
  { shape = "box", at = vec(0, 7, 0), half = vec(2.5, 2, 2.5), material = "brick" },
  { shape = "box", at = vec(0, 9.5, 0), half = vec(3, 0.5, 3), material = "concrete" },
}
for _, leg in ipairs{ vec(2, 2, 2), vec(-2, 2, 2), vec(2, 2, -2), vec(-2, 2, -2) } do
  tower[#tower + 1] = { shape = "box", at = leg, half = vec(0.75, 2.25, 0.75), material = "brick" }
end

local game -- { number, playing, ends, red, blue }: kept, so that a restart goes on within the round

local function save() store.set("game", game) end

local function each_tower(act)
  for _, team in ipairs(teams) do
    for row = -1, 1 do act(vec(24 * side[team], 0, 16 * row)) end
  end
end

local function build()
  each_tower(function(foot)
    -- What is left of the last round goes, and the ground is level again.
    for _, height in ipairs{ 4, 11 } do
      world.dig{ shape = "box", at = foot + vec(0, height, 0), half = vec(7, 4, 7) }
    end
    world.fill{ shape = "box", at = foot + vec(0, -2, 0), half = vec(7, 2, 7), material = "soil" }
    world.build(tower, { at = foot })
  end)
end

local function show_scores()
  local most = math.max(100, game.red, game.blue)
  for place, team in ipairs(teams) do
    show.bar((place + 1) .. " " .. team, string.format("%s %.1f t", team, game[team]),
      math.max(0, game[team]) / most, { colour = colours[team] })
  end
end

local function show_round()
  local left = math.max(1, game.ends - world.time())
  local text = game.playing and "round " .. game.number or "the next round begins"
  show.line("1 round", text, { lasts = left, counts = true })
  show_scores()
end

local function begin_round()
  game = { number = game.number + 1, playing = true, ends = world.time() + round_s, red = 0, blue = 0 }
  build()
  save()
  show_round()
  say("round " .. game.number .. ": bring down their towers")
end

local function end_round()
  game.playing = false
  game.ends = world.time() + pause_s
  save()
  local winner = game.red > game.blue and "red" or "blue"
  if game.red == game.blue then
    say("nobody wins")
  else
    say(string.format("%s wins with %.1f t to %.1f t", winner, game[winner], game.red + game.blue - game[winner]))
  end
  show_round()
end

-- Counts what a person of a team brought down.
local function count(e)
  if not (game.playing and e.by and e.at and e.at.y > 0.5) then return end
  local team = e.by:team()
  if not side[team] then return end
  local owner = e.at.x < 0 and "red" or "blue"
  local tonnes = e.mass / 1000
  game[team] = game[team] + (owner == team and -tonnes or tonnes)
  save()
  show_scores()
end
on.carve(count)
on.fall(count)
on.broke(count)

local function smaller_team()
  local members = { red = 0, blue = 0 }
  for _, person in ipairs(persons.all()) do
    local team = person:team()
    if members[team] then members[team] = members[team] + 1 end
  end
  return members.red <= members.blue and "red" or "blue"
end

local function put_into(team, person)
  store.set("team of " .. person:name(), team)
  person:set_team(team)
  return "you are " .. team .. ": bring down the other team's towers"
end

on.join(function(e)
  local team = store.get("team of " .. e.person:name()) or smaller_team()
  e.person:say(put_into(team, e.person))
end)

-- /red and /blue change sides; a program sends the channel "team".
on.say(function(e)
  local team = e.text:match("^/(%a+)$")
  if side[team] then return put_into(team, e.by) end
end)
on.message(function(e)
  if e.channel == "team" and side[e.bytes] then e.by:say(put_into(e.bytes, e.by)) end
end)

on.request(function(r)
  if r.kind ~= "carve" then return "in this game one carves" end
  if not game.playing then return "wait for the next round" end
  if (r.radius or 9) > largest then return "a strike has a radius of " .. largest .. " m at most" end
end)

on.start(function()
  game = store.get("game")
  if not game then
    world.set{ support = true }
    game = { number = 0 }
    begin_round()
  end
  show_round()
end)

every(0.5, function()
  if world.time() < game.ends then return end
  if game.playing then end_round() else begin_round() end
end)
