-- As same_edits.c. usage: luajit same_edits.lua PORT LIST FIRST STEP GO
local ffi = require "ffi"
local scree = require "scree"
local C = scree.C
local at_rest, wait_ms = 4, 50

local client = scree.connect("127.0.0.1", tonumber(arg[1]))
local first, step = tonumber(arg[3]), tonumber(arg[4])
local replied, quiet, hash = false, 0, 0ULL

local function heard(event)
  if event.kind == C.SCREE_EVENT_LOST then error("lost: " .. ffi.string(event.text)) end
  if event.kind == C.SCREE_EVENT_REPLY then
    if event.text[0] ~= 0 then error("refused: " .. ffi.string(event.text)) end
    replied = true
  end
  if event.kind ~= C.SCREE_EVENT_STATUS then return end
  local status = scree.status(client)
  local same = status.pieces == 0 and status.server_hash == hash and status.field_hash == hash
  quiet, hash = same and quiet + 1 or 0, status.server_hash
end

local function read_edit(line)
  local words = {}
  for word in line:gmatch("%S+") do words[#words + 1] = word end
  local what, shape, numbers = words[1], words[2], {}
  for i = 3, #words do numbers[#numbers + 1] = tonumber(words[i]) end
  local kinds = { carve = C.SCREE_CARVE, fill = C.SCREE_FILL, paint = C.SCREE_PAINT }
  local request = scree.request(kinds[what])
  for i = 0, 2 do
    request.shape.a_m[i], request.place_m[i] = numbers[i + 1], numbers[i + 1]
    if shape == "box" then request.shape.b_m[i] = numbers[i + 4] end
  end
  if shape == "box" then request.shape.kind = C.SCREE_BOX else request.shape.radius_m = numbers[4] end
  if what == "carve" then request.seeds, request.random_seed = numbers[5], numbers[6] end
  if what == "paint" then
    local material = ffi.new("uint32_t[1]")
    assert(scree.check(C.scree_client_find_material(client, words[#words], material)) == C.SCREE_OK)
    request.material = material[0]
  end
  return request
end

local row = scree.new("scree_material")
repeat scree.poll(client, wait_ms, heard)
until scree.status(client).loaded == 1 and C.scree_client_material(client, 1, row) == C.SCREE_OK
local i = 0
for line in io.lines(arg[2]) do
  if line:sub(1, 1) ~= "#" then
    if i % step == first then
      replied = false
      scree.check(C.scree_client_request(client, read_edit(line), nil, nil, nil))
      repeat scree.poll(client, wait_ms, heard) until replied
    end
    i = i + 1
  end
end
print("done")
io.flush()
while not io.open(arg[5]) do scree.poll(client, wait_ms, heard) end
quiet = 0
repeat scree.poll(client, wait_ms, heard) until quiet >= at_rest
print((bit.tohex(bit.rshift(hash, 32), 8) .. bit.tohex(hash, 8)))
