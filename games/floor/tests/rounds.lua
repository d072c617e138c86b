local function two(t)
  t:world{ terrain = "flat", persons = "walk" }
  return t:join("anna"), t:join("ben")
end

test("everybody begins on a tile", function(t)
  local anna, ben = two(t)
  expect(t:until_true(function() return t:sign(anna, "2 left") end, 15))
  t:seconds(0.5)
  for _, person in ipairs{ anna, ben } do
    local at = t:where(person)
    expect(math.abs(at.x) < 7 and math.abs(at.z) < 7)
    near(at.y, 0, 0.3)
  end
end)

test("tiles vanish, and the last one who stands wins", function(t)
  local anna, ben = two(t)
  local function won() return t:heard(anna, "wins") or t:heard(anna, "nobody is left") end
  expect(t:until_true(won, 120))
  expect(t:heard(ben, " fell"))
  expect(#t:cues() > 5)
end)

test("who leaves the floor is out", function(t)
  local anna = two(t)
  expect(t:until_true(function() return t:sign(anna, "2 left") end, 15))
  t:walk(anna, { to = vec(30, 0, t:where(anna).z), fast = true }, 6)
  expect(t:heard(anna, "anna fell") or t:heard(anna, "anna left the floor"))
  expect(t:heard(anna, "ben is the last on the floor, and wins"))
end)

test("nobody digs", function(t)
  local anna = two(t)
  equal(t:carve(anna, { at = vec(0, -0.5, 0), radius = 1 }).refusal, "here one only walks")
end)

test("after a restart rounds are counted on", function(t)
  local anna = two(t)
  expect(t:until_true(function() return t:sign(anna, "2 left") end, 15))
  t:restart()
  local ben = t:join("ben")
  expect(t:until_true(function() return t:sign(ben, "2 left") end, 20))
  equal(t:sign(ben, "1 round").text, "round 2")
end)
