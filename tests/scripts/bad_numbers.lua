-- SPDX-License-Identifier: GPL-3.0-or-later
-- Cells, dimensions and counts at and past their limits.
--! output: all refused
local lab = require "asperity"
local S = lab.surface
local W = S.weierstrass_mandelbrot
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
refused(function() W{ cells=0, D=2.5 } end, "`cells` is 0; give a whole number from 1 to 65536")
refused(function() W{ cells={ 8, 0 }, D=2.5 } end, "`cells` is 0")
refused(function() W{ cells=-4, D=2.5 } end, "`cells` is -4")
refused(function() W{ cells=8.5, D=2.5 } end, "`cells` is 8.5; give a whole number")
refused(function() W{ cells=65537, D=2.5 } end, "`cells` is 65537")
refused(function() W{ cells=8, D=1.9999999999999998 } end, "`D` is ", "give a number from 2 to 3")
refused(function() W{ cells=8, D=3.0000000000000004 } end, "`D` is ", "give a number from 2 to 3")
refused(function() W{ cells=8, D=0/0 } end, "`D` is nan")
refused(function() W{ cells=8, D=2.5, n_max=5000 } end, "`n_max` is 5000; with gamma = 1.5 give a whole number from 0 to 3501")
refused(function() W{ cells=8, D=2.5, n_max=-1 } end, "`n_max` is -1")
refused(function() W{ cells=8, D=2.5, gamma=1 } end, "`gamma` is 1; give a number above 1")
refused(function() W{ cells=8, D=2.5, M=0 } end, "`M` is 0")
refused(function() S.self_affine{ cells=8, size=1, hurst=0.5, short_wave=0.01, rms_height=1 } end, "`short_wave` is 10 mm, under two cells")
refused(function() S.sphere{ cells=8, size=1, radius=0.1 } end, "`radius` is 100 mm")
refused(function() S.grain_profile{ radius=1, D=2, points=3 } end, "`D` is 2", "`points` is 3")
local s = S.sine{ cells=16, size="1 mm", amplitude="1 um" }
refused(function() s:height(16, 0) end, "there is no node (16, 0); i runs from 0 to 15")
refused(function() s:height(0.5, 0) end, "there is no node (0.5, 0)")
refused(function() s:height(0, -1) end, "there is no node (0, -1)")
refused(function() s:height(0/0, 0) end, "`i` is nan")
refused(function() s:profile{ row=16 } end, "there is no row 16")
refused(function() s:cropped{ size="2 mm" } end, "a crop of 32 cells")
refused(function() s:plus(S.flat{ cells=8, size=1 }) end, "cannot be added", "resampled")
refused(function() S.flat{ cells=8, size=1 }:scaled{ amplitude=1 } end, "a flat surface cannot be scaled")
refused(function() s:filtered{} end, "a filter needs `short_wave` or `long_wave`")
refused(function() s:filtered{ short_wave=1, long_wave=0.1 } end, "`short_wave` 1 m is not below `long_wave`")
refused(function() s:levelled{ degree=9 } end, "`degree` is 9")
refused(function() s:cut{ fraction=2 } end, "`fraction` is 2")
refused(function() s:fractal_dimension{ steps={ 1 } } end, "`steps` is a list of 1; give a list of two or more")
refused(function() S.flat{ cells={ 64 }, size=1 } end, "`cells` is a list of 1")
refused(function() S.from_function{ cells=4, size=1, height=function() error{ code=3 } end } end, "failed: ", "code=", "3")
refused(function() return s.Ra end, "no field `Ra`; write `surface:roughness().Ra`")
-- Values just inside the limits are accepted.
W{ cells=1, D=2, n_max=3501 }
W{ cells={ 1, 7 }, D=3, n_max=0 }
W{ cells=8, D=2.5, gamma=1.0001, n_max=4096 }
print "all refused"
