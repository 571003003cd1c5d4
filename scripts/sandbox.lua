-- SPDX-License-Identifier: GPL-3.0-or-later
-- Limits the reach of a script. Called once with the host's functions before a script is loaded. Removes every
-- action outside the run from Lua's libraries: other programs, C libraries, bytecode, hooks and metatables of native
-- values. Files are written only under the run directory. With `trusted` nothing is removed. Globals are strict in
-- both cases.
local host, trusted = ...

local error, type, select, rawget, rawset, getmetatable, setmetatable, tostring, pcall, ipairs, tonumber =
  error, type, select, rawget, rawset, getmetatable, setmetatable, tostring, pcall, ipairs, tonumber
local getinfo, open, find = debug.getinfo, io.open, string.find

os.exit = host.exit

-- Raises an error at the running line of the script, below any depth of functions of Lua and of this file:
-- pcall(os.execute) has no line of its own.
local function fail(message)
  local place = ""
  for level = 3, 16 do
    local frame = getinfo(level, "Sl")
    if not frame then break end
    if frame.currentline > 0 and frame.source ~= "=sandbox" then
      place = frame.short_src .. ":" .. frame.currentline .. ": "
      break
    end
  end
  error(place .. message, 0)
end

-- Arithmetic with quantities written as strings.
local strings, known = getmetatable "", { string=true, number=true }
for _, event in ipairs{ "__add", "__sub", "__mul", "__div", "__mod", "__pow", "__idiv", "__unm" } do
  local original = strings[event]
  strings[event] = function(a, b)
    local text = type(a) == "string" and not tonumber(a) and a or type(b) == "string" and not tonumber(b) and b
    if text and known[type(a)] and known[type(b)] then
      fail("the string \"" .. text .. "\" was used in arithmetic, where a quantity is a plain SI number; write"
        .. " 1e-6 or 1 * lab.units.um for \"1 um\"")
    end
    return original(a, b)
  end
end

-- The host reads script files: a run records and copies them, and a replayed or resumed run loads its copies. Lua
-- itself reports a file that cannot be read.
local load_any, loadfile_original, searchpath, path_of = load, loadfile, package.searchpath, package
local all_modes = trusted and "bt" or "t" -- forged bytecode can crash the interpreter
local function load_script(path, is_module, mode, ...)
  if type(path) == "string" then
    local text, message = host.script_text(path, is_module)
    if text then return load_any(text, "@" .. path, mode, ...) end
    if message then fail(message) end
  end
  return loadfile_original(path, mode, ...)
end
function loadfile(path, mode, ...) return load_script(path, false, trusted and mode or all_modes, ...) end
function dofile(path)
  local chunk, message = load_script(path, false, all_modes)
  -- An error in the file has its own place.
  if not chunk and find(message, "cannot open", 1, true) then fail(message) end
  if not chunk then error(message, 0) end
  return chunk()
end
local gsub, gmatch = string.gsub, string.gmatch
function package.searchpath(name, path, separator, replacement)
  local function place() return (gsub(name, "%.", "/")) end
  if not separator and type(name) == "string" and type(path) == "string" then
    for template in gmatch(path, "[^;]+") do
      local file = gsub(template, "%?", place)
      if host.was_loaded(file) then return file end
    end
  end
  return searchpath(name, path, separator, replacement)
end
local search = package.searchpath
package.searchers[2] = function(name)
  local file, message = search(name, path_of.path)
  if not file then return message end
  local chunk, problem = load_script(file, true, all_modes)
  if not chunk then error(problem, 0) end
  return chunk, file
end

-- Lua's own wrap puts a second line before the message.
local create, resume, close = coroutine.create, coroutine.resume, coroutine.close
local function results(thread, done, ...)
  if not done then close(thread) error((...), 0) end
  return ...
end
function coroutine.wrap(body)
  local thread = create(body)
  return function(...) return results(thread, resume(thread, ...)) end
end

local lab = require "asperity"
function help(topic) print(lab.help(topic)) end

-- lab.materials.steel is a material of the list; an unknown name is an error with the nearest name.
setmetatable(lab.materials, {
  __index = function(_, name) if type(name) == "string" then return lab.material(name) end end })

if not trusted then
  local function refused(what, instead)
    return function()
      fail(what .. " is not available to a script" .. (instead and "; " .. instead or "")
        .. " (asperity run --trust gives the whole of Lua)")
    end
  end

  os.execute = refused("os.execute")
  os.tmpname = refused("os.tmpname", "give the file a name: it goes to the run directory")
  os.setlocale = refused("os.setlocale")
  io.popen = refused("io.popen")
  io.tmpfile = refused("io.tmpfile", "give the file a name: it goes to the run directory")

  -- Scripts read files anywhere and write files under the run directory only. A dry run writes no file: it
  -- checks the name and returns `instead`.
  local function destination(path, instead)
    if type(path) ~= "string" then fail("a file name must be a string, and is a " .. type(path)) end
    local place, message = host.output_path(path)
    if not place then fail(message) end
    return host.dry and instead or place
  end
  function io.open(path, mode)
    if mode ~= nil and find(tostring(mode), "[wa+]") then
      local file, message, code = open(destination(path, "/dev/null"), mode)
      host.settled()
      return file, message, code
    elseif type(path) == "string" then
      local place, message = host.input_path(path)
      if not place then return nil, message end
      path = place
    end
    return open(path, mode)
  end
  local lines, input = io.lines, io.input
  -- Reads record their file here. A file that cannot be opened is an error at the script's line.
  local function readable(path)
    if type(path) ~= "string" then return path end
    local place, message = host.input_path(path)
    local file = place
    if place then file, message = open(place) end
    if not file then fail(message) end
    file:close()
    return place
  end
  function io.lines(path, ...) return lines(readable(path), ...) end
  function io.input(file, ...) return input(readable(file), ...) end
  local output, opened = io.output, io.open
  function io.output(file)
    if type(file) ~= "string" then return output(file) end
    local handle, message = opened(file, "w")
    if not handle then fail(message) end
    return output(handle)
  end
  local remove, rename = os.remove, os.rename
  local function settled(place, done, ...)
    if done then host.settled(place) end
    return done, ...
  end
  function os.remove(path)
    local place = destination(path)
    if host.dry then return true end
    return settled(place, remove(place))
  end
  function os.rename(from, to)
    local old, new = destination(from), destination(to)
    if host.dry then return true end
    return settled(old, rename(old, new))
  end

  function load(chunk, name, _, ...)
    if select("#", ...) > 0 then return load_any(chunk, name, "t", (...)) end
    return load_any(chunk, name, "t")
  end
  package.loadlib, package.cpath = nil, ""
  package.searchers = { package.searchers[1], package.searchers[2] } -- package.preload, and script files

  -- Facts about a running function, but not the function: the removed originals may be on the stack.
  local running = coroutine.running
  local function getinfo_without_functions(thread, of, what)
    if type(thread) ~= "thread" then thread, of, what = running(), thread, of end
    if thread == running() and type(of) == "number" then of = of + 1 end
    local info = getinfo(thread, of, what)
    if info then info.func = nil end
    return info
  end
  debug = { traceback = debug.traceback, getinfo = getinfo_without_functions }
  package.loaded.debug = debug
end

-- Strict globals: reading an unset name is an error, and functions may not create globals.
local meta = getmetatable(_G) or {}
function meta.__index(_, name)
  local message = host.unknown_global(name, _G)
  local frame = getinfo(2, "Sl")
  local place = frame and frame.currentline > 0 and frame.short_src .. ":" .. frame.currentline .. ": " or ""
  local noted, instead = host.mistaken(place .. message)
  if noted then return instead end
  error(message, 2)
end
function meta.__newindex(globals, name, value)
  local frame = getinfo(2, "S")
  if frame and frame.what ~= "main" and frame.what ~= "C" then
    error("a function sets the global `" .. tostring(name) .. "`; write `local " .. tostring(name) .. "`", 2)
  end
  rawset(globals, name, value)
end
setmetatable(_G, meta)
