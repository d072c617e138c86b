-- Quarry: customers order materials by volume. Dig them in the deposits, and place them in the depot before
-- the time is over; who placed most of it is paid most.
local depot = { at = vec(0, 2, 0), half = vec(4, 2, 4) }
local deposits = { clay = vec(-18, -2, -10), sand = vec(18, -2, -10), gravel = vec(0, -2, 22), ice = vec(0, -2, -24) }
local materials = { "clay", "gravel", "ice", "sand" }
local pay_per_m3 = { clay = 10, gravel = 8, ice = 15, sand = 6 }
local pause_s = 10

-- Kept, so that a restart goes on with the order: { number, material, volume, ends, placed }; ends alone
-- between two orders. `placed` is m³ by name, `money` all that was earned.
local order, money

local function save()
  store.set("order", order)
  store.set("money", money)
end

local function delivered()
  local lo, hi = depot.at - depot.half, depot.at + depot.half
  local by_material = world.mass_in(lo + vec(0, 0.25, 0), hi)
  return by_material[order.material] or 0
end

local function show_money()
  local names = {}
  for name in pairs(money) do names[#names + 1] = name end
  table.sort(names, function(a, b) return money[a] > money[b] end)
  local parts = {}
  for i = 1, math.min(3, #names) do parts[i] = string.format("%s %.0f", names[i], money[names[i]]) end
  show.line("3 money", #parts > 0 and "earned: " .. table.concat(parts, ", ") or "nobody has earned anything")
end

local function show_order()
  local left = math.max(1, order.ends - world.time())
  if not order.material then
    show.line("1 order", "the next order comes", { lasts = left, counts = true })
    show.remove("2 delivered")
    return
  end
  local volume = delivered()
  show.line("1 order", string.format("order %d: %.0f m³ of %s", order.number, order.volume, order.material),
    { lasts = left, counts = true })
  show.bar("2 delivered", string.format("%.1f of %.0f m³ in the depot", volume, order.volume),
    volume / order.volume, { colour = "#ffcc44" })
end

local function empty_depot()
  world.dig{ shape = "box", at = depot.at, half = depot.half }
end

local function next_order()
  empty_depot() -- of what came too late
  local number = (order and order.number or 0) + 1
  local material = materials[math.random(#materials)]
  local volume = math.random(3, 8) + number
  order = { number = number, material = material, volume = volume, placed = {},
    ends = world.time() + 60 + 10 * volume }
  save()
  show.marker("deposit", material, deposits[material] + vec(0, 4, 0), { colour = "#ffcc44" })
  say(string.format("%.0f m³ of %s are wanted, for %d a m³", volume, material, pay_per_m3[material]))
  show_order()
end

local function rest()
  order = { number = order.number, ends = world.time() + pause_s }
  empty_depot()
  show.remove("deposit")
  save()
  show_order()
  show_money()
end

-- Shares the pay by what each one placed of the material.
local function pay()
  local all = 0
  for _, volume in pairs(order.placed) do all = all + volume end
  local sum = order.volume * pay_per_m3[order.material]
  for name, volume in pairs(order.placed) do
    money[name] = (money[name] or 0) + sum * volume / all
    say(string.format("%s gets %.0f", name, sum * volume / all))
  end
end

-- Or near it: what is placed on the floor has its middle there.
local function in_depot(at)
  local off, near = at - depot.at, 1
  return math.abs(off.x) <= depot.half.x and math.abs(off.z) <= depot.half.z and math.abs(off.y) <= depot.half.y + near
end

-- Edits are for digging in deposits and placing in the depot; what is placed is remembered until it is there.
local wanted = {} -- by name: the material of the person's last place
on.request(function(r)
  if r.kind == "place" then
    if not in_depot(r.at or r.from) then return "place it in the depot" end
    wanted[r.by:name()] = r.material
  elseif r.kind == "dig" then
    if r.at and in_depot(r.at) then return "what is in the depot is sold" end
  elseif r.kind ~= "transfer" and r.kind ~= "stand" then
    return "here one digs and places"
  end
end)

on.place(function(e)
  if not (e.by and order.placed) then return end
  local name = e.by:name()
  if wanted[name] ~= order.material then return end
  order.placed[name] = (order.placed[name] or 0) + e.volume
  save()
  show_order()
end)

on.start(function()
  order, money = store.get("order"), store.get("money", {})
  if not order then
    for material, at in pairs(deposits) do world.paint{ at = at, radius = 6, material = material } end
    world.fill{ shape = "box", at = vec(0, -0.5, 0), half = vec(5, 0.5, 5), material = "concrete" }
    regions.set{ name = "depot floor", at = vec(0, -2, 0), half = vec(5, 2, 5), forbid = { "dents" } }
    show.marker("depot", "the depot", depot.at + vec(0, 3, 0))
    order = { number = 0, ends = world.time() + pause_s }
    save()
  end
  show_order()
  show_money()
end)

on.join(function(e) e.person:say("dig what is ordered, and place it in the depot") end)

every(0.5, function()
  if order.material and delivered() >= order.volume - 0.05 then
    say("order " .. order.number .. " is delivered")
    pay()
    rest()
  elseif world.time() >= order.ends then
    if not order.material then return next_order() end
    say("order " .. order.number .. " is late: the customer went elsewhere")
    rest()
  else
    show_order()
  end
end)
