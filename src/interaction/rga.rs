//! The relative gain array.
