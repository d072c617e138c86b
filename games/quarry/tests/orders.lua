local deposits = { clay = vec(-18, -2, -10), sand = vec(18, -2, -10), gravel = vec(0, -2, 22), ice = vec(0, -2, -24) }

local function begin(t)
  t:world{ terrain = "flat" }
  local anna = t:join("anna")
  expect(t:until_true(function() return t:kept("order").material end, 15))
  return anna, t:kept("order")
end

-- Digs so much of the ordered material, and more, and places it in the depot.
local function deliver(t, person, order, volume)
  local dug = 0
  for i = 0, 20 do
    if dug >= volume + 6 then break end
    local reply = t:dig(person, { at = deposits[order.material] + vec(i % 3, -(i // 9), i // 3 % 3), radius = 1.2 })
    expect(reply.done, reply.refusal)
    dug = dug + reply.volume
    t:seconds(0.2)
  end
  local placed = 0
  for i = 0, 15 do
    if placed >= volume then break end
    local at = vec(i % 3 * 2 - 2, 1.3 + i // 9 * 2, i // 3 % 3 * 2 - 2)
    local reply = t:place(person, { shape = "box", at = at, half = vec(0.9, 0.9, 0.9), material = order.material })
    expect(reply.done, reply.refusal)
    placed = placed + reply.volume
  end
  return placed
end

test("what is ordered, delivered in time, is paid", function(t)
  local anna, order = begin(t)
  deliver(t, anna, order, order.volume)
  expect(t:until_true(function() return t:heard(anna, "order 1 is delivered") end, 5))
  expect(t:heard(anna, "anna gets"))
  expect(t:kept("money").anna > 10)
  expect(t:sign(anna, "3 money").text:find("earned: anna", 1, true))
end)

test("two who deliver share the pay", function(t)
  local anna, order = begin(t)
  local ben = t:join("ben")
  deliver(t, anna, order, order.volume / 2)
  deliver(t, ben, order, order.volume)
  expect(t:until_true(function() return t:heard(anna, "order 1 is delivered") end, 5))
  local money = t:kept("money")
  expect(money.anna > 10 and money.ben > 10)
end)

test("a late order is lost, and another one comes", function(t)
  local anna, order = begin(t)
  t:seconds(order.ends - t:tick() / t:rate() + 1)
  expect(t:heard(anna, "order 1 is late"))
  expect(t:until_true(function() return t:kept("order").number == 2 end, 15))
  equal(t:kept("money"), {})
end)

test("the bar shows what is in the depot", function(t)
  local anna, order = begin(t)
  deliver(t, anna, order, 1)
  t:seconds(1)
  local bar = t:sign(anna, "2 delivered")
  expect(bar.share > 0.05 and bar.share < 1)
end)

test("one digs, and places in the depot alone", function(t)
  local anna = begin(t)
  equal(t:carve(anna, { at = vec(9, 0, 9), radius = 1 }).refusal, "here one digs and places")
  equal(t:dig(anna, { at = vec(0, 2, 0), radius = 1 }).refusal, "what is in the depot is sold")
  equal(t:place(anna, { at = vec(20, 1, 20), radius = 1, material = "clay" }).refusal, "place it in the depot")
end)

test("a restart goes on with the order", function(t)
  local anna, order = begin(t)
  deliver(t, anna, order, 1)
  t:seconds(1)
  t:restart()
  local again = t:join("anna")
  local after = t:kept("order")
  equal(after.material, order.material)
  equal(after.ends, order.ends)
  expect(after.placed.anna >= 1)
  deliver(t, again, order, order.volume)
  expect(t:until_true(function() return t:heard(again, "order 1 is delivered") end, 5))
end)

test("rock may be put down on the depot's floor", function(t)
  local anna, order = begin(t)
  expect(t:dig(anna, { at = deposits[order.material], radius = 1.5 }).done)
  t:seconds(0.5)
  local reply = t:place(anna, { at = vec(0, -0.05, 0), radius = 1.5, material = order.material })
  expect(reply.done, reply.refusal)
  t:seconds(1)
  expect(t:kept("order").placed.anna > 1)
  local dig = t:dig(anna, { at = vec(0, -0.3, 0), radius = 1 })
  equal(dig.refusal, "what is in the depot is sold")
end)
