//! Reading a document from a [`Tree`] into its types, strictly and with errors that name the field.
//!
//! This deserializer drives the `Deserialize` implementations that serde derives. It is stricter than that of `serde_json`: a struct
//! is read from an object only, never from an array, and an enum variant without content from its name only. Its errors say in plain
//! words what was expected.

use std::fmt::{self, Display};

use serde::Deserialize;
use serde::de::value::StrDeserializer;
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, Error, IntoDeserializer, MapAccess, SeqAccess, VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;

use super::ScenarioError;
use super::error::{malformed, quoted};
use super::tree::Tree;

/// Reads a document, or a part of one.
///
/// # Errors
/// [`ScenarioError::Malformed`], which names the field.
pub fn read<'de, T: Deserialize<'de>>(tree: &'de Tree) -> Result<T, ScenarioError> {
    T::deserialize(tree).map_err(|fault| malformed(path_of(&fault.place), fault.reason))
}

/// The path of a place, such as `setup.controller.loops[0].gain`.
fn path_of(place: &[Step]) -> String {
    let mut path = String::new();
    for step in place.iter().rev() {
        match step {
            Step::Item(index) => path.extend(["[", &index.to_string(), "]"]),
            Step::Field(name) => {
                if !path.is_empty() {
                    path.push('.');
                }
                path.push_str(&quoted(name));
            }
        }
    }
    path
}

/// A step from a value to one inside it.
#[derive(Debug)]
enum Step {
    Item(usize),
    Field(String),
}

/// What is wrong about a value, and where: it is known inside, so each value around adds its step, the innermost first. A library
/// that wraps every visitor to do this (`serde_path_to_error`) costs 20 KB of the page.
#[derive(Debug)]
pub struct Fault {
    reason: String,
    place: Vec<Step>,
}

impl Fault {
    fn inside(mut self, step: Step) -> Self {
        self.place.push(step);
        self
    }

    fn inside_field(self, name: &str) -> Self {
        self.inside(Step::Field(name.to_owned()))
    }
}

impl Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.reason)
    }
}

impl std::error::Error for Fault {}

impl Error for Fault {
    fn custom<T: Display>(reason: T) -> Self {
        Self { reason: reason.to_string(), place: Vec::new() }
    }

    fn unknown_field(name: &str, expected: &'static [&'static str]) -> Self {
        unknown("field", name, expected)
    }

    fn unknown_variant(name: &str, expected: &'static [&'static str]) -> Self {
        unknown("variant", name, expected)
    }

    fn duplicate_field(name: &'static str) -> Self {
        Self::custom(format!("duplicate field `{name}`")).inside_field(name)
    }
}

fn unknown(kind: &str, name: &str, expected: &[&str]) -> Fault {
    Fault::custom(format!("unknown {kind} `{}`, expected one of `{}`", quoted(name), expected.join("`, `")))
}

fn is_no(tree: &Tree, expected: &str) -> Fault {
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
    Fault::custom(format!("invalid type: {found}, expected {expected}"))
}

/// The items of a list.
struct Items<'de>(std::iter::Enumerate<std::slice::Iter<'de, Tree>>);

impl<'de> SeqAccess<'de> for Items<'de> {
    type Error = Fault;

    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        let Some((index, item)) = self.0.next() else { return Ok(None) };
        seed.deserialize(item).map(Some).map_err(|fault| fault.inside(Step::Item(index)))
    }
}

/// The entries of a map: those that are left, and the one whose value comes next.
struct Entries<'de> {
    left: std::slice::Iter<'de, (String, Tree)>,
    next: Option<&'de (String, Tree)>,
}

impl<'de> MapAccess<'de> for Entries<'de> {
    type Error = Fault;

    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Fault> {
        self.next = self.left.next();
        let Some((name, _)) = self.next else { return Ok(None) };
        let key: StrDeserializer<'_, Fault> = name.as_str().into_deserializer();
        seed.deserialize(key).map(Some).map_err(|fault| fault.inside_field(name))
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Fault> {
        let Some((name, value)) = self.next else { return Err(Fault::custom("a value without a key")) };
        seed.deserialize(value).map_err(|fault| fault.inside_field(name))
    }
}

impl<'de> Deserializer<'de> for &'de Tree {
    type Error = Fault;

    /// No type of a document asks for this.
    fn deserialize_any<V: Visitor<'de>>(self, _: V) -> Result<V::Value, Fault> {
        Err(is_no(self, "a value of a document"))
    }

    fn deserialize_bool<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let Tree::Bool(flag) = self else { return Err(is_no(self, "true or false")) };
        visitor.visit_bool(*flag)
    }

    /// Whole numbers beyond 2^53 are rounded.
    fn deserialize_f64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_f64(match self {
            Tree::Float(number) => *number,
            Tree::Unsigned(number) => *number as f64,
            Tree::Signed(number) => *number as f64,
            _ => return Err(is_no(self, "a number")),
        })
    }

    /// A whole number has no decimal point: `1.0` is none.
    fn deserialize_u32<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let number = if let Tree::Unsigned(number) = self { u32::try_from(*number).ok() } else { None };
        visitor.visit_u32(number.ok_or_else(|| is_no(self, "a whole number"))?)
    }

    fn deserialize_u64<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_u32(visitor)
    }

    fn deserialize_str<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let Tree::Text(text) = self else { return Err(is_no(self, "a text")) };
        visitor.visit_str(text)
    }

    fn deserialize_string<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_str(visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        if *self == Tree::Null { visitor.visit_none() } else { visitor.visit_some(self) }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let Tree::List(items) = self else { return Err(is_no(self, "a list")) };
        visitor.visit_seq(Items(items.iter().enumerate()))
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        let Tree::List(items) = self else { return Err(is_no(self, "a list")) };
        let count = items.len();
        if count == length {
            return visitor.visit_seq(Items(items.iter().enumerate()));
        }
        let is_number = |item: &Tree| matches!(item, Tree::Unsigned(_) | Tree::Signed(_) | Tree::Float(_));
        // Perhaps a decimal comma, which a list takes for the end of an entry.
        let hint = if count > length && items.iter().all(is_number) { "; a number has a decimal point" } else { "" };
        Err(Fault::custom(format!("invalid length {count}, expected {length} elements{hint}")))
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        let Tree::Map(entries) = self else { return Err(is_no(self, "a map")) };
        visitor.visit_map(Entries { left: entries.iter(), next: None })
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        visitor.visit_enum(match self {
            Tree::Text(name) => Choice { name, content: None },
            Tree::Map(entries) => match &entries[..] {
                [(name, content)] => Choice { name, content: Some(content) },
                _ => return Err(Fault::custom(format!("invalid length {}, expected one choice", entries.len()))),
            },
            _ => return Err(is_no(self, "a choice")),
        })
    }

    forward_to_deserialize_any! {
        i8 i16 i32 i64 u8 u16 f32 char bytes byte_buf unit unit_struct newtype_struct tuple_struct map identifier
        ignored_any
    }
}

/// A choice that is made: its name and its content.
struct Choice<'de> {
    name: &'de str,
    content: Option<&'de Tree>,
}

impl<'de> Choice<'de> {
    fn content(&self) -> Result<&'de Tree, Fault> {
        self.content.ok_or_else(|| Fault::custom("a choice that needs a value").inside_field(self.name))
    }
}

impl<'de> EnumAccess<'de> for Choice<'de> {
    type Error = Fault;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Fault> {
        let name: StrDeserializer<'_, Fault> = self.name.into_deserializer();
        Ok((seed.deserialize(name)?, self))
    }
}

impl<'de> VariantAccess<'de> for Choice<'de> {
    type Error = Fault;

    fn unit_variant(self) -> Result<(), Fault> {
        self.content.map_or(Ok(()), |content| Err(is_no(content, "a choice without a value").inside_field(self.name)))
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Fault> {
        seed.deserialize(self.content()?).map_err(|fault| fault.inside_field(self.name))
    }

    fn tuple_variant<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        self.content()?.deserialize_tuple(length, visitor).map_err(|fault| fault.inside_field(self.name))
    }

    fn struct_variant<V: Visitor<'de>>(self, fields: &'static [&'static str], visitor: V) -> Result<V::Value, Fault> {
        self.content()?.deserialize_struct("", fields, visitor).map_err(|fault| fault.inside_field(self.name))
    }
}
