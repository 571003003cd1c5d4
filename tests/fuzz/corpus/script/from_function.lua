local lab = require "asperity"
print(lab.surface.from_function{ cells=3, size=1, height=function(x, y) return x * y end }:heights()[2][2])