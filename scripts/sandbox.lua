-- SPDX-License-Identifier: GPL-3.0-or-later
-- What a script may reach. Called once with the host's functions before a script is loaded; leaves
-- Lua's own libraries less what acts outside the run: no other programs, no C libraries, no bytecode,
-- no hooks or metatables of native values, and files are written only under the run directory.
-- With `trusted` nothing is taken away. Globals are strict either way.
local host, trusted = ...

local error, type, select, rawget, rawset, getmetatable, setmetatable, tostring, pcall =
  error, type, select, rawget, rawset, getmetatable, setmetatable, tostring, pcall
local getinfo, open, find = debug.getinfo, io.open, string.find

os.exit = host.exit

local lab = require "asperity"
function help(topic) print(lab.help(topic)) end

if not trusted then
  local function refused(what, instead)
    return function()
      error(what .. " is not available to a script" .. (instead and "; " .. instead or "")
        .. " (asperity run --trust gives the whole of Lua)", 2)
    end
  end

  os.execute = refused("os.execute")
  os.tmpname = refused("os.tmpname", "give the file a name: it goes to the run directory")
  os.setlocale = refused("os.setlocale")
  io.popen = refused("io.popen")
  io.tmpfile = refused("io.tmpfile", "give the file a name: it goes to the run directory")

  -- Files are read anywhere and written under the run directory only. A dry run writes none: it looks
  -- at the name and gives the place `instead`.
  local function destination(path, instead)
    if type(path) ~= "string" then error("a file name must be a string, and is a " .. type(path), 3) end
    local place, message = host.output_path(path)
    if not place then error(message, 3) end
    return host.dry and instead or place
  end
  function io.open(path, mode)
    if mode ~= nil and find(tostring(mode), "[wa+]") then
      path = destination(path, "/dev/null")
    elseif type(path) == "string" then
      path = host.input_path(path) or path
    end
    return open(path, mode)
  end
  -- Whatever is read is found, and known to have been read, in the same way.
  local function source(path) return type(path) == "string" and host.input_path(path) or path end
  local lines, input = io.lines, io.input
  -- One that cannot be opened is the script's error, at its line.
  local function readable(path)
    local place = source(path)
    if type(place) == "string" then
      local file, message = open(place)
      if not file then error(message, 3) end
      file:close()
    end
    return place
  end
  function io.lines(path, ...) return lines(readable(path), ...) end
  function io.input(file, ...) return input(readable(file), ...) end
  local output = io.output
  function io.output(file)
    if type(file) == "string" then
      local handle, message = open(destination(file, "/dev/null"), "w")
      if not handle then error(message, 2) end
      return output(handle)
    end
    return output(file)
  end
  local remove, rename = os.remove, os.rename
  function os.remove(path)
    local place = destination(path)
    if host.dry then return true end
    return remove(place)
  end
  function os.rename(from, to)
    local old, new = destination(from), destination(to)
    if host.dry then return true end
    return rename(old, new)
  end

  -- Chunks are text: bytecode can be made to crash the interpreter.
  local load_any, loadfile_original = load, loadfile
  local function loadfile_any(path, ...) return loadfile_original(source(path), ...) end
  function load(chunk, name, _, ...)
    if select("#", ...) > 0 then return load_any(chunk, name, "t", (...)) end
    return load_any(chunk, name, "t")
  end
  function loadfile(path, _, ...)
    if select("#", ...) > 0 then return loadfile_any(path, "t", (...)) end
    return loadfile_any(path, "t")
  end
  function dofile(path)
    local chunk, message = loadfile_any(path, "t")
    if not chunk then error(message, 0) end
    return chunk()
  end
  local searchpath, path_of = package.searchpath, package
  package.loadlib, package.cpath = nil, ""
  package.searchers = {
    package.searchers[1], -- package.preload
    function(name)
      local file, message = searchpath(name, path_of.path)
      if not file then return message end
      -- Known to be a module: where a case takes it from the script's folder, its name there counts.
      local chunk, problem = loadfile_original(host.input_path(file, true) or file, "t")
      if not chunk then error(problem, 0) end
      return chunk, file
    end,
  }

  -- What is known of a running function, less the function itself: the originals of what was taken
  -- away can be met on the stack.
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

-- Strict globals: a name that was never set is a slip, not nil; a function may not make new ones.
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
