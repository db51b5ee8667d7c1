//! When solving stops.

use crate::Bars;
use clap::Args;
use imdp::progress::Progress;
use imdp::solver::SolverOptions;
use std::time::Duration;

/// When to stop.
#[derive(Clone, Debug, Args)]
pub(crate) struct LimitArguments {
    /// Unbounded properties: stop when the bounds are this close, absolutely.
    #[arg(long, value_name = "E", default_value_t = 1e-6, value_parser = positive)]
    epsilon: f64,

    /// Stop after this many iterations.
    #[arg(long, value_name = "N")]
    max_iterations: Option<u64>,

    /// Stop each property after this many seconds.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time_limit: Option<f64>,
}

pub(crate) fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|x| x.is_finite() && *x > 0.0);
    number.ok_or_else(|| "expected a positive number".to_owned())
}

pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    let number = positive(text)?;
    Duration::try_from_secs_f64(number).map(|_| number).map_err(|error| error.to_string())
}

impl LimitArguments {
    /// No limits, and bounds this close.
    pub(crate) fn of_epsilon(epsilon: f64) -> Self {
        Self { epsilon, ..Self::default() }
    }

    /// What solvers are told.
    pub(crate) fn options(&self) -> SolverOptions<'static> {
        SolverOptions {
            epsilon: self.epsilon,
            max_iterations: self.max_iterations.unwrap_or(u64::MAX),
            time_limit: self.time_limit.map(Duration::from_secs_f64),
            ..SolverOptions::default()
        }
    }

    /// Computes something within these limits, with the current gap on display.
    pub(crate) fn with_options<T>(&self, bars: &Bars, compute: impl FnOnce(&SolverOptions<'_>) -> T) -> T {
        let result = compute(&SolverOptions { progress: bars, ..self.options() });
        bars.finish();
        result
    }
}

impl Default for LimitArguments {
    fn default() -> Self {
        Self { epsilon: SolverOptions::default().epsilon, max_iterations: None, time_limit: None }
    }
}
