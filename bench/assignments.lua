-- Leases and answers with wrk, each thread as one annotator: wrk -s assignments.lua URL -- MODE RUN,RUN... ANSWER TOKEN...
-- The first thread works in the first run, the second in the second, and so on, again from the first.
-- It prints a line per cycle: its milliseconds and the id of the query.
local ffi = require("ffi")
ffi.cdef [[
  typedef struct { long seconds, nanoseconds; } instant;
  int clock_gettime(int clock, instant *now);
]]
local MONOTONIC = 1
local threads = {}
local instant = ffi.new("instant")

local function milliseconds()
  ffi.C.clock_gettime(MONOTONIC, instant)
  return tonumber(instant.seconds) * 1e3 + tonumber(instant.nanoseconds) / 1e6
end

function setup(thread)
  table.insert(threads, thread)
  thread:set("number", #threads)
end

function init(args)
  local runs = {}
  for one in args[2]:gmatch("[^,]+") do
    table.insert(runs, one)
  end
  mode, answer, token = args[1], args[3], args[3 + number]
  run = runs[(number - 1) % #runs + 1]
  headers = { ["Authorization"] = "Bearer " .. token, ["Content-Type"] = "application/json" }
  held, begun, cycles = nil, nil, {}
end

function request()
  begun = begun or milliseconds()
  if held == nil then
    return wrk.format("POST", "/api/v1/assignments", headers, '{"run":"' .. run .. '"}')
  end
  local following = mode == "chained" and ',"next":{"run":"' .. run .. '"}' or ""
  local body = '{"token":"' .. held.token .. '","answer":' .. answer .. following .. "}"
  return wrk.format("POST", "/api/v1/assignments/" .. held.id .. "/answer", headers, body)
end

local function assignment(body)
  local id, token = body:match('"id":(%d+),"token":"([^"]+)"')
  return id and { id = id, token = token }
end

function response(status, _, body)
  if held == nil then
    held = status == 201 and assignment(body) or nil
    return
  end
  if status == 200 then
    table.insert(cycles, string.format("%.3f %s", milliseconds() - begun, body:match('"query":(%d+)')))
  end
  held, begun = mode == "chained" and assignment(body:match('"next":(.*)')) or nil, nil
end

function done()
  for _, thread in ipairs(threads) do
    for _, line in ipairs(thread:get("cycles")) do
      print("cycle " .. line)
    end
  end
end
