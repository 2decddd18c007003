//! Formulas in the texts of lessons: a few commands of TeX, read into a tree that the page shows as `MathML`.

/// A part of a formula.
#[derive(Clone, Debug, PartialEq)]
pub enum Formula {
    /// Parts side by side.
    Row(Vec<Formula>),
    /// A symbol, set in italics.
    Symbol(String),
    /// A number.
    Number(String),
    /// A sign of operation, relation or bracket.
    Sign(String),
    /// Words.
    Words(String),
    /// A live value: name of the quantity and unit.
    Value(String, String),
    /// A fraction.
    Fraction(Box<[Formula; 2]>),
    /// A square root.
    Root(Box<Formula>),
    /// What has something below and above to its right.
    Scripts {
        /// The part itself.
        base: Box<Formula>,
        /// Below.
        below: Option<Box<Formula>>,
        /// Above.
        above: Option<Box<Formula>>,
    },
}

/// Formulas by name, as lessons write them.
pub const NAMED_FORMULAS: [(&str, &str); 17] = [
    ("zero-line", r"γ_1 + γ_2 = 1"),
    ("zeros", r"(1 + s T_3)(1 + s T_4) = \frac{(1 - γ_1)(1 - γ_2)}{γ_1 γ_2}"),
    ("relative-gain", r"λ_{11} = \frac{γ_1 γ_2}{γ_1 + γ_2 - 1}"),
    ("determinant", r"\text{det} G(0) = \frac{c_1 c_2}{k_1^2} (γ_1 + γ_2 - 1)"),
    ("niederlinski", r"N = \frac{\text{det} G(0)}{g_{11}(0) g_{22}(0)} > 0"),
    ("interpolation", r"∫_0^∞ η^T e(t) e^{-zt} dt = \frac{η^T r}{z}"),
    ("sensitivity-peak", r"M_s = \text{max}_ω \text{σ̄} (I + L(jω))^{-1}"),
    ("time-constant", r"T_j = \frac{A_j}{a_j} \sqrt{\frac{2 h_j}{g}}"),
    ("anti-windup", r"\frac{dI}{dt} = \frac{K}{T_i} e + \frac{1}{T_t} (\text{sat}(u) - u)"),
    ("describing-function", r"K_u ≈ \frac{4 d}{π a}"),
    ("critical", r"\text{det} (I + G(jω) K) = 0"),
    ("ultra-local", r"\frac{dh}{dt} = φ + α̂ v"),
    ("zero-dynamics", r"x(t) = x_0 e^{zt}"),
    ("simc-integrating", r"K_p = \frac{1}{k' (τ_c + θ)},  T_i = 4 (τ_c + θ)"),
    ("lambda-integrating", r"K_p = \frac{2 λ + θ}{k' (λ + θ)^2},  T_i = 2 λ + θ"),
    ("variance-index", r"I = \frac{σ_{\text{ref}}^2}{σ^2}"),
    ("arrest", r"T_i = 4 \frac{τ}{K K_p}"),
];

/// The formula with a name.
pub fn named_formula(name: &str) -> Option<Formula> {
    NAMED_FORMULAS.iter().find(|(known, _)| *known == name).and_then(|(_, source)| parse_formula(source))
}

/// Reads a formula; `None` where it is not one.
pub fn parse_formula(source: &str) -> Option<Formula> {
    let mut reader = Reader { rest: source, depth: 0 };
    let row = reader.row()?;
    reader.rest.is_empty().then_some(row)
}

/// Deepest nesting that is read.
const DEEPEST: usize = 12;

struct Reader<'a> {
    rest: &'a str,
    depth: usize,
}

impl Reader<'_> {
    /// Parts up to the end or to a closing brace, which stays.
    fn row(&mut self) -> Option<Formula> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return None;
        }
        let mut parts = Vec::new();
        loop {
            self.skip_spaces();
            if self.rest.is_empty() || self.rest.starts_with('}') {
                break;
            }
            parts.push(self.scripted()?);
        }
        self.depth -= 1;
        match parts.len() {
            1 => parts.pop(),
            _ => Some(Formula::Row(parts)),
        }
    }

    /// A part with what stands below and above it.
    fn scripted(&mut self) -> Option<Formula> {
        let base = self.part()?;
        let (mut below, mut above) = (None, None);
        loop {
            let place = match self.rest.chars().next() {
                Some('_') => &mut below,
                Some('^') => &mut above,
                _ => break,
            };
            if place.is_some() {
                return None;
            }
            self.rest = &self.rest[1..];
            *place = Some(Box::new(self.script()?));
        }
        match (&below, &above) {
            (None, None) => Some(base),
            _ => Some(Formula::Scripts { base: Box::new(base), below, above }),
        }
    }

    /// What follows `_` or `^`: a group or one character.
    fn script(&mut self) -> Option<Formula> {
        if self.rest.starts_with('{') { self.group() } else { self.character() }
    }

    fn part(&mut self) -> Option<Formula> {
        match self.rest.chars().next()? {
            '{' => self.group(),
            '\\' => self.command(),
            c if c.is_ascii_digit() => Some(self.number()),
            _ => self.character(),
        }
    }

    fn group(&mut self) -> Option<Formula> {
        self.rest = self.rest.strip_prefix('{')?;
        let inside = self.row()?;
        self.rest = self.rest.strip_prefix('}')?;
        Some(inside)
    }

    fn command(&mut self) -> Option<Formula> {
        let name: String = self.rest[1..].chars().take_while(char::is_ascii_alphabetic).collect();
        self.rest = &self.rest[1 + name.len()..];
        match name.as_str() {
            "frac" => Some(Formula::Fraction(Box::new([self.group()?, self.group()?]))),
            "sqrt" => Some(Formula::Root(Box::new(self.group()?))),
            "text" => Some(Formula::Words(self.words()?)),
            "value" => Some(Formula::Value(self.words()?, self.words()?)),
            _ => None,
        }
    }

    /// The text of a group, as it is.
    fn words(&mut self) -> Option<String> {
        let (inside, rest) = self.rest.strip_prefix('{')?.split_once('}')?;
        self.rest = rest;
        Some(inside.to_owned())
    }

    fn number(&mut self) -> Formula {
        let mut end = self.rest.len();
        for (at, c) in self.rest.char_indices() {
            let is_point = c == '.' && self.rest[at + 1..].starts_with(|next: char| next.is_ascii_digit());
            if !(c.is_ascii_digit() || is_point) {
                end = at;
                break;
            }
        }
        let (number, rest) = self.rest.split_at(end);
        self.rest = rest;
        Formula::Number(number.to_owned())
    }

    fn character(&mut self) -> Option<Formula> {
        let first = self.rest.chars().next()?;
        // A mark above a letter (φ̂) is a character of its own in Unicode.
        let marked = |c: &char| ('\u{300}'..='\u{36f}').contains(c);
        let text: String = std::iter::once(first).chain(self.rest.chars().skip(1).take_while(marked)).collect();
        self.rest = &self.rest[text.len()..];
        match first {
            '\\' | '{' | '}' | '_' | '^' => None,
            c if c.is_alphabetic() => Some(Formula::Symbol(text)),
            c if c.is_ascii_digit() => Some(Formula::Number(text)),
            '-' => Some(Formula::Sign("−".to_owned())),
            _ => Some(Formula::Sign(text)),
        }
    }

    fn skip_spaces(&mut self) {
        self.rest = self.rest.trim_start();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_named_formula_can_be_read() {
        for (name, source) in NAMED_FORMULAS {
            assert!(named_formula(name).is_some(), "{name}: {source}");
        }
    }

    #[test]
    fn fractions_scripts_and_values_are_parts_of_the_tree() {
        let symbol = |text: &str| Formula::Symbol(text.to_owned());
        let fraction = Formula::Fraction(Box::new([symbol("a"), Formula::Number("2.5".to_owned())]));
        assert_eq!(parse_formula(r"\frac{a}{2.5}"), Some(fraction));
        let scripts = Formula::Scripts {
            base: Box::new(symbol("γ")),
            below: Some(Box::new(Formula::Number("1".to_owned()))),
            above: None,
        };
        assert_eq!(parse_formula("γ_1"), Some(scripts));
        let value = Formula::Value("zero.rightmost".to_owned(), "1/s".to_owned());
        assert_eq!(parse_formula(r"\value{zero.rightmost}{1/s}"), Some(value));
    }

    #[test]
    fn what_is_no_formula_is_refused() {
        for broken in [r"\frac{a}", "a_", "{a", "a}", r"\script{x}", "a_1_2", &"{".repeat(40)] {
            assert_eq!(parse_formula(broken), None, "{broken}");
        }
    }
}
