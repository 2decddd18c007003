use std::cell::RefCell;
use std::convert::Infallible;
use std::fmt::Write;
use std::rc::Rc;

use plotters::coord::Shift;
use plotters::prelude::DrawingArea;
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontStyle,
    FontTransform,
};

use super::paint::{FONT_FAMILY, Part, Sheet, paint_parts};
use super::{Chart, Layer, Pen, Role, Size, Style};

/// Paints charts into a self-contained SVG document, in CSS px, on the background of the palette. Title and
/// description are what a screen reader says.
///
/// The backend is our own and not `plotters-svg`: it keeps fractions of a pixel, names the parts of the chart by
/// classes, joins the dashes of a line into one path, and needs no measure of text.
pub fn to_svg(charts: &[Chart], size: Size, style: &Style, title: &str, description: &str) -> String {
    let size = size.clamped();
    let backend = Rc::new(RefCell::new(Svg::new(size, style.scale.max(1))));
    let area = DrawingArea::<Svg, Shift>::from(&backend);
    // Writing to memory cannot fail, so there is no error to report.
    let Ok(()) = paint_parts(&area, charts, size, style, Sheet::Both, &mut |part| backend.borrow_mut().group(part))
    else {
        return String::new();
    };
    let body = backend.borrow_mut().take_body();
    let (Size { width, height }, background) = (size, style.palette.background);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         role=\"img\" font-family=\"{FONT_FAMILY}\" fill=\"none\" stroke-linejoin=\"round\">\n<title>"
    );
    escape(&mut svg, title);
    svg.push_str("</title>\n<desc>");
    escape(&mut svg, description);
    svg.push_str("</desc>\n<rect class=\"background\" width=\"100%\" height=\"100%\" fill=\"");
    hex(&mut svg, (background.0, background.1, background.2));
    svg.push_str("\"/>\n");
    svg.push_str(&body);
    svg.push_str("</svg>\n");
    svg
}

/// A backend that writes SVG elements.
struct Svg {
    size: Size,
    scale: u32,
    body: String,
    in_group: bool,
    /// Colour of the path that is still open, and its width if it is a stroke; what is alike is joined to it.
    pen: Option<((u8, u8, u8), Option<u32>)>,
}

impl Svg {
    fn new(size: Size, scale: u32) -> Self {
        Self { size, scale, body: String::new(), in_group: false, pen: None }
    }

    /// Ends the group before and begins that of `part`.
    fn group(&mut self, part: Part) {
        self.end_group();
        let (kind, look) = match part {
            Part::Axes => ("axes", None),
            Part::Legend => ("legend", None),
            Part::Layer(layer) => class(layer),
        };
        self.body.push_str("<g class=\"");
        self.body.push_str(kind);
        let (role, pen) = look.unwrap_or_default();
        for word in [role.map(role_class), pen.map(pen_class)].into_iter().flatten() {
            self.body.push(' ');
            self.body.push_str(word);
        }
        self.body.push_str("\">\n");
        self.in_group = true;
    }

    fn end_group(&mut self) {
        self.end_path();
        if self.in_group {
            self.body.push_str("</g>\n");
            self.in_group = false;
        }
    }

    fn end_path(&mut self) {
        match self.pen.take() {
            Some((color, Some(width))) => {
                self.body.push_str("\" stroke=\"");
                hex(&mut self.body, color);
                self.attribute("\" stroke-width", f64::from(width));
                self.body.push_str("/>\n");
            }
            Some((color, None)) => {
                self.body.push_str("\" fill=\"");
                hex(&mut self.body, color);
                self.body.push_str("\"/>\n");
            }
            None => (),
        }
    }

    /// What follows is a part of a path of this colour and width.
    fn take_pen(&mut self, color: BackendColor, width: Option<u32>) {
        let pen = (color.rgb, width);
        if self.pen != Some(pen) {
            self.end_path();
            self.body.push_str("<path d=\"");
            self.pen = Some(pen);
        }
    }

    fn take_body(&mut self) -> String {
        self.end_group();
        std::mem::take(&mut self.body)
    }

    /// Writes a length in CSS px.
    fn number(&mut self, fine: f64) {
        // Writing to a string cannot fail.
        let _ = write!(self.body, "{}", fine / f64::from(self.scale));
    }

    fn attribute(&mut self, name: &str, fine: f64) {
        self.body.push_str(name);
        self.body.push_str("=\"");
        self.number(fine);
        self.body.push('"');
    }

    fn point(&mut self, (x, y): BackendCoord) {
        self.number(f64::from(x));
        self.body.push(' ');
        self.number(f64::from(y));
    }

    fn points(&mut self, points: impl IntoIterator<Item = BackendCoord>) {
        for (number, point) in points.into_iter().enumerate() {
            self.body.push(if number == 0 { 'M' } else { 'L' });
            self.point(point);
        }
    }

    fn paint(&mut self, color: BackendColor, width: u32, fill: bool) {
        self.body.push_str(if fill { " fill=\"" } else { " stroke=\"" });
        hex(&mut self.body, color.rgb);
        if !fill {
            self.attribute("\" stroke-width", f64::from(width));
            self.body.push_str("/>\n");
            return;
        }
        self.body.push_str("\"/>\n");
    }
}

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

impl DrawingBackend for Svg {
    type ErrorType = Infallible;

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the size is clamped")]
    fn get_size(&self) -> (u32, u32) {
        let fine = |length: f64| (length * f64::from(self.scale)) as u32;
        (fine(self.size.width), fine(self.size.height))
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, color: BackendColor) -> Drawn {
        self.draw_rect((x, y), (x + 1, y + 1), &color, true)
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Drawn {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S, fill: bool) -> Drawn {
        // Rectangles alike in one path: between two of their own, some readers let the background shine through.
        self.take_pen(style.color(), (!fill).then(|| style.stroke_width()));
        self.points([from, (to.0, from.1), to, (from.0, to.1)]);
        self.body.push('Z');
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Drawn {
        self.take_pen(style.color(), Some(style.stroke_width()));
        self.points(path);
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(&mut self, center: BackendCoord, radius: u32, style: &S, fill: bool) -> Drawn {
        self.end_path();
        self.body.push_str("<circle");
        self.attribute(" cx", f64::from(center.0));
        self.attribute(" cy", f64::from(center.1));
        self.attribute(" r", f64::from(radius));
        self.paint(style.color(), style.stroke_width(), fill);
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, outline: I, style: &S) -> Drawn {
        self.end_path();
        self.body.push_str("<path d=\"");
        self.points(outline);
        self.body.push_str("Z\"");
        self.paint(style.color(), style.stroke_width(), true);
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, (x, y): BackendCoord) -> Drawn {
        self.end_path();
        let size = style.size();
        // Not every reader of SVG knows `dominant-baseline`; these shares of the font size stand in for it.
        let drop = match style.anchor().v_pos {
            VPos::Top => 0.75,
            VPos::Center => 0.35,
            VPos::Bottom => -0.2,
        };
        self.attribute("<text x", f64::from(x));
        self.attribute(" y", f64::from(y) + drop * size);
        self.attribute(" font-size", size);
        match style.anchor().h_pos {
            HPos::Left => (),
            HPos::Center => self.body.push_str(" text-anchor=\"middle\""),
            HPos::Right => self.body.push_str(" text-anchor=\"end\""),
        }
        if matches!(style.style(), FontStyle::Bold) {
            self.body.push_str(" font-weight=\"bold\"");
        }
        let turn = match style.transform() {
            FontTransform::None => None,
            FontTransform::Rotate90 => Some("90 "),
            FontTransform::Rotate180 => Some("180 "),
            FontTransform::Rotate270 => Some("-90 "),
        };
        if let Some(turn) = turn {
            self.body.push_str(" transform=\"rotate(");
            self.body.push_str(turn);
            self.point((x, y));
            self.body.push_str(")\"");
        }
        self.body.push_str(" fill=\"");
        hex(&mut self.body, style.color().rgb);
        self.body.push_str("\">");
        escape(&mut self.body, text);
        self.body.push_str("</text>\n");
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let characters = u32::try_from(text.chars().count()).unwrap_or(u32::MAX);
        let em = style.size();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        Ok(((f64::from(characters) * 0.55 * em) as u32, (1.2 * em) as u32))
    }
}

type Look = Option<(Option<Role>, Option<Pen>)>;

fn class(layer: &Layer) -> (&'static str, Look) {
    match layer {
        Layer::Field(_) => ("field", None),
        Layer::Cells(_) => ("cells", None),
        Layer::Region { role, .. } => ("region", Some((Some(*role), None))),
        Layer::Line(series) => ("line", Some((Some(series.role), Some(series.pen)))),
        Layer::Upright { role, pen, .. } | Layer::Level { role, pen, .. } => ("rule", Some((Some(*role), Some(*pen)))),
        Layer::Marker(marker) => ("marker", Some((Some(marker.role), None))),
        Layer::Names(_) => ("names", None),
        Layer::Ends(_) => ("ends", None),
        Layer::Label(label) => ("label", Some((Some(label.role), None))),
    }
}

fn role_class(role: Role) -> &'static str {
    match role {
        Role::Loop1 => "loop-1",
        Role::Loop2 => "loop-2",
        Role::MinimumPhase => "minimum-phase",
        Role::RightHalfPlane => "right-half-plane",
        Role::ClosedLoop => "closed-loop",
        Role::Neutral => "neutral",
        Role::Muted => "muted",
    }
}

fn pen_class(pen: Pen) -> &'static str {
    match pen {
        Pen::Solid => "solid",
        Pen::Broad => "broad",
        Pen::Dotted => "dotted",
        Pen::Dashed => "dashed",
        Pen::Faded => "faded",
        Pen::Pinned(_) => "pinned",
        Pen::Hair => "hair",
        Pen::Trail => "trail",
    }
}

fn hex(out: &mut String, (red, green, blue): (u8, u8, u8)) {
    let _ = write!(out, "#{red:02x}{green:02x}{blue:02x}");
}

/// Writes text as XML character data; control characters, which XML 1.0 does not allow, become spaces.
pub fn escape(out: &mut String, text: &str) {
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\u{fffe}' | '\u{ffff}' => out.push(' '),
            _ if character.is_control() && character != '\n' && character != '\t' => out.push(' '),
            _ => out.push(character),
        }
    }
}
