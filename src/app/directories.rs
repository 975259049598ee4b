//! Where the lab keeps what is its own: preferences and autosaved documents.

use std::path::PathBuf;

use etcetera::BaseStrategy as _;

/// Environment variable that names the folder of preferences.
const CONFIG_VARIABLE: &str = "SPLINE_LAB_CONFIG_DIR";

/// Environment variable that names the folder of autosaved documents.
const STATE_VARIABLE: &str = "SPLINE_LAB_STATE_DIR";

/// The folders of the lab; `None` where nothing is to be kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Directories {
    /// Folder of the preferences.
    pub config: Option<PathBuf>,
    /// Folder of autosaved documents.
    pub state: Option<PathBuf>,
}

impl Directories {
    /// The folders of the person who runs the lab: `spline-lab` under the XDG configuration and state folders, or what
    /// the environment variables `SPLINE_LAB_CONFIG_DIR` and `SPLINE_LAB_STATE_DIR` name.
    pub fn of_user() -> Self {
        let named =
            |variable: &str| std::env::var_os(variable).filter(|value| !value.is_empty()).map(PathBuf::from);
        let strategy = etcetera::choose_base_strategy().ok();
        let config = strategy.as_ref().map(|base| base.config_dir().join("spline-lab"));
        // Systems without a folder for state have one for data.
        let state = strategy
            .as_ref()
            .map(|base| base.state_dir().unwrap_or_else(|| base.data_dir()).join("spline-lab"));
        Self { config: named(CONFIG_VARIABLE).or(config), state: named(STATE_VARIABLE).or(state) }
    }

    /// No folders: nothing is read or kept, for tests.
    pub fn none() -> Self {
        Self::default()
    }
}
