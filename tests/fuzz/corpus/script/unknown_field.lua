local lab = require "asperity"
print(lab.surfce)