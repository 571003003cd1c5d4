#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What tests/scripts/hdf5.lua writes, read by h5py and by an XML parser: values, shapes, units, attributes. Skipped
# (77) where no Python here has h5py.
# usage: h5py.sh PROGRAM SCRIPT FOLDER
set -eu
python=
for candidate in python3 /usr/bin/python3; do
  if $candidate -c 'import h5py' 2>/dev/null; then python=$candidate; fi
done
if [ -z "$python" ]; then
  echo "skipped: no Python here has h5py (Debian's package python3-h5py)"
  exit 77
fi
rm -rf "$3"
"$1" run "$2" --out "$3"
cd "$3"
$python - <<'PYTHON'
import h5py, numpy, xml.etree.ElementTree as tree

def described(name):
    """The data that an XDMF file points to, by name."""
    grid = tree.parse(name + ".xdmf").getroot().find("Domain/Grid")
    dimensions = grid.find("Topology").get("Dimensions")
    found = {}
    for attribute in grid.findall("Attribute"):
        item = attribute.find("DataItem")
        file, path = item.text.split(":/")
        data = h5py.File(file)[path]
        assert item.get("Dimensions") == dimensions == "1 %d %d" % data.shape, (item.get("Dimensions"), data.shape)
        assert int(item.get("Precision")) == data.dtype.itemsize
        assert data.id.get_offset() is not None and data.chunks is None
        found[attribute.get("Name")] = data
    spacing = [float(x) for x in grid.findall("Geometry/DataItem")[1].text.split()]
    return found, spacing

with h5py.File("s.h5") as f:
    height, size = f["height"], f["size"]
    assert height.shape == (20, 24) and height.dtype == "<f8" and height.attrs["unit"] == b"m"
    assert numpy.array_equal(size[:], [24e-6, 30e-6]) and size.attrs["unit"] == b"m"
    assert numpy.array_equal(height[:], numpy.load("s.npy"))
found, spacing = described("s")
assert list(found) == ["height [m]"] and abs(spacing[0] - 1e-6) < 1e-20 and abs(spacing[1] - 1.5e-6) < 1e-20

with h5py.File("state.h5") as f:
    a = f.attrs
    assert a["content"] == b"asperity state" and len(a["digest"]) == 32
    assert set(f) == {"pressure", "gap", "contact", "displacement", "plastic", "size"}
    assert {name: f[name].attrs.get("unit") for name in f} == {
        "pressure": b"Pa", "gap": b"m", "contact": None, "displacement": b"m", "plastic": b"m", "size": b"m"}
    p, contact, cell = f["pressure"][:], f["contact"][:], 1e-6 * 1.5e-6
    assert contact.dtype == "u1" and set(numpy.unique(contact)) == {0, 1}
    assert abs(p.mean() - 50e6) < 1e-3 * 50e6 and abs(a["pressure"] - 50e6) < 1e-6
    assert abs(p.sum() * cell - a["load"]) < 1e-6 * a["load"]
    assert abs(contact.sum() * cell - a["area"]) < 1e-12 * a["area"] and (p[contact == 1] > 0).all()
    assert 0 < a["certificate"] < 1e-5 and a["approach"] > 0
    assert (f["gap"][:][contact == 0] >= -1e-12).all()
found, spacing = described("state")
assert set(found) == {"pressure [Pa]", "gap [m]", "contact", "displacement [m]", "plastic [m]"}
assert set(h5py.File("few.h5")) == {"pressure", "gap", "size"}
assert set(h5py.File("elastic.h5")) == {"pressure", "gap", "contact", "displacement", "size"}

# And the other way: as h5py writes by default, compressed, and with numbers of other types.
heights = numpy.linspace(-1, 1, 12).reshape(3, 4) * 1e-6
for name, options in {"plain": {}, "packed": {"compression": "gzip", "shuffle": True, "fletcher32": True, "chunks": (2, 3)},
                      "single": {"dtype": ">f4"}}.items():
    with h5py.File("theirs_" + name + ".h5", "w") as f:
        made = f.create_dataset("scan/topography", data=heights * 1e6, **options)
        made.attrs["unit"] = "um"
        f["size"] = [4e-6, 3e-6]
        f["size"].attrs["unit"] = "m"
        f["note"] = "not a map"
PYTHON
cat >theirs.lua <<'LUA'
local lab = require "asperity"
for _, name in ipairs{ "plain", "packed", "single" } do
  local s = lab.surface.read("theirs_" .. name .. ".h5")
  assert(s.cells[1] == 4 and s.cells[2] == 3 and s.size[1] == 4e-6 and s.size[2] == 3e-6, name)
  for j = 0, 2 do
    for i = 0, 3 do assert(math.abs(s:height(i, j) - (-1 + 2 * (4 * j + i) / 11) * 1e-6) < 1e-13, name) end
  end
end
print "h5py and asperity read each other's files"
LUA
"$1" run theirs.lua --out theirs
