use std::ops::Range;

use crate::{FormulaError, FormulaFault};

/// What a text consists of.
#[derive(Clone, Debug, PartialEq)]
pub enum TokenKind {
    Number(f64),
    /// A name, with the points in it: `ct.tf`, `G.InputDelay`.
    Name(String),
    /// A quoted text.
    Text(String),
    /// One of `+ - * / ^ ( ) [ ] , ; =`; braces are brackets, as cells of MATLAB are lists.
    Symbol(char),
    Newline,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Token {
    pub kind: TokenKind,
    /// Where it stands (bytes).
    pub span: Range<usize>,
    /// Whether a blank precedes it, which separates the entries of lists.
    pub after_blank: bool,
}

/// Where a comma between digits is a decimal sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DecimalComma {
    /// Outside lists.
    OutsideLists,
    /// Nowhere.
    Nowhere,
}

/// Splits a text. Comments of MATLAB and Python and continued lines are left out.
pub fn tokens(text: &str, comma: DecimalComma) -> Result<Vec<Token>, FormulaError> {
    let mut lexer = Lexer { text, at: 0, brackets: 0, comma };
    let mut found = Vec::new();
    while let Some(token) = lexer.next()? {
        found.push(token);
    }
    Ok(found)
}

struct Lexer<'a> {
    text: &'a str,
    at: usize,
    /// Open square brackets and braces.
    brackets: usize,
    comma: DecimalComma,
}

impl Lexer<'_> {
    fn rest(&self) -> &str {
        &self.text[self.at..]
    }

    fn next(&mut self) -> Result<Option<Token>, FormulaError> {
        let before = self.at;
        self.skip_blanks();
        let after_blank = self.at > before;
        let start = self.at;
        let Some(first) = self.rest().chars().next() else { return Ok(None) };
        let kind = match first {
            '0'..='9' => self.number()?,
            '.' if self.digit_at(1) => self.number()?,
            '\'' | '"' => self.quotation(first)?,
            _ if first.is_alphabetic() || first == '_' => self.name(),
            _ => self.symbol(first)?,
        };
        Ok(Some(Token { kind, span: start..self.at, after_blank }))
    }

    /// Skips blanks, comments and the ends of lines that are continued.
    fn skip_blanks(&mut self) {
        loop {
            let rest = self.rest();
            let trimmed = rest.trim_start_matches(|c: char| c.is_whitespace() && c != '\n');
            let is_comment = trimmed.starts_with(['%', '#']);
            let is_continued =
                trimmed.starts_with("...") || trimmed.starts_with("\\\n") || trimmed.starts_with("\\\r\n");
            let skipped = rest.len() - trimmed.len();
            if !(is_comment || is_continued) {
                self.at += skipped;
                return;
            }
            let line = trimmed.find('\n').unwrap_or(trimmed.len());
            self.at += skipped + (line + usize::from(is_continued)).min(trimmed.len());
        }
    }

    fn digit_at(&self, offset: usize) -> bool {
        self.rest().as_bytes().get(offset).is_some_and(u8::is_ascii_digit)
    }

    fn number(&mut self) -> Result<TokenKind, FormulaError> {
        let start = self.at;
        self.digits();
        let is_comma = self.comma == DecimalComma::OutsideLists && self.brackets == 0;
        let is_sign = self.rest().starts_with('.') || (is_comma && self.rest().starts_with(',') && self.digit_at(1));
        // Two points begin a continued line.
        if is_sign && !self.rest().starts_with("..") {
            self.at += 1;
            self.digits();
        }
        // An e is an exponent where digits follow; in `2 e^(-s)` it is a name.
        if self.rest().starts_with(['e', 'E']) {
            let signed = usize::from(self.rest()[1..].starts_with(['+', '-']));
            if self.digit_at(1 + signed) {
                self.at += 1 + signed;
                self.digits();
            }
        }
        let span = start..self.at;
        let value = self.text[span.clone()].replace(',', ".").parse::<f64>();
        match value {
            Ok(value) if value.is_finite() => Ok(TokenKind::Number(value)),
            _ => Err(FormulaError::new(FormulaFault::NotFinite, span)),
        }
    }

    fn digits(&mut self) {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    }

    fn quotation(&mut self, quote: char) -> Result<TokenKind, FormulaError> {
        let start = self.at;
        let inside = &self.rest()[1..];
        match inside.find([quote, '\n']).filter(|&end| inside[end..].starts_with(quote)) {
            Some(end) => {
                let text = inside[..end].to_owned();
                self.at += end + 2;
                Ok(TokenKind::Text(text))
            }
            None => Err(FormulaError::new(FormulaFault::OpenQuotation, start..start + 1)),
        }
    }

    fn name(&mut self) -> TokenKind {
        let rest = self.rest();
        let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
        let name = &rest[..rest.find(|c| !is_part(c)).unwrap_or(rest.len())];
        let name = name.trim_end_matches('.').to_owned();
        self.at += name.len();
        TokenKind::Name(name)
    }

    fn symbol(&mut self, first: char) -> Result<TokenKind, FormulaError> {
        let start = self.at;
        self.at += first.len_utf8();
        let symbol = match first {
            '\n' => return Ok(TokenKind::Newline),
            '−' => '-',
            '·' | '×' => '*',
            '*' if self.rest().starts_with('*') => {
                self.at += 1;
                '^'
            }
            '[' | '{' => {
                self.brackets += 1;
                '['
            }
            ']' | '}' => {
                self.brackets = self.brackets.saturating_sub(1);
                ']'
            }
            '+' | '-' | '*' | '/' | '^' | '(' | ')' | ',' | ';' | '=' => first,
            _ => return Err(FormulaError::new(FormulaFault::Unexpected { found: first.to_string() }, start..self.at)),
        };
        Ok(TokenKind::Symbol(symbol))
    }
}
