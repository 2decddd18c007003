//! Reading a document from a [`Tree`] into its types, strictly and with errors that name the field.
//!
//! This deserializer drives the `Deserialize` implementations that serde derives. It is stricter than that of `serde_json`: a struct
//! is read from an object only, never from an array, and an enum variant without content from its name only. Its errors say in plain
//! words what was expected.

use std::fmt::{self, Display};

use serde::Deserialize;
use serde::de::value::{MapDeserializer, SeqDeserializer, StrDeserializer};
use serde::de::{DeserializeSeed, Deserializer, EnumAccess, Error, IntoDeserializer, VariantAccess, Visitor};
use serde::forward_to_deserialize_any;
use serde_path_to_error::{Path, Segment};

use super::ScenarioError;
use super::error::{malformed, quoted};
use super::tree::Tree;

/// Reads a document, or a part of one.
///
/// # Errors
/// [`ScenarioError::Malformed`], which names the field.
pub fn read<'de, T: Deserialize<'de>>(tree: &'de Tree) -> Result<T, ScenarioError> {
    serde_path_to_error::deserialize(tree).map_err(|error| {
        let mut path = path_of(error.path());
        let Fault { reason, field } = error.into_inner();
        if let Some(field) = field {
            push_name(&mut path, field);
        }
        malformed(path, reason)
    })
}

/// The path of a value, such as `setup.controller.loops[0].gain`.
fn path_of(path: &Path) -> String {
    let mut text = String::new();
    for segment in path {
        match segment {
            Segment::Seq { index } => text.extend(["[", &index.to_string(), "]"]),
            Segment::Map { key: name } | Segment::Enum { variant: name } => push_name(&mut text, name),
            Segment::Unknown => {}
        }
    }
    text
}

fn push_name(path: &mut String, name: &str) {
    if !path.is_empty() {
        path.push('.');
    }
    path.push_str(&quoted(name));
}

/// What is wrong about a value.
#[derive(Debug)]
pub struct Fault {
    reason: String,
    /// The field of the value that it is about, where that is not on the path.
    field: Option<&'static str>,
}

impl Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.reason)
    }
}

impl std::error::Error for Fault {}

impl Error for Fault {
    fn custom<T: Display>(reason: T) -> Self {
        Self { reason: reason.to_string(), field: None }
    }

    fn unknown_field(name: &str, expected: &'static [&'static str]) -> Self {
        unknown("field", name, expected)
    }

    fn unknown_variant(name: &str, expected: &'static [&'static str]) -> Self {
        unknown("variant", name, expected)
    }

    fn duplicate_field(name: &'static str) -> Self {
        Self { reason: format!("duplicate field `{name}`"), field: Some(name) }
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

fn list_of(items: &[Tree]) -> SeqDeserializer<std::slice::Iter<'_, Tree>, Fault> {
    SeqDeserializer::new(items.iter())
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

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        if *self == Tree::Null { visitor.visit_none() } else { visitor.visit_some(self) }
    }

    fn deserialize_seq<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let Tree::List(items) = self else { return Err(is_no(self, "a list")) };
        visitor.visit_seq(list_of(items))
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        let Tree::List(items) = self else { return Err(is_no(self, "a list")) };
        let count = items.len();
        if count == length {
            return visitor.visit_seq(list_of(items));
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
        visitor.visit_map(MapDeserializer::new(entries.iter().map(|(key, value)| (key.as_str(), value))))
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
        i8 i16 i32 i64 u8 u16 f32 char str string bytes byte_buf unit unit_struct newtype_struct tuple_struct map identifier
        ignored_any
    }
}

impl<'de> IntoDeserializer<'de, Fault> for &'de Tree {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

/// A choice that is made: its name and its content.
struct Choice<'de> {
    name: &'de str,
    content: Option<&'de Tree>,
}

impl<'de> Choice<'de> {
    fn content(&self) -> Result<&'de Tree, Fault> {
        self.content.ok_or_else(|| Fault::custom("a choice that needs a value"))
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
        self.content.map_or(Ok(()), |content| Err(is_no(content, "a choice without a value")))
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Fault> {
        seed.deserialize(self.content()?)
    }

    fn tuple_variant<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        self.content()?.deserialize_tuple(length, visitor)
    }

    fn struct_variant<V: Visitor<'de>>(self, fields: &'static [&'static str], visitor: V) -> Result<V::Value, Fault> {
        self.content()?.deserialize_struct("", fields, visitor)
    }
}
