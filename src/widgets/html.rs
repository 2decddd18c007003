//! Read-only parts of the page as HTML text.
//!
//! Every element and closure that a view is made of is a type of its own, for which Leptos compiles its rendering code
//! anew. What nobody presses is therefore written by plain functions and put into one element by
//! `inner_html=Signal<String>`, which is compiled once. Whatever is not markup goes through [`escape`].

/// Text that stays text inside HTML, also within the quotes of an attribute.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    quadtank_figure::escape(&mut escaped, text);
    escaped
}

/// A sentence in which the parts between `**` are bold: the only markup that the texts know.
pub fn rich(text: &str) -> String {
    let escaped = escape(text);
    let parts = escaped.split("**").enumerate();
    parts.map(|(k, part)| if k % 2 == 1 { element("b", "", part) } else { part.to_owned() }).collect()
}

/// `<name attributes>content</name>`, for content that is HTML already.
pub fn element(name: &str, attributes: &str, content: &str) -> String {
    let space = if attributes.is_empty() { "" } else { " " };
    format!("<{name}{space}{attributes}>{content}</{name}>")
}

/// A choice of a `select`.
pub fn option(value: &str, text: &str, chosen: bool) -> String {
    let selected = if chosen { " selected" } else { "" };
    format!("<option value=\"{}\"{selected}>{}</option>", escape(value), escape(text))
}

/// The content of a table: its caption for those who do not see it, headings, and rows that are HTML already.
pub fn table(caption: &str, names: &[String], rows: &str) -> String {
    let caption = element("caption", "class=\"visually-hidden\"", &escape(caption));
    caption + &element("thead", "", &headings(names)) + &element("tbody", "", rows)
}

/// A row of a table with a heading of a class.
pub fn row(class: &str, name: &str, texts: &[String]) -> String {
    let heading = element("th", &format!("scope=\"row\" class=\"{class}\""), &escape(name));
    element("tr", "", &(heading + &cells(texts)))
}

/// A row of headings of columns.
pub fn headings(texts: &[String]) -> String {
    let cells: String = texts.iter().map(|text| element("th", "scope=\"col\"", &escape(text))).collect();
    element("tr", "", &cells)
}

/// Plain cells of a row.
pub fn cells(texts: &[String]) -> String {
    texts.iter().map(|text| element("td", "", &escape(text))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_parts_between_stars_are_markup() {
        assert_eq!(rich("a **b** < c"), "a <b>b</b> &lt; c");
        assert_eq!(rich("<i>"), "&lt;i&gt;");
    }

    #[test]
    fn a_text_cannot_leave_the_quotes_of_an_attribute() {
        assert_eq!(escape("\"><script>"), "&quot;&gt;&lt;script&gt;");
    }
}
