//! The laboratory without a screen: analyse, simulate and plot a scenario file.

mod command;

fn main() -> std::process::ExitCode {
    command::main()
}
