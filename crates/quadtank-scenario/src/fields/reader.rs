use super::visitor::{Path, Presence, Step, Visitor};
use crate::error::quoted;
use crate::limits::Limits;
use crate::{ScenarioError, Tree};

/// Fills a document from a tree.
pub struct Reader<'t> {
    /// Of the values on the way to the present one.
    outer: Vec<Place<'t>>,
    here: Place<'t>,
}

/// A value of the tree, and what the table has asked for there.
#[derive(Default)]
struct Place<'t> {
    /// `None` behind a choice that is told by its name alone.
    tree: Option<&'t Tree>,
    /// The names that were asked for so far: in the end all that there can be.
    asked: Vec<&'static str>,
    form: Form,
    /// The first field that is not there but should.
    missing: Option<&'static str>,
}

/// What the table has taken a value for.
#[derive(Clone, Copy, Default, PartialEq)]
enum Form {
    /// Nothing so far: the content of a choice that has none.
    #[default]
    Unused,
    Map,
    /// A choice whose name has not come yet.
    Choice,
    /// A choice whose name has come.
    Chosen,
    /// A value without names in it.
    Plain,
}

impl<'t> Reader<'t> {
    pub fn new(tree: &'t Tree) -> Self {
        Self { outer: Vec::new(), here: Place::of(Some(tree)) }
    }

    /// The present value, which is taken for `form`.
    fn tree(&mut self, at: &Path, form: Form) -> Result<&'t Tree, ScenarioError> {
        self.here.form = form;
        self.here.tree.ok_or_else(|| malformed(at.to(""), "a choice that needs a value".to_owned()))
    }

    /// The entry of a map, if it is there.
    fn field(&mut self, at: &Path, name: &'static str, presence: Presence) -> Result<Option<Place<'t>>, ScenarioError> {
        let tree = self.tree(at, Form::Map)?;
        let Tree::Map(entries) = tree else { return Err(is_no(tree, at, "a map")) };
        self.here.asked.push(name);
        let mut found = entries.iter().filter(|(key, _)| key == name).map(|(_, value)| value);
        let first = found.next();
        if found.next().is_some() {
            return Err(malformed(at.to(name), format!("duplicate field `{name}`")));
        }
        if first.is_none() && presence == Presence::Required {
            self.here.missing.get_or_insert(name);
        }
        Ok(first.map(|tree| Place::of(Some(tree))))
    }

    /// The content of a choice, `None` if it is another one.
    fn choice(&mut self, at: &Path, name: &'static str) -> Result<Option<Place<'t>>, ScenarioError> {
        if self.here.form == Form::Chosen {
            return Ok(None);
        }
        let tree = self.tree(at, Form::Choice)?;
        self.here.asked.push(name);
        let (made, content) = chosen(tree, at)?;
        Ok((made == name).then(|| {
            self.here.form = Form::Chosen;
            Place::of(content)
        }))
    }
}

impl<'t> Place<'t> {
    fn of(tree: Option<&'t Tree>) -> Self {
        Self { tree, ..Self::default() }
    }

    /// What is wrong about the names at this place.
    fn check(&self, at: &Path) -> Result<(), ScenarioError> {
        let expected = |kind: &str, name: &str| {
            format!("unknown {kind} `{}`, expected one of `{}`", quoted(name), self.asked.join("`, `"))
        };
        match (self.form, self.tree) {
            (Form::Map, Some(Tree::Map(entries))) => {
                if let Some((key, _)) = entries.iter().find(|(key, _)| !self.asked.contains(&key.as_str())) {
                    return Err(malformed(at.to("") + dot(at) + &quoted(key), expected("field", key)));
                }
                let Some(name) = self.missing else { return Ok(()) };
                Err(malformed(at.to(""), format!("missing field `{name}`")))
            }
            (Form::Choice, Some(tree)) => {
                let (made, _) = chosen(tree, at)?;
                Err(malformed(at.to(""), expected("variant", made)))
            }
            (Form::Unused, Some(tree)) => Err(is_no(tree, at, "a choice without a value")),
            _ => Ok(()),
        }
    }
}

/// What stands between a path and a key of the text.
fn dot(at: &Path) -> &'static str {
    if at.0.is_empty() { "" } else { "." }
}

/// Name and content of the choice that is made.
fn chosen<'t>(tree: &'t Tree, at: &Path) -> Result<(&'t str, Option<&'t Tree>), ScenarioError> {
    match tree {
        Tree::Text(name) => Ok((name, None)),
        Tree::Map(entries) => match &entries[..] {
            [(name, content)] => Ok((name, Some(content))),
            _ => Err(malformed(at.to(""), format!("invalid length {}, expected one choice", entries.len()))),
        },
        _ => Err(is_no(tree, at, "a choice")),
    }
}

impl Visitor for Reader<'_> {
    fn makes(&self) -> bool {
        true
    }

    fn enter(&mut self, at: &Path, step: Step) -> Result<bool, ScenarioError> {
        let inside = match step {
            Step::Field(name, presence) => self.field(at, name, presence)?,
            Step::Choice(name, _) => self.choice(at, name)?,
            Step::Item(index) => match self.here.tree {
                Some(Tree::List(items)) => items.get(index).map(|item| Place::of(Some(item))),
                _ => None,
            },
        };
        let Some(place) = inside else { return Ok(false) };
        self.outer.push(std::mem::replace(&mut self.here, place));
        Ok(true)
    }

    fn leave(&mut self, at: &Path) -> Result<(), ScenarioError> {
        self.here.check(at)?;
        self.here = self.outer.pop().unwrap_or_default();
        Ok(())
    }

    /// Whole numbers beyond 2^53 are rounded.
    fn number(&mut self, at: &Path, value: &mut f64, _: Limits) -> Result<(), ScenarioError> {
        *value = match self.tree(at, Form::Plain)? {
            Tree::Float(number) => *number,
            Tree::Unsigned(number) => *number as f64,
            Tree::Signed(number) => *number as f64,
            tree => return Err(is_no(tree, at, "a number")),
        };
        Ok(())
    }

    fn whole(&mut self, at: &Path, value: &mut u32, _: Limits) -> Result<(), ScenarioError> {
        let tree = self.tree(at, Form::Plain)?;
        let number = if let Tree::Unsigned(number) = tree { u32::try_from(*number).ok() } else { None };
        *value = number.ok_or_else(|| is_no(tree, at, "a whole number"))?;
        Ok(())
    }

    fn flag(&mut self, at: &Path, value: &mut bool) -> Result<(), ScenarioError> {
        let tree = self.tree(at, Form::Plain)?;
        let Tree::Bool(flag) = tree else { return Err(is_no(tree, at, "true or false")) };
        *value = *flag;
        Ok(())
    }

    fn length(&mut self, at: &Path, _: usize, least: usize, most: usize) -> Result<usize, ScenarioError> {
        let tree = self.tree(at, Form::Plain)?;
        let Tree::List(items) = tree else { return Err(is_no(tree, at, "a list")) };
        let count = items.len();
        // That there are too many of what may be any number is no matter of shape.
        if least == most && count != most {
            let is_number = |item: &Tree| matches!(item, Tree::Unsigned(_) | Tree::Signed(_) | Tree::Float(_));
            // Perhaps a decimal comma, which a list takes for the end of an entry.
            let hint = if count > most && items.iter().all(is_number) { "; a number has a decimal point" } else { "" };
            return Err(malformed(at.to(""), format!("invalid length {count}, expected {most} elements{hint}")));
        }
        Ok(count)
    }

    fn option(&mut self, at: &Path, _: bool) -> Result<bool, ScenarioError> {
        Ok(*self.tree(at, Form::Plain)? != Tree::Null)
    }
}

#[inline(never)]
fn is_no(tree: &Tree, at: &Path, expected: &str) -> ScenarioError {
    let found = match tree {
        Tree::Null => "null".to_owned(),
        Tree::Bool(value) => format!("boolean `{value}`"),
        Tree::Unsigned(value) => format!("integer `{value}`"),
        Tree::Signed(value) => format!("integer `{value}`"),
        Tree::Float(value) => format!("floating point `{value}`"),
        Tree::Text(text) => format!("string \"{}\"", quoted(text)),
        Tree::List(_) => "list".to_owned(),
        Tree::Map(_) => "map".to_owned(),
    };
    malformed(at.to(""), format!("invalid type: {found}, expected {expected}"))
}

/// A document of the wrong shape.
pub fn malformed(path: String, reason: String) -> ScenarioError {
    let path = if path.is_empty() { "document".to_owned() } else { path };
    ScenarioError::Malformed { path, reason }
}
