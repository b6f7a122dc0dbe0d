//! From tokens to a program, by precedence climbing.

use std::ops::Range;

use super::function::{self, Function, function};
use super::program::{Program, Step, Writer};
use super::token::{Operator, Token, tokens};
use super::{ExpressionError, Names};
use crate::diagnostic::did_you_mean;

/// Deepest nesting of parentheses, functions, signs and powers.
const DEEPEST: usize = 64;

/// How tightly a unary minus holds its operand: looser than `^`, tighter than `*`.
const UNARY: u8 = 7;

type Outcome = Result<(), ExpressionError>;

/// Compiles a text.
pub(super) fn parse(text: &str, names: &Names<'_>) -> Result<Program, ExpressionError> {
    let mut parser = Parser { tokens: tokens(text)?, at: 0, depth: 0, names, writer: Writer::default() };
    parser.expression(0)?;
    parser.end()?;
    parser.writer.finish().ok_or_else(|| too_deep(0..text.len()))
}

struct Parser<'a> {
    tokens: Vec<(Token<'a>, Range<usize>)>,
    at: usize,
    depth: usize,
    names: &'a Names<'a>,
    writer: Writer,
}

impl<'a> Parser<'a> {
    fn peek(&self) -> Token<'a> {
        self.tokens[self.at].0
    }

    fn span(&self) -> Range<usize> {
        self.tokens[self.at].1.clone()
    }

    /// The present token; moves on to the next (the last, `End`, is never left).
    fn take(&mut self) -> (Token<'a>, Range<usize>) {
        let taken = self.tokens[self.at].clone();
        self.at = (self.at + 1).min(self.tokens.len() - 1);
        taken
    }

    /// Operands and operators that hold at least as tightly as `least`.
    fn expression(&mut self, least: u8) -> Outcome {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(too_deep(self.span()));
        }
        self.operand()?;
        let mut compared = false;
        while let Token::Operator(operator) = self.peek() {
            let (left, right) = binding(operator);
            if left < least {
                break;
            }
            if compared && left == COMPARISON {
                let hint = "combine two comparisons: (a < b)*(b < c)";
                return Err(error(self.span(), "comparisons cannot be chained").with(hint));
            }
            compared = left == COMPARISON;
            self.take();
            self.expression(right)?;
            self.writer.push(Step::Two(meaning(operator)));
        }
        self.depth -= 1;
        Ok(())
    }

    /// A number, a name, a call, a group, or a sign with its operand.
    fn operand(&mut self) -> Outcome {
        let (token, span) = self.take();
        match token {
            Token::Number(value) => self.writer.push(Step::Constant(value)),
            Token::Name(name) if self.peek() == Token::Open => return self.call(name, span),
            Token::Name(name) => {
                let step = self.name(name, span)?;
                self.writer.push(step);
            }
            Token::Open => {
                self.expression(0)?;
                self.close(span)?;
            }
            Token::Operator(Operator::Subtract) => {
                self.expression(UNARY)?;
                self.writer.push(Step::One(|x| -x));
            }
            Token::Operator(Operator::Add) => self.expression(UNARY)?,
            Token::End if span.start == 0 => return Err(error(span, "the expression is empty")),
            Token::End => return Err(error(span, "the expression ends where a value is expected")),
            _ => return Err(error(span, "a value is expected here")),
        }
        Ok(())
    }

    /// What a name without parentheses stands for.
    fn name(&self, name: &str, span: Range<usize>) -> Result<Step, ExpressionError> {
        if let Some(variable) = self.names.variables.iter().position(|n| *n == name) {
            return Ok(Step::Variable(variable));
        }
        if let Some((_, value)) = self.names.constants.iter().find(|(n, _)| n == name) {
            return Ok(Step::Constant(*value));
        }
        if name == "pi" {
            return Ok(Step::Constant(std::f64::consts::PI));
        }
        if function(name).is_some() {
            let message = format!("`{name}` is a function and needs its argument");
            return Err(error(span, message).with(format!("write {name}(...)")));
        }
        let hint = match name {
            "e" => "Euler's number is written exp(1)".to_string(),
            _ => did_you_mean(name, self.known()),
        };
        Err(error(span, format!("unknown name `{name}`")).with(hint))
    }

    /// All names that may stand without parentheses.
    fn known(&self) -> impl Iterator<Item = &'a str> {
        let constants = self.names.constants.iter().map(|(name, _)| name.as_str());
        constants.chain(self.names.variables.iter().copied()).chain(["pi"])
    }

    /// A function with its arguments; the name is taken, the parenthesis is next.
    fn call(&mut self, name: &str, span: Range<usize>) -> Outcome {
        let Some(function) = function(name) else {
            return Err(self.not_a_function(name, span));
        };
        let count = self.arguments(function)?;
        let (wanted, step) = match function {
            Function::One(f) => (1, Step::One(f)),
            Function::Two(f) => (2, Step::Two(f)),
            Function::If => (3, Step::If),
            Function::Many(_) if count > 1 => return Ok(()),
            Function::Many(f) => (2, Step::Two(f)),
        };
        if count != wanted {
            let plural = if wanted == 1 { "" } else { "s" };
            return Err(error(span, format!("`{name}` takes {wanted} argument{plural}, found {count}")));
        }
        self.writer.push(step);
        Ok(())
    }

    /// The arguments in their parentheses, and how many they are; those of `Many` are joined at once.
    fn arguments(&mut self, function: Function) -> Result<usize, ExpressionError> {
        let (_, open) = self.take();
        let mut count = 0;
        loop {
            self.expression(0)?;
            count += 1;
            if let Function::Many(f) = function
                && count > 1
            {
                self.writer.push(Step::Two(f));
            }
            if self.peek() != Token::Comma {
                break;
            }
            self.take();
        }
        self.close(open)?;
        Ok(count)
    }

    fn not_a_function(&self, name: &str, span: Range<usize>) -> ExpressionError {
        let error = error(span, format!("unknown function `{name}`"));
        if self.known().any(|known| known == name) {
            return error.with(format!("`{name}` is a value; a product is written {name}*(...)"));
        }
        error.with(did_you_mean(name, function::names()))
    }

    /// The parenthesis that closes the one at `open`.
    fn close(&mut self, open: Range<usize>) -> Outcome {
        match self.peek() {
            Token::Close => {
                self.take();
                Ok(())
            }
            Token::End => Err(error(open, "this parenthesis is not closed")),
            _ => Err(self.no_operator()),
        }
    }

    fn end(&self) -> Outcome {
        if self.peek() == Token::End { Ok(()) } else { Err(self.no_operator()) }
    }

    /// A whole expression is read, and something else follows.
    fn no_operator(&self) -> ExpressionError {
        let span = self.span();
        match self.peek() {
            Token::Close => error(span, "this parenthesis closes nothing"),
            Token::Comma => error(span, "a comma outside of a function"),
            _ => error(span, "an operator is missing here").with(
                "a product is written with `*`; a number with a unit stands alone, as in \"9.81 m/s^2\"",
            ),
        }
    }
}

const COMPARISON: u8 = 1;

/// How tightly an operator holds what stands left and right of it.
fn binding(operator: Operator) -> (u8, u8) {
    match operator {
        Operator::Add | Operator::Subtract => (3, 4),
        Operator::Multiply | Operator::Divide => (5, 6),
        Operator::Power => (9, 8),
        _ => (COMPARISON, 2),
    }
}

/// What an operator does.
fn meaning(operator: Operator) -> fn(f64, f64) -> f64 {
    match operator {
        Operator::Add => |a, b| a + b,
        Operator::Subtract => |a, b| a - b,
        Operator::Multiply => |a, b| a * b,
        Operator::Divide => |a, b| a / b,
        Operator::Power => f64::powf,
        Operator::Less => |a, b| f64::from(a < b),
        Operator::LessEqual => |a, b| f64::from(a <= b),
        Operator::Greater => |a, b| f64::from(a > b),
        Operator::GreaterEqual => |a, b| f64::from(a >= b),
        Operator::Equal => |a, b| f64::from(a == b),
        Operator::NotEqual => |a, b| f64::from(a != b),
    }
}

fn too_deep(span: Range<usize>) -> ExpressionError {
    error(span, "the expression is nested too deeply").with("give a part of it a name in [parameters]")
}

fn error(span: Range<usize>, message: impl Into<String>) -> ExpressionError {
    ExpressionError { span, message: message.into(), hint: None }
}

impl ExpressionError {
    fn with(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}
