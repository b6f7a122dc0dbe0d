//! Cases that remember something.

/// What all cases share: everything that remembers something is in it.
const COMMON: &str = r#"
spacing = "1 mm"
[material.rubber]
model = "MODEL"
density = "1.1 g/cm^3"
youngs_modulus = "17 MPa"
poisson_ratio = 0.45
[time]
end = "0.1 ms"
output = "0.013 ms"
[monitor]
zigzag = 1e-9
interval = "0.007 ms"
[[gravity]]
acceleration = ["1e4*sin(1e5*t)", 0, 0]
[[probe]]
name = "tip"
body = "first"
at = [0.009, 0.004, 0]
[[probe]]
name = "slow"
body = "first"
at = [0.009, 0.004, 0]
quantity = "velocity"
interval = "0.009 ms"
[[measure]]
name = "tip_max"
probe = "tip"
component = "x"
kind = "maximum"
"#;

/// A block on a lattice that is pulled at one end.
pub const BLOCK: &str = r#"
[[body]]
name = "first"
material = "rubber"
shape = { box = { min = [0, 0, 0], max = ["10 mm", "8 mm", "6 mm"] } }
velocity = ["20*sin(300*x)", 0, 0]
[[boundary]]
region = { box = { min = [-1, -1, -1], max = ["1 mm", 1, 1] } }
velocity = ["-5*(1 - cos(1e5*t))", 0, 0]
[[boundary]]
region = { box = { min = ["9 mm", -1, -1], max = ["1 m", 1, 1] } }
displacement = ["free", "1e-4*sin(2e4*t)", 0]
name = "grip"
[[probe]]
name = "pull"
of = "grip"
quantity = "reaction"
"#;

/// Two bodies on no lattice that meet.
pub const ROUND: &str = r#"
[[body]]
name = "first"
material = "rubber"
shape = { SHAPE = { center = [0.005, 0.004, 0], radius = "5 mm" } }
fill = "concentric"
velocity = [20, 0, 0]
[[body]]
name = "second"
material = "rubber"
shape = { SHAPE = { center = [0.0175, 0.004, 0], radius = "5 mm" } }
fill = "concentric"
velocity = [-20, 5, 0]
"#;

/// A strip that is pulled from equilibrium to equilibrium.
pub const PULLED: &str = r#"
name = "case"
dimension = 2
formulation = "tl-nested"
spacing = "1 mm"
[material.rubber]
model = "neo-hookean"
density = "1.1 g/cm^3"
youngs_modulus = "17 MPa"
poisson_ratio = 0.45
[time]
end = "1 s"
[quasi_static]
increments = 8
tolerance = 0.02
[[body]]
name = "first"
material = "rubber"
shape = { box = { min = [0, 0], max = ["10 mm", "8 mm"] } }
[[boundary]]
region = { box = { min = [-1, -1], max = ["1 mm", 1] } }
displacement = [0, 0]
[[boundary]]
region = { box = { min = ["9 mm", -1], max = ["1 m", 1] } }
displacement = ["0.002*t", "free"]
name = "grip"
[[probe]]
name = "tip"
at = [0.009, 0.004]
[[probe]]
name = "pull"
of = "grip"
quantity = "reaction"
"#;

pub fn text(formulation: &str, dimension: usize, bodies: &str) -> String {
    let model = if formulation.starts_with("ul") { "linear-elastic" } else { "neo-hookean" };
    let head = format!("name = \"case\"\ndimension = {dimension}\nformulation = \"{formulation}\"\n");
    let text = format!("{head}{COMMON}{bodies}").replace("MODEL", model).replace("SHAPE", "ball");
    if dimension == 3 { text } else { flat(&text) }
}

/// Vectors of two components instead of three.
fn flat(text: &str) -> String {
    let line = |line: &str| {
        let mut out = String::new();
        for piece in line.split_inclusive(']') {
            let vector = piece.strip_suffix(']').and_then(|p| p.rsplit_once('[').map(|(_, inner)| inner));
            match vector {
                Some(inner) if inner.matches(',').count() == 2 => {
                    out += &piece[..piece.rfind(',').expect("a comma")];
                    out.push(']');
                }
                _ => out += piece,
            }
        }
        out + "\n"
    };
    text.lines().map(line).collect()
}
