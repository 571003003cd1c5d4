#!/usr/bin/env asperity
return 1