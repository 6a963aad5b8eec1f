# SPDX-License-Identifier: Apache-2.0
"""What no case of cases/ has, for ranks_test.py: clouds that are not lattices, bodies that touch at the start, loads
that follow a face, releases, steps that crush cells, all ways of Taylor-SPH."""

OUTPUT = """
[output.frames]
every = "1 s"
[output.checkpoints]
every = "1 s"
"""

# Steps while bodies of two formulations push each other and a floor, with friction, from the first one on.
TOUCHING = """title = "Bodies of two formulations that touch"
[run]
end = "1 ms"
[contact]
friction = 0.3
self = true
[[body]]
name = "left"
shape.box = { min = ["0 mm", "0 mm", "0 mm"], max = ["20 mm", "16 mm", "12 mm"] }
shape.spacing = "2 mm"
shape.jitter = 0.1
shape.placement = "cell_centred"
material = { law = "neo_hookean", density = 1100, youngs_modulus = "5 MPa", poissons_ratio = 0.4 }
formulation = { name = "jst_sph" }
initial_velocity = ["20 m/s", "5 m/s", "0 m/s"]
[[body]]
name = "right"
shape.box = { min = ["20 mm", "-2 mm", "0 mm"], max = ["38 mm", "14 mm", "12 mm"] }
shape.spacing = "2.5 mm"
shape.jitter = 0.15
shape.placement = "cell_centred"
material = { law = "neo_hookean", density = 1300, youngs_modulus = "20 MPa", poissons_ratio = 0.3 }
formulation = { name = "nodal" }
initial_velocity = ["-20 m/s", "0 m/s", "-1 m/s"]
[[rigid]]
name = "floor"
plane = { point = ["0 mm", "0 mm", "0 mm"], normal = [0, 0, 1] }
[[rigid]]
name = "ball"
sphere = { centre = ["20 mm", "8 mm", "17 mm"], radius = "5 mm" }
motion = "free"
mass = "5 g"
velocity = ["0 m/s", "0 m/s", "-10 m/s"]
[[load]]
body = "left"
acceleration = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[support]]
body = "right"
where = "X > 35.5e-3"
fix = "x"
until = "40 us"
"""

DISC = """title = "Disc of a jittered cloud that rolls"
[run]
end = "10 ms"
[contact]
friction = 0.4
self = true
[[body]]
name = "disc"
shape = { sphere = { centre = ["0 mm", "50 mm"], radius = "50 mm" }, spacing = "4 mm", jitter = 0.2 }
material = { law = "neo_hookean", density = 1000, youngs_modulus = "1 MPa", poissons_ratio = 0.3 }
formulation = { name = "nodal", fluctuation_viscosity = 0.3 }
initial_velocity = ["-100*(Y - 0.05)", "100*X - 4"]
[[rigid]]
name = "ground"
plane = { point = ["0 mm", "1 mm"], normal = [0, 1] }
"""

MIRRORED = """title = "Half a block of copper under a pressure that follows"
[run]
end = "1 ms"
[[body]]
name = "block"
shape.box = { min = ["0 mm", "0 mm", "0 mm"], max = ["24 mm", "20 mm", "10 mm"] }
shape.spacing = "2 mm"
shape.jitter = 0.1
shape.placement = "cell_centred"
material = { name = "copper_ofhc", damage = "none" }
formulation = { name = "nodal", shock_viscosity = 1 }
initial_velocity = ["-2000*X", "0", "30*sin(200*Y)"]
[[mirror]]
body = "block"
face = "-x"
[[load]]
name = "press"
body = "block"
face = "+z"
pressure = "200e6*min(t/1e-6, 1)"
follows = true
until = "1.5 us"
[[support]]
name = "foot"
body = "block"
where = "Z < 1.8e-3"
fix = "z"
velocity = ["0 m/s", "0 m/s", "10*sin(1e6*t)"]
until = "1 us"
"""

# The first steps are taken again in parts.
CRUSHED = """title = "Cells that a step crushes"
[run]
end = "1 ms"
cfl = 0.5
[[body]]
name = "brick"
shape.box = { min = ["0 mm", "0 mm", "0 mm"], max = ["16 mm", "10 mm", "8 mm"] }
shape.spacing = "1 mm"
shape.jitter = 0.1
shape.placement = "cell_centred"
material = { law = "neo_hookean", density = 1100, youngs_modulus = "17 MPa", poissons_ratio = 0.3 }
formulation = { name = "nodal" }
initial_velocity = ["X > 14.2e-3 ? -200 : 0", "0", "0"]
"""

# Ends with a particle that is inverted.
FAILING = """title = "Cells that are crushed for good"
[run]
end = "6.4 us"
cfl = 1.5
[[body]]
name = "brick"
shape.box = { min = ["0 mm", "0 mm", "0 mm"], max = ["16 mm", "10 mm", "8 mm"] }
shape.spacing = "1 mm"
shape.jitter = 0.1
shape.placement = "cell_centred"
material = { name = "copper_ofhc", damage = "none" }
formulation = { name = "nodal" }
initial_velocity = ["-200000*(X + 30*X*X)", "0", "0"]
[output.history]
every = "0.2 us"
"""

HELD = """title = "Packed block, held by a patch, hit by a ball"
[run]
end = "1 ms"
[[body]]
name = "block"
shape.box = { min = ["-10 mm", "-10 mm", "-8 mm"], max = ["10 mm", "10 mm", "0 mm"] }
shape.spacing = "2.5 mm"
shape.arrangement = "packed"
material = { law = "neo_hookean", density = 1100, youngs_modulus = "5 MPa", poissons_ratio = 0.4 }
formulation = { name = "nodal" }
[[support]]
name = "foot"
body = "block"
patch = "-z"
fix = "xyz"
velocity = ["5*sin(1e4*t)", "0 m/s", "0 m/s"]
[[rigid]]
name = "ball"
sphere = { centre = ["9 mm", "0 mm", "1.9 mm"], radius = "2 mm" }
motion = "free"
mass = "2 g"
velocity = ["0 m/s", "0 m/s", "-30 m/s"]
"""

MULTIPLIERS = """title = "Block between inclined supports, by multipliers"
[run]
end = "10 ms"
[[body]]
name = "block"
shape = { box = { min = ["0 mm", "0 mm", "0 mm"], max = ["40 mm", "20 mm", "10 mm"] }, spacing = "2 mm" }
material = { law = "neo_hookean", density = 1100, youngs_modulus = "5 MPa", poissons_ratio = 0.45 }
formulation = { name = "jst_sph", supports = "multipliers"SCHEME }
initial_velocity = ["0", "20*X", "3 m/s"]
[[support]]
name = "left"
body = "block"
where = "X < 1e-6"
fix = "xyz"
velocity = ["-2 m/s", "0 m/s", "1*sin(1e4*t)"]
[[support]]
name = "right"
body = "block"
where = "X > 0.0399"
fix = "normal"
normal = [1, 1, 0]
until = "100 us"
"""

TAYLOR = """title = "Taylor-SPH"
[run]
end = "10 ms"
[[body]]
name = "plate"
shape = { box = { min = ["0 mm", "0 mm"], max = ["100 mm", "40 mm"] }, spacing = "2.5 mm"JITTER }
material = { law = "linear_elastic", density = 1000, youngs_modulus = "2 MPa", poissons_ratio = 0.3 }
formulation = { name = "taylor_sph"SETTING }
initial_velocity = ["-40*X", "5*sin(60*X)"]
[[support]]
name = "clamp"
body = "plate"
where = "X <= 1e-9"
fix = "xy"
velocity = ["0 m/s", "2*sin(3000*t)"]
[[load]]
name = "press"
body = "plate"
face = "+y"
pressure = "20 kPa"
[[load]]
body = "plate"
acceleration = ["0 m/s^2", "-9.81 m/s^2"]
"""

TAYLOR_BETWEEN = """title = "Taylor-SPH between a rigid wall and a disc of nodal particles"
[run]
end = "10 ms"
[contact]
friction = 0.2
[[body]]
name = "plate"
shape = { box = { min = ["0 mm", "0 mm"], max = ["60 mm", "30 mm"] }, spacing = "2.5 mm" }
material = { law = "linear_elastic", density = 1000, youngs_modulus = "2 MPa", poissons_ratio = 0.3 }
formulation = { name = "taylor_sph" }
initial_velocity = ["0 m/s", "-2 m/s"]
[[body]]
name = "disc"
shape = { sphere = { centre = ["25 mm", "50 mm"], radius = "20 mm" }, spacing = "2 mm" }
material = { law = "neo_hookean", density = 1000, youngs_modulus = "1 MPa", poissons_ratio = 0.3 }
formulation = { name = "nodal" }
initial_velocity = ["3 m/s", "-6 m/s"]
[[rigid]]
name = "wall"
plane = { point = ["0 mm", "0 mm"], normal = [0, 1] }
"""


MANY_TRIANGLES = """title = "Plate with more triangles than every rank should make"
[run]
end = "1 us"
[[body]]
name = "plate"
shape = { box = { min = ["0 m", "0 m"], max = ["1.5 m", "1.4 m"] }, spacing = "1 mm" }
material = { law = "linear_elastic", density = 1000, youngs_modulus = "2 MPa", poissons_ratio = 0.3 }
formulation = { name = "taylor_sph" }
"""


def of_taylor(setting, jitter=0):
    return TAYLOR.replace("SETTING", setting).replace("JITTER", f", jitter = {jitter}" if jitter else "")


OWN_CASES = {name: text + OUTPUT for name, text in {
    "touching bodies": TOUCHING,
    "rolling disc": DISC,
    "mirrored copper": MIRRORED,
    "copper that comes to rest": MIRRORED.replace("[run]", "[run]\nrelax = true"),
    "crushed cells": CRUSHED,
    "held packing": HELD,
    "multipliers": MULTIPLIERS.replace("SCHEME", ""),
    "multipliers of the paper's scheme": MULTIPLIERS.replace("SCHEME", ', scheme = "paper"'),
    "estimates, triangles": of_taylor(', exchange = "estimates", virtual_particles = "delaunay"', 0.15),
    "estimates, boxes": of_taylor(', exchange = "estimates", virtual_particles = "lattice_cells"'),
    "estimates, fixed": of_taylor(', configuration = "fixed"'),
    "adjoint, triangles": of_taylor("", 0.15),
    "adjoint, boxes": of_taylor(', virtual_particles = "lattice_cells", hourglass_stiffness = 0.05'),
    "Taylor-SPH between others": TAYLOR_BETWEEN,
}.items()}
