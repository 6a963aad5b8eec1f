# SPDX-License-Identifier: Apache-2.0
"""What no case of cases/ has, for ranks_test.py: clouds that are not lattices, bodies that touch at the start, loads
that follow a face, releases, steps that crush cells, all ways of Taylor-SPH, particles of AdapTLE that convert."""

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

# The same with a plate glued under it that comes off, and a crate of rigid walls that meets a free one.
GLUED = TOUCHING.replace('name = "floor"\nplane = { point = ["0 mm", "0 mm", "0 mm"], normal = [0, 0, 1] }',
                         'name = "floor"\n'
                         'box = { min = ["-5 mm", "-5 mm", "-4 mm"], max = ["15 mm", "21 mm", "0 mm"] }\n'
                         'motion = "free"\nmass = "20 g"\nvelocity = ["5 m/s", "0 m/s", "-30 m/s"]') + """
[[rigid]]
name = "crate"
box = { min = ["0 mm", "0 mm", "-9 mm"], max = ["9 mm", "9 mm", "-4.1 mm"] }
motion = "free"
mass = "10 g"
velocity = ["0 m/s", "0 m/s", "20 m/s"]
[[tie]]
name = "glue"
between = ["left", "floor"]
strength = "0.2 MPa"
toughness = "30 J/m^2"
"""



def probe(name, body, kind, more=""):
    return f'[[probe]]\nname = "{name}"\nbody = "{body}"\nkind = "{kind}"\n{more}\n'


# Every kind of probe; of two bodies, one of which each rank has a part of, and of fields that one of them lacks.
POINTS = 'quantities = ["velocity_x", "principal_stress_1", "contact_pressure", "FIELD", "cauchy_stress_xy"]'
PROBED = TOUCHING + "".join(
    probe(f"{kind}_{body}", body, kind, more.replace("FIELD", own))
    for body, x, own in (("left", 9, "density"), ("right", 29, "cell_pressure")) for kind, more in (
        ("point", f'at = ["{x} mm", "9 mm", "9 mm"]\n' + POINTS), ("average", POINTS), ("minimum", POINTS),
        ("maximum", 'where = "X > 11e-3"\n' + POINTS), ("twist", ""), ("extent", 'axis = "x"'),
        ("error", 'field = "Velocity"\nreference = ["20*cos(1e5*t)", "Y", "X"]'),
        ("spacing", ""), ("fragment", "link = 1.2"),
        ("rim", 'axis = "z"\nat = ["0 mm", "0 mm", "0 mm"]\nanchored_where = "Z < 0.004"\nwithin = "15 mm"\n'
                'base = "1 mm"'))) + '[output.history]\nevery = "1e-12 s"\n'
PROBED_PLATE = """title = "Plate of copper that is pulled, with probes of plates"
[run]
end = "1 ms"
[[body]]
name = "plate"
shape = { box = { min = ["0 mm", "0 mm"], max = ["40 mm", "20 mm"] }, spacing = "1 mm" }
material = { name = "copper_ofhc", damage = "none" }
formulation = { name = "nodal" }
initial_velocity = ["5000*X", "0"]
""" + probe("ahead", "plate", "stress_intensity", 'at = ["10 mm", "10 mm"]\nfrom = "1 mm"\nto = "20 mm"') + probe(
    "hole", "plate", "hole", 'axis = "x"\nat = ["0 mm", "10 mm"]\nslab_from = "5 mm"\nslab_to = "9 mm"') + probe(
    "lowest", "plate", "minimum", 'where = "Y > 15e-3"\nquantities = ["pressure", "position_magnitude"]') + """
[output.history]
every = "1e-12 s"
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
follower = true
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

# So few particles that some ranks have none. It is not at rest at its end.
DESCENDING = """title = "Beam that is bent to rest by conjugate gradients"
[run]
end = "0.02 s"
relax = true
relax_method = "conjugate_gradients"
[[body]]
name = "beam"
shape = { box = { min = [0, 0], max = ["0.5 m", "0.05 m"] }, particles = [21, 3] }
material = { law = "neo_hookean", density = 1100, youngs_modulus = "17 MPa", poissons_ratio = 0.3 }
formulation = { name = "nodal" }
[[support]]
body = "beam"
where = "X <= 0"
fix = "xy"
[[load]]
body = "beam"
acceleration = ["0 m/s^2", "-9.81 m/s^2"]
[output.history]
every = "1 ms"
[output.checkpoints]
every = "5 ms"
"""

# A few particles in lists, which whirl until one is inverted.
WHIRLED = """title = "A coarse ball that whirls"
[run]
end = "40 ms"
[[body]]
name = "ball"
shape = { sphere = { centre = ["0 mm", "0 mm", "0 mm"], radius = "20 mm" }, spacing = "19 mm", jitter = 0.3 }
material = { law = "neo_hookean", density = 1100, youngs_modulus = "5 kPa", poissons_ratio = 0.45 }
formulation = { name = "jst_sph", scheme = "paper", gradient_support = 0.8 }
initial_velocity = ["400*Y", "-400*X", "0"]
[[support]]
body = "ball"
where = "X < -0.014"
fix = "xyz"
"""
# Particles that are not to be placed any more, from the first step on.
ESCAPED = FAILING.replace('"nodal"', '"adaptle", description = "total_lagrangian"').replace(
    "-200000*(X + 30*X*X)", "X > 0.0142 ? 1e31 : 0")

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

# Two bodies of AdapTLE convert where they meet, each by a rule of its own, beside a packed block and a floor.
TORN = """title = "Plate that is torn between a disc and a block"
[run]
end = "1 ms"
[[body]]
name = "disc"
shape = { sphere = { centre = ["-5.5 mm", "0 mm"], radius = "5 mm", arrangement = "rings" }, spacing = "0.4 mm" }
material = { name = "aluminium_perfectly_plastic", spall_pressure = "1.5 GPa" }
formulation = { name = "adaptle", convert_strain = 0.05, hourglass = 0.1 }
initial_velocity = ["3100 m/s", "200 m/s"]
[[body]]
name = "plate"
shape = { box = { min = ["0 mm", "-9 mm"], max = ["2 mm", "9 mm"] }, spacing = "0.4 mm", jitter = 0.1 }
material = { name = "aluminium_perfectly_plastic", spall_pressure = "1.5 GPa" }
formulation = { name = "adaptle", convert_when = "plastic_strain > 0.05", hourglass = 0.1 }
initial_velocity = ["500 m/s", "0 m/s"]
[[body]]
name = "block"
shape = { box = { min = ["6 mm", "-9 mm"], max = ["12 mm", "9 mm"] }, spacing = "0.6 mm", jitter = 0.1 }
material = { name = "aluminium_perfectly_plastic" }
formulation = { name = "nodal" }
[[rigid]]
name = "floor"
plane = { point = ["0 mm", "-9.4 mm"], normal = [0, 1] }
[[load]]
name = "wind"
body = "plate"
acceleration = ["0 m/s^2", "-1e8*(1 + X)"]
[[support]]
name = "end"
body = "plate"
where = "Y > 8.5e-3"
fix = "y"
until = "0.3 us"
[[probe]]
name = "lead"
body = "disc"
kind = "maximum"
quantities = ["position_x", "pressure"]
"""
# Each row looks at particles of other ranks, once these are cut anew.
# Cells that turn Eulerian in both bodies, in fast contact and within a plate that is held.
FLOWING = """title = "Disc and plate of nodal that turn Eulerian"
[run]
end = "1.5 us"
[[body]]
name = "disc"
shape = { sphere = { centre = ["-3 mm", "0.2 mm"], radius = "3 mm" }, spacing = "0.5 mm" }
material = { name = "aluminium_spall" }
formulation = { name = "nodal", conversion = "eulerian", convert_strain = 0.01 }
initial_velocity = ["2500 m/s", "100 m/s"]
[[body]]
name = "plate"
shape = { box = { min = ["0 mm", "-6 mm"], max = ["1.5 mm", "6 mm"] }, placement = "cell_centred", spacing = "0.5 mm" }
material = { name = "aluminium_spall" }
formulation = { name = "nodal", conversion = "eulerian", convert_strain = 0.01 }
[[support]]
body = "plate"
where = "abs(Y) > 5.4e-3"
fix = "xy"
"""

PROBED_TORN = TORN + "".join(
    probe(f"{kind}_{body}", body, kind, more) for body, x in (("disc", -1), ("plate", 1)) for kind, more in (
        ("point", f'at = ["{x} mm", "0 mm"]\n' + POINTS.replace("FIELD", "kernel_type")),
        ("average", POINTS.replace("FIELD", "density")), ("twist", 'axis = "z"'), ("extent", 'axis = "y"'))
) + '[output.history]\nevery = "1e-12 s"\n'
# Surfaces of whole bodies of AdapTLE rub and tie as others do.
RUBBING = """title = "Bar of AdapTLE that rubs on a packed block and on itself"
[run]
end = "1 ms"
[contact]
friction = 0.3
self = true
[[body]]
name = "bar"
shape.box = { min = ["0 mm", "0 mm", "0 mm"], max = ["24 mm", "12 mm", "10 mm"] }
shape.spacing = "2 mm"
shape.jitter = 0.1
shape.placement = "cell_centred"
material = { name = "copper_ofhc", damage = "none" }
formulation = { name = "adaptle", description = "total_lagrangian" }
initial_velocity = ["100 m/s", "10 m/s", "-150 m/s"]
[[body]]
name = "block"
shape.box = { min = ["4 mm", "-2 mm", "-10 mm"], max = ["30 mm", "14 mm", "0 mm"] }
shape.spacing = "2.5 mm"
shape.jitter = 0.15
shape.placement = "cell_centred"
material = { name = "copper_ofhc", damage = "none" }
formulation = { name = "nodal" }
[[rigid]]
name = "ball"
sphere = { centre = ["12 mm", "6 mm", "14.1 mm"], radius = "4 mm" }
motion = "free"
mass = "5 g"
velocity = ["0 m/s", "0 m/s", "-300 m/s"]
"""

TAYLOR = """title = "Plate of Taylor-SPH, beside a disc of another formulation"
contact = "none"
[run]
end = "1 us"
[[body]]
name = "plate"
shape = { box = { min = ["0 m", "0 m"], max = ["60 mm", "30 mm"] }, spacing = "3 mm" }
material = { law = "linear_elastic", density = 1000, youngs_modulus = "2 MPa", poissons_ratio = 0.3 }
formulation = { name = "taylor_sph" }
[[body]]
name = "disc"
shape = { sphere = { centre = ["25 mm", "60 mm"], radius = "20 mm" }, spacing = "4 mm" }
material = { law = "neo_hookean", density = 1000, youngs_modulus = "1 MPa", poissons_ratio = 0.3 }
formulation = { name = "nodal" }
"""

# Enough particles for several ranks to have pages, and compressed chunks, of a file to write.
LARGE = """title = "Block of rubber of many particles"
[run]
end = "1 ms"
[[body]]
name = "block"
shape = { box = { min = ["0 m", "0 m", "0 m"], max = ["1 m", "0.9 m", "1 m"] }, particles = [40, 33, 36] }
material = { law = "neo_hookean", density = 1100, youngs_modulus = "17 MPa", poissons_ratio = 0.45 }
formulation = { name = "jst_sph" }
initial_velocity = ["20*Z*Z", "5*X*Y", "-20*X"]
"""

# Cuts lie behind the surfaces that meet, along them, too: ranks whose cells are beside readers have nothing to tell.
COLUMNS = """title = "Columns of AdapTLE that meet end to end"
[run]
end = "2 us"
""" + "".join(f"""[[body]]
name = "{name}"
shape.box = {{ min = ["0 mm", "0 mm", "{low} mm"], max = ["8 mm", "8 mm", "{low + 10} mm"] }}
shape.spacing = "1 mm"
shape.placement = "cell_centred"
material = {{ name = "copper_ofhc", damage = "none" }}
formulation = {{ name = "adaptle", description = "{description}" }}
initial_velocity = ["0 m/s", "0 m/s", "{speed} m/s"]
""" for name, low, speed, description in (("low", 0, 0, "total_lagrangian"), ("high", 11.2, -300, "total_lagrangian"),
                                          ("flowing", -13, 200, "eulerian"), ("far", 1e7, 0, "eulerian")))

OWN_CASES = {name: text + OUTPUT for name, text in {
    "touching bodies": TOUCHING,
    "glued to a plate": GLUED,
    "probed bodies": PROBED,
    "probed plate": PROBED_PLATE,
    "rolling disc": DISC,
    "mirrored copper": MIRRORED,
    "copper that comes to rest": MIRRORED.replace("[run]", "[run]\nrelax = true"),
    "crushed cells": CRUSHED,
    "held packing": HELD,
    "multipliers": MULTIPLIERS.replace("SCHEME", ""),
    "multipliers of the paper's scheme": MULTIPLIERS.replace("SCHEME", ', scheme = "paper"'),
    "torn plate": TORN,
    "torn plate with probes": PROBED_TORN,
    "disc and plate that flow": FLOWING,
    "deleted disc": TORN.replace("convert_strain = 0.05", 'description = "total_lagrangian", failed = "delete", '
                                                          "convert_strain = 0.05"),
    "rubbing bar of AdapTLE": RUBBING,
    "columns end to end": COLUMNS,
    "large files": LARGE,
}.items()}

NEAR = ('body.disc.shape={ sphere = { centre = ["-5.2 mm", 0], radius = "5 mm", arrangement = "rings" }, '
        'spacing = "0.25 mm" }')
COARSE = 'body.plate.shape={ box = { min = [0, "-9 mm"], max = ["2 mm", "9 mm"] }, spacing = "0.25 mm" }'
SHEET = "body.sheet.formulation."
PATCH = [SHEET + "description=patch", SHEET + "eulerian_where=Y > 0.5"]
RING = "body.ring."
HALVES = "body.bar.formulation."

# Cases of cases/adaptle with other words, and a column that is above zero at the end.
VARIANTS = {
    "torn": ("impact_2d", "converted_particles", [NEAR, COARSE, "body.plate.formulation.convert_strain=0.05"]),
    "guarded": ("impact_2d", "guard_conversions", [NEAR, COARSE, "body.plate.formulation.jacobian_min=0.98"]),
    "by formula": ("impact_2d", "converted_particles",
                   [NEAR, COARSE, "body.plate.formulation.convert_when=plastic_strain > 0.02"]),
    "deleted": ("expanding_ring", "deleted_particles",
                [RING + "formulation.description=total_lagrangian", RING + "formulation.failed=delete",
                 RING + "material.d1=0.00001"]),
    "released": ("expanding_ring", "failed_particles", [RING + "material.d1=0.00001"]),
    "meeting": ("impact_2d", "contact_overlap", [NEAR, COARSE]),
    "by the printed law": ("impact_2d", "contact_overlap", [NEAR, COARSE, "contact.law=published",
                                                            "contact.stiffness=1e9"]),
    "jittered patch": ("tensile_patch", "eulerian_particles", [*PATCH, "body.sheet.shape.jitter=0.2"]),
    "blended patch": ("tensile_patch", "eulerian_particles", [*PATCH, SHEET + "blend=4"]),
    "damped patch": ("tensile_patch", "eulerian_particles",
                     [*PATCH, SHEET + "hourglass=0.2", SHEET + "hourglass_stiffness=0.1"]),
    "printed patch": ("tensile_patch", "eulerian_particles",
                      [*PATCH, SHEET + "interface=published", SHEET + "correction=material"]),
    "corrected": ("tensile_patch", "eulerian_particles", [SHEET + "description=eulerian"]),
    "fluxes": ("colliding_halves", "eulerian_particles",
               [HALVES + "description=eulerian", HALVES + "viscosity=riemann"]),
    # The law is named, as bars that start so close to a wall are refused otherwise.
    "on a wall": ("taylor_bar", "contact_overlap", ["body.bar.shape.spacing=0.8 mm", "contact.law=kernel"]),
    "along a wall": ("taylor_bar", "contact_overlap",  # each rank has some that touch it
                     ["body.bar.shape.spacing=0.8 mm", "contact.law=kernel",
                      'body.bar.initial_velocity=["-227", "0", "0"]',
                      'rigid.wall.plane={ point = ["-3 mm", "0 mm", "0 mm"], normal = [1, 0, 0] }']),
}
