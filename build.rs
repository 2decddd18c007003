//! Turns the texts in `assets/locales` into checked keys for the user interface. The core has no texts and needs none of it.

#[cfg(not(feature = "app"))]
fn main() {}

#[cfg(feature = "app")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    use leptos_i18n_build::{Config, ParseOptions, TranslationsInfos};

    println!("cargo::rerun-if-changed=build.rs");
    let out = std::env::var_os("OUT_DIR").ok_or("cargo sets OUT_DIR")?;
    let options = ParseOptions::default().interpolate_display(true);
    let config =
        Config::new("en")?.add_locale("pt-BR")?.locales_path("./assets/locales").parse_options(options);
    let texts = TranslationsInfos::parse(config)?;
    texts.emit_diagnostics();
    texts.rerun_if_locales_changed();
    texts.generate_i18n_module(std::path::Path::new(&out).join("i18n"))?;
    Ok(())
}
