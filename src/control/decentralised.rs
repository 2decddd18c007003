use serde::{Deserialize, Serialize};

use super::PiSettings;

/// Which pump each level commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Pairing {
    /// Level 1 – pump 1, level 2 – pump 2.
    Diagonal,
    /// Level 1 – pump 2, level 2 – pump 1.
    Swapped,
}

/// Two PI loops that know nothing of each other. Loop 1 controls level 1, loop 2 level 2, whatever pump they drive.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(not(target_arch = "wasm32"), derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct DecentralisedPi {
    /// Which pump each loop drives.
    pub pairing: Pairing,
    /// Settings of the loops that control levels 1 and 2.
    pub loops: [PiSettings; 2],
    /// Sampling time Ts of both loops (s).
    pub sampling_time_s: f64,
}
