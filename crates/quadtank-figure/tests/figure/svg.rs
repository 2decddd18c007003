use quadtank_figure::{Palette, Rgb, Style, to_svg};
use roxmltree::{Document, Node};

use crate::fixture::{Run, SIZE, STYLE, johansson_s_plane, plane, response_charts, right_most_zero};

fn groups<'a>(document: &'a Document, class: &str) -> Vec<Node<'a, 'a>> {
    document.descendants().filter(|node| node.attribute("class") == Some(class)).collect()
}

#[test]
fn responses_have_a_group_for_every_curve() {
    let (run, other) = (Run::step(1.0), Run::step(2.0));
    let svg = to_svg(&response_charts(&run, Some(&other), Some(&other)), SIZE, &STYLE, "Responses", "Two levels");
    let document = Document::parse(&svg).expect("well-formed");
    for role in ["loop-1", "loop-2"] {
        assert_eq!(groups(&document, &format!("line {role} solid")).len(), 2, "level and voltage");
        assert_eq!(groups(&document, &format!("line {role} dotted")).len(), 2);
        assert_eq!(groups(&document, &format!("line {role} pinned")).len(), 2);
        let references = groups(&document, &format!("line {role} dashed"));
        assert_eq!(references.len(), 1);
        // All dashes are pieces of one path.
        let paths: Vec<_> = references[0].children().filter(Node::is_element).collect();
        assert_eq!(paths.len(), 1);
        assert!(paths[0].attribute("d").expect("a path").matches('M').count() > 50);
    }
    assert_eq!(groups(&document, "axes").len(), 2);
    assert!(svg.len() < 100_000, "{} bytes", svg.len());
}

#[test]
fn loops_have_their_colours() {
    let run = Run::step(1.0);
    let svg = to_svg(&response_charts(&run, None, None), SIZE, &STYLE, "", "");
    let document = Document::parse(&svg).expect("well-formed");
    for (class, color) in [("line loop-1 solid", "#0b6bcb"), ("line loop-2 solid", "#c2410c")] {
        for group in groups(&document, class) {
            assert!(group.children().filter(Node::is_element).all(|path| path.attribute("stroke") == Some(color)));
        }
    }
}

#[test]
fn text_is_escaped_and_the_document_says_what_it_is() {
    let chart = plane(&right_most_zero, Some([0.2, 0.3]));
    let svg = to_svg(&[chart], SIZE, &STYLE, "A < B & \"C\"", "control \u{1} character \u{ffff}");
    let document = Document::parse(&svg).expect("well-formed");
    let root = document.root_element();
    assert_eq!(root.attribute("role"), Some("img"));
    let text = |name: &str| root.children().find(|node| node.has_tag_name(name)).and_then(|node| node.text());
    assert_eq!(text("title"), Some("A < B & \"C\""));
    assert_eq!(text("desc"), Some("control   character  "));
    assert!(document.descendants().any(|node| node.text() == Some("zero < right & wrong")));
}

#[test]
fn the_pole_zero_picture_has_its_parts() {
    let svg = to_svg(&[johansson_s_plane()], SIZE, &STYLE, "", "");
    let document = Document::parse(&svg).expect("well-formed");
    for (class, count) in [
        ("region right-half-plane", 1),
        ("marker neutral", 4),
        ("marker minimum-phase", 1),
        ("marker right-half-plane", 1),
        ("marker closed-loop", 2),
        ("line minimum-phase trail", 1),
        ("line right-half-plane trail", 1),
        ("label neutral", 2),
        ("legend", 1),
    ] {
        assert_eq!(groups(&document, class).len(), count, "{class}");
    }
}

#[test]
fn the_dark_picture_differs_in_colours_only() {
    let dark = Style { palette: Palette::DARK, ..STYLE };
    let strip = |svg: &str| {
        let mut pieces = svg.split('#').map(str::to_owned);
        let first = pieces.next().unwrap_or_default();
        pieces.fold(first, |text, piece| text + &piece[6..])
    };
    let (light, dark) =
        (to_svg(&[johansson_s_plane()], SIZE, &STYLE, "", ""), to_svg(&[johansson_s_plane()], SIZE, &dark, "", ""));
    assert_ne!(light, dark);
    assert_eq!(strip(&light), strip(&dark));
    let Rgb(red, green, blue) = Palette::DARK.background;
    assert!(dark.contains(&format!("fill=\"#{red:02x}{green:02x}{blue:02x}\"")));
}
