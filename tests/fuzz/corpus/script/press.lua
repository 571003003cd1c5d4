local lab = require "asperity"
local s = lab.surface.weierstrass_mandelbrot{ cells=8, D=2.5, n_max=5, seed=1, material=lab.material "Al-2011" }
local c = lab.contact{ lower=s, upper=lab.rigid, boundary="free", effects={ elasticity="box" } }
local st = c:press{ pressure="1 MPa" }
print(st.area_fraction, st)
c:release() c:close()