//! Poles and transmission zeros of the plant, folded away.

use leptos::prelude::*;

use super::session::{Session, time_unit, use_session};
use crate::format::NumberStyle;
use crate::texts::{say, tr};
use crate::widgets::{Folded, Row, TableContent};
use quadtank::linear::{Complex, MatrixPolesAndZeros};

/// Fold with poles and transmission zeros of the plant.
#[component]
pub fn PlantRoots() -> impl IntoView {
    let session = use_session();
    let summary = say!(session.lab, zeros.title);
    view! { <Folded id="plant-roots" summary caption=summary content=move || content(session) /> }
}

fn content(session: Session) -> AnyView {
    let lab = session.lab;
    let found = session.throttled.study.with(|study| study.as_ref().as_ref().ok().map(|of| of.poles_and_zeros.clone()));
    let why_not = |why: String| view! { <caption>{why}</caption> }.into_any();
    match found {
        Some(Ok(Some(found))) => table(session, &found).into_any(),
        Some(Ok(None)) => why_not(tr!(lab, relay.roots_delayed)),
        Some(Err(_)) | None => why_not(tr!(lab, relay.roots_not_found)),
    }
}

fn table(session: Session, found: &MatrixPolesAndZeros) -> impl IntoView + use<> {
    let lab = session.lab;
    let style = lab.number_style();
    let zeros = match &found.zeros {
        None => tr!(lab, zeros.degenerate),
        Some(zeros) if zeros.is_empty() => tr!(lab, zeros.none),
        Some(zeros) if found.has_right_half_plane_zero() => {
            tr!(lab, relay.zeros_right, zeros = listed(style, zeros))
        }
        Some(zeros) => tr!(lab, relay.zeros_left, zeros = listed(style, zeros)),
    };
    let unit = session.throttled.setup.with(|setup| time_unit(&setup.plant));
    let unit = if unit.is_empty() { String::new() } else { format!(" (1/{unit})") };
    let names = [tr!(lab, relay.poles), tr!(lab, relay.zeros)].map(|name| name + &unit);
    let rows = names.into_iter().zip([listed(style, &found.poles), zeros]);
    let rows = rows.map(|(name, text)| view! { <Row name figures=vec![text] /> }.into_any()).collect();
    view! { <TableContent caption=tr!(lab, zeros.title) columns=Vec::new() rows /> }
}

/// Roots by rising real part, a conjugate pair as one, and how often each is one.
fn listed(style: NumberStyle, roots: &[Complex]) -> String {
    let upper: Vec<Complex> = roots.iter().copied().filter(|root| root.im >= 0.0).collect();
    let text = |group: &[Complex]| {
        let Complex { re, im } = group[0];
        let real = style.significant(re, 4);
        let root = if im == 0.0 { real } else { format!("{real} ± {}j", style.significant(im, 4)) };
        if group.len() > 1 { format!("{root} ({}×)", group.len()) } else { root }
    };
    upper.chunk_by(|one, other| one == other).map(text).collect::<Vec<_>>().join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_and_repeated_roots_are_written_once() {
        let at = Complex::new;
        let roots = [at(-10.0, 0.0), at(-10.0, 0.0), at(-6.0, -2.828_427), at(-6.0, 2.828_427), at(0.5, 0.0)];
        let style = NumberStyle { decimal: '.' };
        assert_eq!(listed(style, &roots), "−10.00 (2×); −6.000 ± 2.828j; 0.5000");
    }
}
