-- scree/client.h for LuaJIT: the header's own declarations, and a few lines that make them convenient.
-- usage: local scree = require "scree"; the header is found in LIBSCREE_INCLUDE, or in /usr/include.
local ffi = require "ffi"

local folder = os.getenv("LIBSCREE_INCLUDE") or "/usr/include"
local file = assert(io.open(folder .. "/scree/client.h"))
local text = file:read("*a"):gsub("#ifdef __cplusplus.-#endif", ""):gsub("#[^\n]*", ""):gsub("SCREE_API ", "")
file:close()
ffi.cdef(text)

local C = ffi.load(os.getenv("LIBSCREE_CLIENT") or "scree_client")
local scree = { C = C }

-- A struct of the header with its size set.
function scree.new(name)
  local value = ffi.new(name)
  value.size = ffi.sizeof(value)
  return value
end

-- The result, or an error with the library's words.
function scree.check(result)
  if result < 0 then error(ffi.string(C.scree_error()), 2) end
  return result
end

function scree.request(kind)
  local request = scree.new("scree_request")
  scree.check(C.scree_request_init(request, ffi.sizeof(request), kind))
  return request
end

-- A client that waits for its welcome.
function scree.connect(host, port, flags)
  local options, client = scree.new("scree_options"), ffi.new("scree_client*[1]")
  scree.check(C.scree_options_init(options, ffi.sizeof(options)))
  options.host, options.port = host, port
  options.flags = bit.bor(options.flags, C.SCREE_ONCE, flags or 0)
  scree.check(C.scree_client_create(options, client))
  return ffi.gc(client[0], C.scree_client_destroy)
end

-- Waits up to so many milliseconds, and calls heard(event) for each event. Copy what is kept of one.
function scree.poll(client, wait_ms, heard)
  local event = scree.new("scree_event")
  scree.check(C.scree_client_poll(client, wait_ms))
  while scree.check(C.scree_client_next(client, event)) == C.SCREE_OK do heard(event) end
end

function scree.status(client)
  local status = scree.new("scree_status")
  scree.check(C.scree_client_status(client, status))
  return status
end

return scree
