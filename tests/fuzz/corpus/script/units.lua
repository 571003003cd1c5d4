local lab = require "asperity"
print(lab.units.deg * 90, lab.material{ young="70 GPa", poisson=0.3 })