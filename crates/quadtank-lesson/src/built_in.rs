//! The lessons of the laboratory.

/// Their ids in the order of the course. The file of the lesson `id` at place `n` (from 1) is `lessons/n-id.json`, `n` with two digits.
pub const LESSON_IDS: [&str; 12] = [
    "two-valves-one-zero",
    "relative-gain-blows-up",
    "swap-the-pairing",
    "price-of-a-right-half-plane-zero",
    "directions",
    "linear-is-local",
    "windup",
    "relay-finds-the-ultimate-point",
    "critical-curve-has-corners",
    "perfect-outputs-exploding-insides",
    "tight-or-averaging",
    "wrong-operating-point",
];

/// Their files, in the same order.
#[cfg(feature = "built-in")]
pub const BUILT_IN: [&str; 12] = [
    include_str!("../lessons/01-two-valves-one-zero.json"),
    include_str!("../lessons/02-relative-gain-blows-up.json"),
    include_str!("../lessons/03-swap-the-pairing.json"),
    include_str!("../lessons/04-price-of-a-right-half-plane-zero.json"),
    include_str!("../lessons/05-directions.json"),
    include_str!("../lessons/06-linear-is-local.json"),
    include_str!("../lessons/07-windup.json"),
    include_str!("../lessons/08-relay-finds-the-ultimate-point.json"),
    include_str!("../lessons/09-critical-curve-has-corners.json"),
    include_str!("../lessons/10-perfect-outputs-exploding-insides.json"),
    include_str!("../lessons/11-tight-or-averaging.json"),
    include_str!("../lessons/12-wrong-operating-point.json"),
];

/// The file of a lesson of the laboratory.
#[cfg(feature = "built-in")]
pub fn built_in(id: &str) -> Option<&'static str> {
    LESSON_IDS.iter().position(|known| *known == id).map(|index| BUILT_IN[index])
}

#[cfg(all(test, feature = "built-in"))]
mod tests {
    use super::{BUILT_IN, LESSON_IDS, built_in};
    use crate::{Lesson, TERMS, TaskKind, Tongue, audit, read_lesson};

    fn lessons() -> impl Iterator<Item = Lesson> {
        BUILT_IN.into_iter().map(|text| read_lesson(text.as_bytes()).unwrap())
    }

    #[test]
    fn every_lesson_can_be_given_to_students() {
        for lesson in lessons() {
            let faults: Vec<_> = audit(&lesson, &TERMS, &LESSON_IDS).iter().map(ToString::to_string).collect();
            assert_eq!(faults, [""; 0], "{}", lesson.id);
        }
    }

    #[test]
    fn ids_are_those_of_the_files() {
        assert!(lessons().map(|lesson| lesson.id).eq(LESSON_IDS));
        assert_eq!(built_in("windup"), Some(BUILT_IN[6]));
        assert_eq!(built_in("none"), None);
    }

    #[test]
    fn lessons_follow_the_arc_that_the_documentation_describes() {
        for lesson in lessons() {
            let Lesson { id, minutes, steps, .. } = &lesson;
            assert_eq!(lesson.languages, Tongue::ALL, "{id}");
            assert_eq!(lesson.points(), 10, "{id}");
            assert!((6..=10).contains(minutes) && steps.len() <= 7, "{id}");
            assert!(
                !lesson.outcomes.is_empty() && !lesson.misconceptions.is_empty() && !lesson.source.is_empty(),
                "{id}"
            );
            let first = lesson.tasks().next().unwrap().1;
            assert!(matches!(first.kind, TaskKind::Predict(_)), "{id} begins with `{}`", first.id);
            for (_, task) in lesson.tasks().filter(|(_, task)| task.kind.is_marked()) {
                assert_eq!(task.hints.len(), 2, "{id}: hints of `{}`", task.id);
            }
        }
    }

    #[test]
    fn prerequisites_come_before() {
        for (place, lesson) in lessons().enumerate() {
            for before in &lesson.prerequisites {
                assert!(LESSON_IDS[..place].contains(&before.as_str()), "{}: {before}", lesson.id);
            }
        }
    }
}
