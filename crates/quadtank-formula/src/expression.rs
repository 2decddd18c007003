use std::collections::HashMap;
use std::ops::Range;

use crate::delay::{delayed, transfer_function, zeros_poles_gain};
use crate::quotient::{MAX_EXPONENT, Quotient};
use crate::token::{Token, TokenKind};
use crate::value::{Square, Value};
use crate::{FormulaError, FormulaFault};

/// Most brackets in one another.
const MAX_DEPTH: usize = 40;

/// A value and where it was written.
#[derive(Clone, Debug)]
pub struct Written {
    pub value: Value,
    pub span: Range<usize>,
}

type Read = Result<Written, FormulaError>;

/// Reads expressions and computes them as it goes.
pub struct Reader<'a> {
    tokens: &'a [Token],
    at: usize,
    depth: usize,
    /// Length of the text, where it ends.
    end: usize,
    /// What names stand for.
    pub variables: HashMap<String, Value>,
    /// Elements that were assigned one by one, `G(1,2) = …`, by the name of their plant.
    pub placed: HashMap<String, Square<Option<Quotient>>>,
}

/// Whether blanks separate entries, as they do directly within the brackets of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blanks {
    Separate,
    MeanNothing,
}

impl<'a> Reader<'a> {
    pub fn new(tokens: &'a [Token], end: usize) -> Self {
        let variables = HashMap::from([("s".to_owned(), Value::Quotient(Quotient::s()))]);
        Self { tokens, at: 0, depth: 0, end, variables, placed: HashMap::new() }
    }

    pub fn peek(&self) -> Option<&'a Token> {
        self.tokens.get(self.at)
    }

    /// The token after the next one.
    pub fn second(&self) -> Option<&'a Token> {
        self.tokens.get(self.at + 1)
    }

    /// The next tokens.
    pub fn rest(&self) -> &'a [Token] {
        self.tokens.get(self.at..).unwrap_or_default()
    }

    pub fn advance(&mut self) {
        self.at += 1;
    }

    /// Whether the next token is that symbol.
    pub fn is_at(&self, symbol: char) -> bool {
        self.peek().is_some_and(|token| token.kind == TokenKind::Symbol(symbol))
    }

    /// Takes the symbol if it is the next token.
    fn takes(&mut self, symbol: char) -> bool {
        let found = self.is_at(symbol);
        self.at += usize::from(found);
        found
    }

    pub fn skip_newlines(&mut self) {
        while self.peek().is_some_and(|token| token.kind == TokenKind::Newline) {
            self.advance();
        }
    }

    /// What is wrong with the next token, which cannot stand there.
    pub fn unexpected(&self) -> FormulaError {
        let Some(token) = self.peek() else {
            return FormulaError::new(FormulaFault::UnexpectedEnd, self.end..self.end);
        };
        let found = match &token.kind {
            TokenKind::Number(number) => number.to_string(),
            TokenKind::Name(name) => name.clone(),
            TokenKind::Text(text) => text.clone(),
            TokenKind::Symbol(symbol) => symbol.to_string(),
            TokenKind::Newline => return FormulaError::new(FormulaFault::UnexpectedEnd, token.span.clone()),
        };
        FormulaError::new(FormulaFault::Unexpected { found }, token.span.clone())
    }

    fn expect(&mut self, symbol: char) -> Result<(), FormulaError> {
        if self.takes(symbol) { Ok(()) } else { Err(self.unexpected()) }
    }

    /// Computes `of` one bracket deeper.
    fn deeper(&mut self, of: impl FnOnce(&mut Self) -> Read) -> Read {
        if self.depth == MAX_DEPTH {
            let span = self.peek().map_or(self.end..self.end, |token| token.span.clone());
            return Err(FormulaError::new(FormulaFault::TooDeep { max: MAX_DEPTH }, span));
        }
        self.depth += 1;
        let read = of(self);
        self.depth -= 1;
        read
    }

    /// A sum of products.
    pub fn sum(&mut self, blanks: Blanks) -> Read {
        let mut total = self.product(blanks)?;
        while let Some(sign) = self.sign(blanks) {
            self.advance();
            let term = self.product(blanks)?;
            total = combine(&total, &term, |a, b| if sign == '-' { a.plus(&b.clone().negative()) } else { a.plus(b) })?;
        }
        Ok(total)
    }

    /// The sign that continues a sum. In a list `1 -2` are two entries, `1 - 2` and `1-2` are one.
    fn sign(&self, blanks: Blanks) -> Option<char> {
        let token = self.peek()?;
        let TokenKind::Symbol(sign @ ('+' | '-')) = token.kind else { return None };
        let begins_entry =
            blanks == Blanks::Separate && token.after_blank && self.second().is_some_and(|next| !next.after_blank);
        (!begins_entry).then_some(sign)
    }

    /// Factors with `*`, `/` or nothing between them.
    fn product(&mut self, blanks: Blanks) -> Read {
        let mut total = self.factor(blanks)?;
        loop {
            if self.takes('*') {
                let factor = self.factor(blanks)?;
                total = combine(&total, &factor, Quotient::times)?;
            } else if self.takes('/') {
                let factor = self.factor(blanks)?;
                total = combine(&total, &factor, Quotient::over)?;
            } else if self.is_at_factor(blanks) {
                let factor = self.power(blanks)?;
                total = combine(&total, &factor, Quotient::times)?;
            } else {
                return Ok(total);
            }
        }
    }

    /// Whether a factor follows without a sign.
    fn is_at_factor(&self, blanks: Blanks) -> bool {
        self.peek().is_some_and(|token| {
            let begins_entry = blanks == Blanks::Separate && token.after_blank;
            let begins_factor =
                matches!(token.kind, TokenKind::Number(_) | TokenKind::Name(_) | TokenKind::Symbol('('));
            begins_factor && !begins_entry
        })
    }

    /// A power with its signs, which bind less: −s² is −(s²).
    fn factor(&mut self, blanks: Blanks) -> Read {
        let start = self.peek().map_or(self.end, |token| token.span.start);
        if self.takes('-') {
            let Written { value, span } = self.deeper(|reader| reader.factor(blanks))?;
            let span = start..span.end;
            let quotient = value.quotient().map_err(|fault| FormulaError::new(fault, span.clone()))?;
            return Ok(Written { value: Value::Quotient(quotient.clone().negative()), span });
        }
        if self.takes('+') {
            return self.deeper(|reader| reader.factor(blanks));
        }
        self.power(blanks)
    }

    fn power(&mut self, blanks: Blanks) -> Read {
        let base = self.atom()?;
        if !self.takes('^') {
            return Ok(base);
        }
        let exponent = self.exponent(blanks)?;
        combine(&base, &exponent, |base, exponent| {
            base.power(exponent.as_number().ok_or(FormulaFault::Exponent { max: MAX_EXPONENT })?)
        })
    }

    /// What stands behind `^`: one atom, perhaps with a sign.
    fn exponent(&mut self, blanks: Blanks) -> Read {
        if self.is_at('-') || self.is_at('+') { self.factor(blanks) } else { self.atom() }
    }

    fn atom(&mut self) -> Read {
        let Some(token) = self.peek() else { return Err(self.unexpected()) };
        let span = token.span.clone();
        match &token.kind {
            TokenKind::Number(number) => {
                self.advance();
                Ok(Written { value: Value::Quotient(Quotient::number(*number)), span })
            }
            TokenKind::Text(text) => {
                self.advance();
                Ok(Written { value: Value::Text(text.clone()), span })
            }
            TokenKind::Name(name) => self.named(name, span),
            TokenKind::Symbol('(') => self.deeper(|reader| {
                reader.advance();
                reader.skip_newlines();
                let inside = reader.sum(Blanks::MeanNothing)?;
                reader.skip_newlines();
                let end = reader.peek().map_or(reader.end, |token| token.span.end);
                reader.expect(')')?;
                Ok(Written { value: inside.value, span: span.start..end })
            }),
            TokenKind::Symbol('[') => self.deeper(Self::list),
            TokenKind::Symbol(_) | TokenKind::Newline => Err(self.unexpected()),
        }
    }

    /// A variable, a function with its arguments, or e to a power.
    fn named(&mut self, name: &str, span: Range<usize>) -> Read {
        self.advance();
        if let Some(value) = self.variables.get(name) {
            return Ok(Written { value: value.clone(), span });
        }
        // Modules of Python stand before the name: `ct.tf`, `np.exp`, `ct.TransferFunction.s`.
        let own = name.rsplit('.').next().unwrap_or(name);
        let unknown = || FormulaError::new(FormulaFault::UnknownName { name: name.to_owned() }, span.clone());
        match own {
            "s" => Ok(Written { value: Value::Quotient(Quotient::s()), span }),
            "e" if self.takes('^') => {
                let exponent = self.exponent(Blanks::MeanNothing)?;
                apply(&exponent, span.start..exponent.span.end, |value| {
                    value.quotient()?.exponential().map(Value::Quotient)
                })
            }
            "exp" | "tf" | "zpk" | "TransferFunction" | "array" | "matrix" | "combine_tf" if self.is_at('(') => {
                let (arguments, end) = self.arguments()?;
                let whole = span.start..end;
                call(own, &arguments, whole)
            }
            "i" | "j" => Err(FormulaError::new(FormulaFault::ImaginaryUnit { name: own.to_owned() }, span.clone())),
            _ => Err(unknown()),
        }
    }

    /// What is written further on but is no transfer function: a call of a name that says so.
    pub fn check_calls(&self) -> Result<(), FormulaError> {
        let calls = self.tokens.windows(2).filter(|pair| pair[1].kind == TokenKind::Symbol('('));
        let fault = |token: &Token| match &token.kind {
            TokenKind::Name(name) => match name.rsplit('.').next() {
                Some("pade") => Some(FormulaFault::PadeApproximation),
                Some("ss" | "StateSpace") => Some(FormulaFault::StateSpaceModel),
                _ => None,
            },
            _ => None,
        };
        let mut refused = calls.filter_map(|pair| Some(FormulaError::new(fault(&pair[0])?, pair[0].span.clone())));
        refused.next().map_or(Ok(()), Err)
    }

    /// Arguments in parentheses, and where these end.
    fn arguments(&mut self) -> Result<(Vec<Written>, usize), FormulaError> {
        self.expect('(')?;
        let mut arguments = Vec::new();
        loop {
            self.skip_newlines();
            let end = self.peek().map_or(self.end, |token| token.span.end);
            if self.takes(')') {
                return Ok((arguments, end));
            }
            if !arguments.is_empty() {
                self.expect(',')?;
                self.skip_newlines();
            }
            arguments.push(self.deeper(|reader| reader.sum(Blanks::MeanNothing))?);
        }
    }

    /// A list in brackets. Rows end with a semicolon, or with a line that does not end with a comma.
    fn list(&mut self) -> Read {
        let start = self.peek().map_or(self.end, |token| token.span.start);
        self.expect('[')?;
        let mut rows = vec![Vec::new()];
        let mut after_comma = false;
        loop {
            let Some(token) = self.peek() else { return Err(self.unexpected()) };
            let is_empty = rows.last().is_none_or(Vec::is_empty);
            match token.kind {
                TokenKind::Symbol(']') => break,
                TokenKind::Symbol(',') if !is_empty && !after_comma => after_comma = true,
                TokenKind::Symbol(';') | TokenKind::Newline => {
                    if !is_empty && !after_comma {
                        rows.push(Vec::new());
                    }
                }
                _ => {
                    let entry = self.sum(Blanks::Separate)?;
                    rows.last_mut().into_iter().for_each(|row| row.push(entry.value.clone()));
                    after_comma = false;
                    continue;
                }
            }
            self.advance();
        }
        let end = self.peek().map_or(self.end, |token| token.span.end);
        self.advance();
        rows.retain(|row| !row.is_empty());
        Ok(Written { value: Value::List(rows), span: start..end })
    }
}

/// Two elements as one.
fn combine(
    a: &Written,
    b: &Written,
    operation: impl FnOnce(&Quotient, &Quotient) -> Result<Quotient, FormulaFault>,
) -> Read {
    let quotient = |of: &Written| match of.value.quotient() {
        Ok(quotient) => Ok(quotient.clone()),
        Err(fault) => Err(FormulaError::new(fault, of.span.clone())),
    };
    let span = a.span.start..b.span.end;
    match operation(&quotient(a)?, &quotient(b)?) {
        Ok(quotient) => Ok(Written { value: Value::Quotient(quotient), span }),
        Err(fault) => Err(FormulaError::new(fault, span)),
    }
}

/// A function of one argument; faults are about the argument.
fn apply(argument: &Written, span: Range<usize>, of: impl FnOnce(&Value) -> Result<Value, FormulaFault>) -> Read {
    match of(&argument.value) {
        Ok(value) => Ok(Written { value, span }),
        Err(fault) => Err(FormulaError::new(fault, argument.span.clone())),
    }
}

/// An element or a plant with the delays that follow as names and values.
fn with_options(mut value: Value, options: &[Written], span: Range<usize>) -> Read {
    for option in options.chunks(2) {
        // Another number would be a sampling time.
        let [Written { value: Value::Text(property), span: name }, delay] = option else {
            let found = "…".to_owned();
            return Err(FormulaError::new(FormulaFault::Unexpected { found }, option[0].span.clone()));
        };
        let place = name.start..delay.span.end;
        value = delayed(&value, property, &delay.value).map_err(|fault| FormulaError::new(fault, place))?;
    }
    Ok(Written { value, span })
}

fn call(name: &str, arguments: &[Written], span: Range<usize>) -> Read {
    let at = |fault: FormulaFault| FormulaError::new(fault, span.clone());
    match (name, arguments) {
        ("exp", [argument]) => apply(argument, span, |value| value.quotient()?.exponential().map(Value::Quotient)),
        ("array" | "matrix" | "combine_tf", [argument]) => Ok(Written { value: argument.value.clone(), span }),
        ("zpk", [Written { value: Value::Text(text), .. }]) if text == "s" => {
            Ok(Written { value: Value::Quotient(Quotient::s()), span })
        }
        ("zpk", [zeros, poles, gain, options @ ..]) => {
            let value = zeros_poles_gain(&zeros.value, &poles.value, &gain.value).map_err(at)?;
            with_options(value, options, span)
        }
        ("tf" | "TransferFunction", [argument]) => apply(argument, span, |value| match value {
            Value::Text(text) if text == "s" => Ok(Value::Quotient(Quotient::s())),
            other => Ok(Value::Quotient(other.quotient()?.clone())),
        }),
        ("tf" | "TransferFunction", [numerator, denominator, options @ ..]) => {
            let value = transfer_function(&numerator.value, &denominator.value).map_err(at)?;
            with_options(value, options, span)
        }
        _ => Err(at(FormulaFault::Unexpected { found: format!("{name}(…)") })),
    }
}
