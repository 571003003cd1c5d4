local lab = require "asperity"
local s = lab.surface.sine{ cells=16, size="1 mm", amplitude="1 um", material=lab.material "Al-2011" }
local c <close> = lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space", plasticity={} } }
for st in c:sweep{ pressure={ 1e5, 1e6 } } do print(st.area, st.digest) end