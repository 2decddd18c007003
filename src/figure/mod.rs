//! Charts as data, and how to paint them on any plotters backend.
