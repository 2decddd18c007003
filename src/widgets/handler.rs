use leptos::prelude::Effect;

/// A handler of an event as one type. Leptos compiles the way of an event to its handler anew for each type of handler; with
/// this it does so once for each kind of event.
pub fn handler<E: 'static>(handle: impl FnMut(E) + 'static) -> Box<dyn FnMut(E)> {
    Box::new(handle)
}

/// An effect, for the same reason as one type.
pub fn effect(run: impl FnMut() + 'static) {
    let run: Box<dyn FnMut()> = Box::new(run);
    Effect::new(run);
}
