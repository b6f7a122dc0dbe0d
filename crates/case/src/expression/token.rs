//! Cutting the text of an expression into tokens.

use std::ops::Range;

use super::ExpressionError;

/// A piece of an expression.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Token<'a> {
    Number(f64),
    Name(&'a str),
    Operator(Operator),
    Open,
    Close,
    Comma,
    End,
}

/// What stands between two operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Operator {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
}

const TWO_LETTERS: &[(&str, Operator)] = &[
    ("<=", Operator::LessEqual),
    (">=", Operator::GreaterEqual),
    ("==", Operator::Equal),
    ("!=", Operator::NotEqual),
];

/// All tokens with their bytes; the last is `End`.
pub(super) fn tokens(text: &str) -> Result<Vec<(Token<'_>, Range<usize>)>, ExpressionError> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(first) = text[at..].chars().next() {
        if first.is_whitespace() {
            at += first.len_utf8();
            continue;
        }
        let (token, length) = token(&text[at..], first).map_err(|(message, hint)| ExpressionError {
            span: at..at + first.len_utf8(),
            message,
            hint: hint.map(str::to_string),
        })?;
        found.push((token, at..at + length));
        at += length;
    }
    found.push((Token::End, text.len()..text.len()));
    Ok(found)
}

type Refusal = (String, Option<&'static str>);

/// The token that the text begins with, and its length.
fn token(text: &str, first: char) -> Result<(Token<'_>, usize), Refusal> {
    if first.is_ascii_digit() || first == '.' {
        return number(text);
    }
    if first.is_alphabetic() || first == '_' {
        let length = text.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(text.len());
        return Ok((Token::Name(&text[..length]), length));
    }
    if let Some((_, operator)) = TWO_LETTERS.iter().find(|(letters, _)| text.starts_with(letters)) {
        return Ok((Token::Operator(*operator), 2));
    }
    if text.starts_with("**") {
        return Err(("unexpected `**`".to_string(), Some("powers are written x^2")));
    }
    let token = match first {
        '+' => Token::Operator(Operator::Add),
        '-' => Token::Operator(Operator::Subtract),
        '*' => Token::Operator(Operator::Multiply),
        '/' => Token::Operator(Operator::Divide),
        '^' => Token::Operator(Operator::Power),
        '<' => Token::Operator(Operator::Less),
        '>' => Token::Operator(Operator::Greater),
        '(' => Token::Open,
        ')' => Token::Close,
        ',' => Token::Comma,
        _ => return Err((format!("unexpected `{first}`"), advice(first))),
    };
    Ok((token, 1))
}

fn advice(first: char) -> Option<&'static str> {
    match first {
        '=' => Some("equality is tested by `==`"),
        '&' => Some("multiply two comparisons: (x > 0)*(x < 1)"),
        '|' => Some("take the larger of two comparisons: max(x < 0, x > 1)"),
        '?' | '!' => Some("choose by if(condition, then, else)"),
        '[' | '{' => Some("group with round parentheses"),
        _ => None,
    }
}

/// Digits, a point, an exponent.
fn number(text: &str) -> Result<(Token<'_>, usize), Refusal> {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let mut length = digits(0);
    if bytes.get(length) == Some(&b'.') {
        length += 1 + digits(length + 1);
    }
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        let start = length + 1 + sign;
        let count = if start <= bytes.len() { digits(start) } else { 0 };
        if count > 0 {
            length = start + count;
        }
    }
    let wrong = || (format!("`{}` is not a number", &text[..length]), None);
    let value: f64 = text[..length].parse().map_err(|_| wrong())?;
    if value.is_finite() { Ok((Token::Number(value), length)) } else { Err(wrong()) }
}
