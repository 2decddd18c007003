//! Printed numbers of the sources, one test per table.

mod campestrini_loops;
mod campestrini_placement;
mod campestrini_relay;
mod campestrini_tables;
mod closed_loop;
mod junqueira;
mod tables;
