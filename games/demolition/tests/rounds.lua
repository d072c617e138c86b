-- The foot of a tower's four legs.
local function strike_legs(t, person, foot)
  for _, leg in ipairs{ vec(2, 2, 2), vec(-2, 2, 2), vec(2, 2, -2), vec(-2, 2, -2) } do
    local reply = t:carve(person, { at = foot + leg, radius = 1.4, pieces = 8 })
    expect(reply.done, reply.refusal)
  end
end

local function score(t, person, team)
  for _, sign in ipairs(t:signs(person)) do
    local tonnes = sign.text:match("^" .. team .. " (-?[%d.]+) t$")
    if tonnes then return tonumber(tonnes) end
  end
  error("there is no score of " .. team, 2)
end

local function two(t)
  t:world{ terrain = "flat" }
  t:seconds(2) -- the towers are built
  return t:join("anna"), t:join("ben")
end

test("teams are balanced", function(t)
  local anna, ben = two(t)
  equal(t:team(anna), "red")
  equal(t:team(ben), "blue")
end)

test("one may change sides", function(t)
  local anna, ben = two(t)
  t:say(anna, "/blue")
  equal(t:team(anna), "blue")
  t:send(ben, "team", "red")
  equal(t:team(ben), "red")
  t:say(ben, "/green")
  equal(t:team(ben), "red")
end)

test("towers stand by themselves", function(t)
  local anna = two(t)
  t:seconds(5)
  equal(score(t, anna, "red"), 0)
  equal(t:run("#bodies.all()"), "0")
  near(tonumber(t:run("world.ground(24, 16)")), 10, 0.3)
end)

test("who brings down the other team's tower scores its tonnes", function(t)
  local anna = two(t)
  strike_legs(t, anna, vec(24, 0, 0))
  t:seconds(3)
  expect(score(t, anna, "red") > 200, "a tower has more than 200 t, not " .. score(t, anna, "red"))
  equal(score(t, anna, "blue"), 0)
end)

test("one's own tower counts against", function(t)
  local _, ben = two(t)
  strike_legs(t, ben, vec(24, 0, 16))
  t:seconds(3)
  expect(score(t, ben, "blue") < -200)
end)

test("only carves of a fair size are allowed", function(t)
  local anna = two(t)
  equal(t:carve(anna, { at = vec(24, 2, 0), radius = 3 }).refusal, "a strike has a radius of 1.5 m at most")
  equal(t:fill(anna, { at = vec(24, 2, 0), radius = 1 }).refusal, "in this game one carves")
end)

test("a round ends, names the winner, and the towers stand again", function(t)
  local anna = two(t)
  strike_legs(t, anna, vec(24, 0, 0))
  t:seconds(180)
  expect(t:heard(anna, "red wins with"))
  equal(t:carve(anna, { at = vec(24, 2, 0), radius = 1 }).refusal, "wait for the next round")
  t:seconds(22)
  expect(t:sign(anna, "1 round").text:find("round 2", 1, true))
  near(tonumber(t:run("world.ground(24, 0)")), 10, 0.3)
  equal(score(t, anna, "red"), 0)
end)

test("a restart goes on within the round", function(t)
  local anna = two(t)
  strike_legs(t, anna, vec(24, 0, 0))
  t:seconds(20)
  local before, left = score(t, anna, "red"), t:sign(anna, "1 round").left
  t:restart()
  local ben = t:join("ben") -- who is blue by his name, though red has nobody
  equal(t:team(ben), "blue")
  near(score(t, ben, "red"), before, 0.2)
  near(t:sign(ben, "1 round").left, left, 1)
  t:seconds(170)
  expect(t:heard(ben, "red wins with"))
end)
