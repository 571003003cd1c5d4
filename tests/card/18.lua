-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local soft = lab.material{ young="70 GPa", poisson=0.33, hardness="1 GPa", name="soft" }
local hard = lab.material{ young="70 GPa", poisson=0.33, hardness="1.5 GPa", name="hard" }
local function face(seed, m)
  return lab.surface.self_affine{ cells=64, size="100 um", hurst=0.8, rms_slope=0.2, short_wave="8 um",
                                  long_wave="50 um", seed=seed, material=m }
end
local c = lab.contact{ lower=face(1, soft), upper=face(2, hard), boundary="periodic",
                       effects={ elasticity="half_space", plasticity={} } }
local low0, up0 = c:lower(), c:upper()
local st = c:press{ pressure="100 MPa" }
local total = st.plastic_volume
c:release()
local area = low0.size[1] * low0.size[2]
local v_soft = (low0 - c:lower()):roughness().mean * area
local v_hard = (up0 - c:upper()):roughness().mean * area
lab.say("soft %.4f [um^3], hard %.4f [um^3], together %.4f [um^3] (state: %.4f [um^3])", v_soft, v_hard, v_soft + v_hard, total)
