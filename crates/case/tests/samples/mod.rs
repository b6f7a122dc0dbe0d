//! Four cases that are right.
#![allow(dead_code, reason = "each test program uses some of them")]

use case::{Case, CaseError, Overrides};

/// Two rings, updated Lagrangian, 2D.
pub const RINGS: &str = r#"name = "rings"
title = "Two rings"
dimension = 2
plane = "papers"
formulation = "ul-non-hourglass"
stepping = "dual"
spacing = "dp"
kernel = "wendland-c2"
smoothing = 1.3
reference_speed = "0.1*c0"

[parameters]
resolution = 10
E = "10 MPa"
nu = 0.4
rho = 1200
wall = "10 mm"
dp = "wall/resolution"
c0 = "sqrt(E/(3*(1-2*nu))/rho)"
v0 = "0.06*c0"

[material.rubber]
model = "linear-elastic"
density = "rho"
youngs_modulus = "E"
poisson_ratio = "nu"

[[body]]
name = "left"
material = "rubber"
shape = { ring = { center = [-0.045, 0], inner = 0.03, outer = "4 cm" } }
fill = "concentric"
velocity = ["v0", 0]

[[body]]
name = "right"
material = "rubber"
shape = { ring = { center = [0.045, 0], inner = 0.03, outer = 0.04 } }
fill = "concentric"
velocity = ["-v0", 0]

[time]
end = "12 ms"

[[probe]]
name = "front"
body = "left"
at = [-0.005, 0]
quantity = "velocity"

[[measure]]
name = "kinetic_ratio"
kind = "kinetic-ratio"

[[measure]]
name = "rebound"
kind = "rebound-speed"
body = "left"
"#;

/// A plate in a clamp, total Lagrangian, 2D, with everything left to the defaults that can be.
pub const PLATE: &str = r#"name = "plate"
dimension = 2
spacing = "H/10"

[parameters]
H = 0.02
L = 0.2

[material.soft]
model = "neo-hookean"
density = "1 g/cm^3"
bulk_modulus = 3e6
shear_modulus = 7e5

[region.strip]
shape = { box = { min = [-0.06, "-H/2"], max = ["L", "H/2"] } }

[region.block]
shape = { box = { min = [-0.068, "-H/2-0.008"], max = [0, "H/2+0.008"] } }

[[body]]
name = "plate"
material = "soft"
shape = { union = ["strip", "block"] }
velocity = [0, "if(x > 0, 2*sin(pi*x/(2*L)), 0)"]

[[boundary]]
region = "block"
except = "strip"
fixed = true

[[gravity]]
acceleration = [0, "-9.81 m/s^2"]

[time]
end = 0.3
step = "paper"

[[probe]]
name = "tip"
at = ["L", 0]

[[measure]]
name = "period"
probe = "tip"
component = "y"
kind = "second-crossing"
"#;

/// A column that is shaken, total Lagrangian, 3D.
pub const COLUMN: &str = r#"name = "column"
dimension = 3
formulation = "tl-nested"
spacing = "1/6"

[material.rubber]
model = "saint-venant-kirchhoff"
density = 1100
youngs_modulus = "17 MPa"
shear_modulus = "5.86 MPa"

[[body]]
name = "column"
material = "rubber"
shape.rotate.angle = "90 deg"
shape.rotate.axis = [0, 0, 2]
shape.rotate.shape.box = { min = [-0.5, -0.5, 0], max = [0.5, 0.5, 6] }
fill = { lattice = { origin = [-0.5, -0.5, 0] } }
velocity = ["10*sin(pi*z/12)", 0, 0]

[[boundary]]
region = { box = { min = [-1, -1, 0], max = [1, 1, 0.2] } }
displacement = ["0.1*sin(20*t)", "free", 0]

[time]
end = 3
cfl = 0.5
output = "50 ms"

[monitor]
zigzag = "1 %"
interval = 0.1

[[probe]]
name = "S"
at = [0.5, 0.5, 6]
quantity = "position"
interval = "1 ms"

[[measure]]
name = "low"
probe = "S"
component = "z"
kind = "turning-points"
extremum = "minimum"
prominence = 0.3
index = 1

[[measure]]
name = "late"
probe = "S"
component = "x"
kind = "value-at"
time = 1
"#;

/// A strip between tools that touch, turn and rub, total Lagrangian, 2D.
pub const PUNCH: &str = r#"name = "punch"
dimension = 2
spacing = "H/10"

[parameters]
H = "3 mm"

[material.rubber]
model = "neo-hookean"
density = 1100
youngs_modulus = "17 MPa"
poisson_ratio = 0.45

[[body]]
name = "strip"
material = "rubber"
shape = { box = { min = [0, 0], max = ["3*H", "H"] } }

[[body]]
name = "block"
material = "rubber"
shape = { box = { min = [0, "-H"], max = ["3*H", 0] } }
formulation = "tl-nested"

[[tool]]
name = "upper"
shape = { box = { min = [0, "H"], max = ["3*H", "1.3*H"] } }
displacement = [0, "-0.1*t"]

[[tool]]
name = "roller"
shape = { ball = { center = ["H", "-1.5*H"], radius = "H/2" } }
fill = "concentric"
velocity = [0, "10 mm/s"]
angle = "2*pi*t"
about = ["H", "-1.5*H"]

[[contact]]
bodies = ["strip", "upper"]
friction = 0.3

[[contact]]
bodies = ["block"]

[[contact]]
bodies = ["strip", "roller"]
ignore = true

[time]
end = "1 ms"

[[probe]]
name = "force"
quantity = "contact-force"
body = "upper"
by = "strip"

[[probe]]
name = "moment"
quantity = "contact-moment"
body = "roller"

[[measure]]
name = "most"
kind = "maximum"
probe = "moment"
component = "z"
over = "2 N m"

[[measure]]
name = "volume"
kind = "volume-ratio"
body = "strip"
"#;

/// The case of a text, without overrides.
pub fn parse(text: &str) -> Result<Case, CaseError> {
    Case::parse("case.toml", text, &Overrides::default())
}

/// The case of a text with `--set` arguments.
pub fn parse_set(text: &str, set: &[&str]) -> Result<Case, CaseError> {
    Case::parse("case.toml", text, &Overrides::set(set.iter().copied()))
}
