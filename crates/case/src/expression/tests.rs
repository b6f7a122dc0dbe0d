use super::*;

fn value(text: &str) -> f64 {
    Expression::parse(text, &Names::default()).expect(text).eval(&[])
}

fn constants(list: &[(&str, f64)]) -> Vec<(String, f64)> {
    list.iter().map(|(name, value)| (name.to_string(), *value)).collect()
}

#[test]
fn operators_bind_as_in_mathematics() {
    let rows = [
        ("-2^2", -4.0),
        ("2^3^2", 512.0),
        ("2^-1", 0.5),
        ("2^-1*4", 2.0),
        ("(-2)^2", 4.0),
        ("1-2-3", -4.0),
        ("8/4/2", 1.0),
        ("1+2*3", 7.0),
        ("2*3^2", 18.0),
        ("-2*3", -6.0),
        ("--3", 3.0),
        ("+3", 3.0),
        ("2 - -3", 5.0),
        ("1 < 2", 1.0),
        ("1 + 1 <= 2*1", 1.0),
        ("3 > 4", 0.0),
        ("2 >= 2", 1.0),
        ("2 == 2", 1.0),
        ("2 != 2", 0.0),
        ("(1 < 2)*(2 < 3)", 1.0),
        ("1e3", 1000.0),
        (".5", 0.5),
        ("5.", 5.0),
        ("1.5e-3", 0.0015),
        ("2 *\t3\n", 6.0),
    ];
    for (text, expected) in rows {
        assert_eq!(value(text), expected, "{text}");
    }
}

#[test]
fn functions_are_those_of_rust() {
    let rows: [(&str, f64); 28] = [
        ("sin(0.3)", 0.3f64.sin()),
        ("cos(0.3)", 0.3f64.cos()),
        ("tan(0.3)", 0.3f64.tan()),
        ("asin(0.3)", 0.3f64.asin()),
        ("acos(0.3)", 0.3f64.acos()),
        ("atan(0.3)", 0.3f64.atan()),
        ("atan2(1, -2)", 1f64.atan2(-2.0)),
        ("sinh(0.3)", 0.3f64.sinh()),
        ("cosh(0.3)", 0.3f64.cosh()),
        ("tanh(0.3)", 0.3f64.tanh()),
        ("exp(1)", 1f64.exp()),
        ("ln(2)", 2f64.ln()),
        ("log10(1000)", 1000f64.log10()),
        ("sqrt(2)", 2f64.sqrt()),
        ("abs(-2)", 2.0),
        ("min(3, 1, 2)", 1.0),
        ("max(3, 1, 7, 2)", 7.0),
        ("floor(-1.5)", -2.0),
        ("ceil(-1.5)", -1.0),
        ("round(2.5)", 3.0),
        ("sign(-7)", -1.0),
        ("sign(0)", 0.0),
        ("hypot(3, 4)", 5.0),
        ("mod(-1, 3)", 2.0),
        ("mod(7, 3)", 1.0),
        ("if(1 > 2, 10, 20)", 20.0),
        ("if(1 < 2, 10, 20)", 10.0),
        ("2*pi", std::f64::consts::TAU),
    ];
    for (text, expected) in rows {
        assert_eq!(value(text), expected, "{text}");
    }
}

#[test]
fn an_expression_gives_what_the_closure_gives() {
    let known = constants(&[("L", 0.2), ("v", 3.0)]);
    let names = Names { variables: &["x", "y", "t"], constants: &known };
    let text = "if(x > 0, v*sin(pi*x/L)*exp(-y^2) + 2^x - 1/(1 + t), -t)";
    let expression = Expression::parse(text, &names).expect("right");
    let closure = |x: f64, y: f64, t: f64| {
        let pi = std::f64::consts::PI;
        if x > 0.0 {
            3.0 * (pi * x / 0.2).sin() * (-y.powf(2.0)).exp() + 2f64.powf(x) - 1.0 / (1.0 + t)
        } else {
            -t
        }
    };
    for i in 0..200 {
        let (x, y, t) = (0.01 * f64::from(i) - 1.0, 0.02 * f64::from(i), f64::from(i));
        // The same operations in the same order: equal to the last bit.
        assert_eq!(expression.eval(&[x, y, t]), closure(x, y, t), "{x} {y} {t}");
    }
    assert!(expression.uses(0) && expression.uses(1) && expression.uses(2));
}

#[test]
fn constants_are_folded_and_known_as_such() {
    let known = constants(&[("a", 2.0)]);
    let names = Names { variables: &["x"], constants: &known };
    let parse = |text| Expression::parse(text, &names).expect(text);
    assert_eq!(parse("if(a > 1, sqrt(a*8), 0)").as_constant(), Some(4.0));
    assert_eq!(parse("x - x").as_constant(), None);
    assert!(!parse("a + 1").uses(0));
    assert_eq!(Expression::constant(3.0).eval(&[]), 3.0);
}

#[test]
fn mistakes_are_pointed_at() {
    let known = constants(&[("resolution", 10.0), ("e", 1.0)]);
    let names = Names { variables: &["x"], constants: &known };
    let rows = [
        ("2*resolutoin", 2..12, "unknown name `resolutoin`", "`resolution`"),
        ("sine(x)", 0..4, "unknown function `sine`", "`sin`"),
        ("2 x", 2..3, "an operator is missing", "`*`"),
        ("x(3)", 0..1, "unknown function `x`", "x*(...)"),
        ("sin", 0..3, "needs its argument", "sin(...)"),
        ("(1 + 2", 0..1, "not closed", ""),
        ("1 + 2)", 5..6, "closes nothing", ""),
        ("1 +", 3..3, "ends where a value", ""),
        ("", 0..0, "empty", ""),
        ("*2", 0..1, "a value is expected", ""),
        ("atan2(1)", 0..5, "takes 2 arguments, found 1", ""),
        ("min(1)", 0..3, "takes 2 arguments, found 1", ""),
        ("sin(1, 2)", 0..3, "takes 1 argument, found 2", ""),
        ("if(1, 2)", 0..2, "takes 3 arguments, found 2", ""),
        ("x = 2", 2..3, "unexpected `=`", "`==`"),
        ("x**2", 1..2, "unexpected `**`", "x^2"),
        ("1 < x < 2", 6..7, "cannot be chained", "(a < b)*(b < c)"),
        ("1, 2", 1..2, "a comma outside", ""),
        ("\u{3b1} + 1", 0..2, "unknown name", ""),
        ("1e999", 0..1, "not a number", ""),
        (".", 0..1, "not a number", ""),
    ];
    for (text, span, message, hint) in rows {
        let error = Expression::parse(text, &names).expect_err(text);
        assert_eq!(error.span, span, "{text}: {error}");
        assert!(error.message.contains(message), "{text}: {error}");
        assert!(error.hint.as_deref().unwrap_or("").contains(hint), "{text}: {:?}", error.hint);
    }
    let euler = Expression::parse("e^2", &Names::default()).expect_err("no e");
    assert!(euler.hint.is_some_and(|hint| hint.contains("exp(1)")));
}

#[test]
fn deep_nesting_is_refused_and_long_chains_are_not() {
    for text in ["(".repeat(100_000), "-".repeat(100_000) + "1", "2^".repeat(1000) + "2", "sin(".repeat(500)]
    {
        let error = Expression::parse(&text, &Names::default()).expect_err("too deep");
        assert!(error.message.contains("nested too deeply"), "{error}");
    }
    // A right-leaning sum holds two values per level: the stack, not the nesting, runs out.
    let names = Names { variables: &["x"], constants: &[] };
    let leaning = "(x+".repeat(50) + "x" + &")".repeat(50);
    assert!(Expression::parse(&leaning, &names).is_err());
    assert_eq!(value(&("1".to_string() + &"+1".repeat(100_000))), 100_001.0);
}

#[test]
fn expressions_can_be_shared_between_threads() {
    fn shared<T: Send + Sync + Clone>() {}
    shared::<Expression>();
}
