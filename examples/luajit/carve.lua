-- Joins a server of Scree and carves a hole below its eye. usage: luajit carve.lua [HOST [PORT]]
local ffi = require "ffi"
local scree = require "scree"
local C = scree.C

local client = scree.connect(arg[1] or "127.0.0.1", tonumber(arg[2] or 4177))
local answered = false
local function heard(event)
  if event.kind == C.SCREE_EVENT_LOST then error("lost: " .. ffi.string(event.text)) end
  if event.kind ~= C.SCREE_EVENT_REPLY then return end
  answered = true
  local refused = ffi.string(event.text)
  print(refused == "" and tonumber(event.number) .. " pieces" or "refused: " .. refused)
end

repeat scree.poll(client, 100, heard) until scree.status(client).loaded == 1
local eye, hit = scree.status(client).eye_m, scree.new("scree_hit")
local from, down = ffi.new("float[3]", eye[0], eye[1] + 50, eye[2]), ffi.new("float[3]", 0, -1, 0)
if scree.check(C.scree_client_cast(client, from, down, 200, 0, C.SCREE_MASK_TERRAIN, hit)) ~= C.SCREE_OK then
  error("there is no ground")
end
local carve = scree.request(C.SCREE_CARVE)
carve.shape.radius_m = 2
ffi.copy(carve.shape.a_m, hit.place_m, 12)
ffi.copy(carve.place_m, hit.place_m, 12)
scree.check(C.scree_client_request(client, carve, nil, nil, nil))
repeat scree.poll(client, 100, heard) until answered
