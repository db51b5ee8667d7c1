//! Interval MDPs, from arrays and files and back.

use crate::arrays::{Doubles, array, list, whole};
use crate::errors::refused;
use crate::imdp_result::{Asked, PropertyResult, certified};
use crate::work::interruptible;
use imdp::certificate::FileDigest;
use imdp::files::Outputs;
use imdp::formats::{Format, Imported, ModelWriter, native, sha256_hex, umb::Compression};
use imdp::model::{
    ActionNames, Choices, ChoicesBuilder, IntervalMdp, Labels, ModelKind, Parts, RowBuffer, RowId, RowRange,
    Rows, StateId, StateSet, StateVariables,
};
use numpy::{Ix1, PyArray};
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

/// An interval MDP.
///
/// Model(state_offsets, choice_offsets, successors, lower, upper, labels={}, initial=[0]): state s has the choices from
/// state_offsets[s] to state_offsets[s + 1], choice c the successors from choice_offsets[c] to choice_offsets[c + 1], ascending,
/// with lower <= P <= upper. labels are lists of states by name. A state without a choice stays where it is.
#[pyclass(frozen, module = "dynabs.imdp")]
pub(crate) struct Model {
    model: Arc<IntervalMdp>,
    /// What was accepted in its file although it deserves a look.
    warnings: Vec<String>,
}

type Array<'py, T> = Bound<'py, PyArray<T, Ix1>>;

#[pymethods]
impl Model {
    #[new]
    #[pyo3(signature = (state_offsets, choice_offsets, successors, lower, upper, labels=BTreeMap::new(), initial=vec![0]))]
    fn new(
        state_offsets: Doubles<'_>,
        choice_offsets: Doubles<'_>,
        successors: Doubles<'_>,
        lower: Doubles<'_>,
        upper: Doubles<'_>,
        labels: BTreeMap<String, Vec<u64>>,
        initial: Vec<u64>,
    ) -> PyResult<Self> {
        let rows = lengths("choice_offsets", &choice_offsets)?;
        let per_state = lengths("state_offsets", &state_offsets)?;
        let successors = whole("successors", &successors)?.into_iter().map(StateId).collect::<Vec<_>>();
        let (lower, upper) = (list("lower", &lower)?, list("upper", &upper)?);
        let sizes = [successors.len(), lower.len(), upper.len()];
        let rows = Rows::from_columns(rows.into_iter(), successors, lower, upper).ok_or_else(|| {
            refused(format!(
                "successors, lower, upper: found {sizes:?} numbers; expected as many of each as choice_offsets ends with"
            ))
        })?;
        let choices = choices(&per_state, rows.len())?;
        let states = choices.num_states();
        let mut named = Labels::default();
        for (name, members) in &labels {
            named.insert(name, set(&format!("labels[{name:?}]"), members, states)?);
        }
        let initial = set("initial", &initial, states)?;
        let parts = Parts {
            kind: ModelKind::Imdp,
            rows,
            choices,
            actions: ActionNames::None,
            initial,
            labels: named,
            variables: StateVariables::default(),
        };
        Ok(Self::of(IntervalMdp::new(parts).map_err(refused)?))
    }

    /// Reads a file in any format, told by its ending.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let format = format_of(&path)?;
        let imported = interruptible(py, |stop| format.import(&path, stop))?;
        let Imported { model, warnings, .. } = imported.map_err(refused)?;
        let warnings = warnings.iter().map(ToString::to_string).collect();
        Ok(Self { warnings, ..Self::of(model) })
    }

    /// Writes the file or files of a format, told by the ending.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let format = format_of(&path)?;
        let written = interruptible(py, |stop| {
            let writer = ModelWriter::new(&self.model, format, Compression::default())
                .map_err(|error| error.to_string())?;
            let mut files = Outputs::default();
            for extension in writer.extensions() {
                let file = path.with_extension(extension);
                let written = files.write(&file, |out| writer.write(extension, out, stop));
                written.map_err(|error| format!("{}: {error}", file.display()))?;
            }
            files.commit().map_err(|error| format!("{}: {error}", path.display()))
        })?;
        written.map_err(refused)
    }

    /// What was accepted in its file although it deserves a look.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
    }

    /// The number of states.
    #[getter]
    fn states(&self) -> usize {
        self.model.num_states()
    }

    /// The number of choices.
    #[getter]
    fn choices(&self) -> u64 {
        self.model.size().choices
    }

    /// The number of transitions.
    #[getter]
    fn transitions(&self) -> u64 {
        self.model.size().transitions
    }

    /// The states of every label.
    #[getter]
    fn labels(&self) -> BTreeMap<String, Vec<usize>> {
        self.model.labels().iter().map(|(name, set)| (name.to_owned(), set.ones().collect())).collect()
    }

    /// The initial states.
    #[getter]
    fn initial(&self) -> Vec<usize> {
        self.model.initial().ones().collect()
    }

    /// state_offsets, choice_offsets, successors, lower, upper: what the model is made of, as in Model(...).
    ///
    /// A state that can only stay has a choice that does so.
    #[allow(clippy::type_complexity)] // A tuple of Python.
    fn arrays<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Array<'py, i64>, Array<'py, i64>, Array<'py, i64>, Array<'py, f64>, Array<'py, f64>)> {
        let Columns { state_offsets, choice_offsets, successors, lower, upper } =
            py.detach(|| Columns::of(&self.model));
        let [states, choices, entries] = [state_offsets.len(), choice_offsets.len(), successors.len()];
        Ok((
            array(py, state_offsets, states)?,
            array(py, choice_offsets, choices)?,
            array(py, successors, entries)?,
            array(py, lower, entries)?,
            array(py, upper, entries)?,
        ))
    }

    /// Answers a property in PRISM's syntax, such as 'Pmaxmin=? [ F "goal" ]'; writes a certificate to the path, if one is given.
    #[pyo3(signature = (property, certificate=None))]
    fn solve(
        &self,
        py: Python<'_>,
        property: &str,
        certificate: Option<PathBuf>,
    ) -> PyResult<PropertyResult> {
        let asked = Asked::parse(property)?;
        match certificate {
            None => interruptible(py, |stop| asked.answer(&self.model, stop, None))?.map_err(refused),
            Some(path) => {
                let digests = self.digests(py)?;
                interruptible(py, |stop| certified(&asked, (&self.model, digests), &path, stop))?
                    .map_err(refused)
            }
        }
    }
}

impl Model {
    pub(crate) fn of(model: IntervalMdp) -> Self {
        Self { model: Arc::new(model), warnings: vec![] }
    }

    pub(crate) fn model(&self) -> &IntervalMdp {
        &self.model
    }

    /// What certificates say it is: its file in the native format, which `write("….dynabs")` writes.
    pub(crate) fn digests(&self, py: Python<'_>) -> PyResult<Vec<FileDigest>> {
        let sha256 = interruptible(py, |_| {
            let mut bytes = vec![];
            native::write(&self.model, &mut bytes).map(|()| sha256_hex(&bytes))
        })?;
        Ok(vec![FileDigest { kind: "dynabs".to_owned(), sha256: sha256.map_err(refused)? }])
    }
}

/// The arrays of a model.
#[derive(Default)]
struct Columns {
    state_offsets: Vec<i64>,
    choice_offsets: Vec<i64>,
    successors: Vec<i64>,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl Columns {
    fn of(model: &IntervalMdp) -> Self {
        let mut columns = Self { state_offsets: vec![0], choice_offsets: vec![0], ..Self::default() };
        let buffer = &mut RowBuffer::default();
        for state in StateId::first(model.num_states()) {
            for row in model.choices().rows(state) {
                let row = model.rows().row(row, buffer);
                columns.successors.extend(row.successors.iter().map(|state| i64::from(state.0)));
                columns.lower.extend(row.lower);
                columns.upper.extend(row.upper);
                columns.choice_offsets.push(columns.successors.len() as i64);
            }
            if model.choices().is_absorbing(state) {
                columns.successors.push(i64::from(state.0));
                columns.lower.push(1.0);
                columns.upper.push(1.0);
                columns.choice_offsets.push(columns.successors.len() as i64);
            }
            columns.state_offsets.push(columns.choice_offsets.len() as i64 - 1);
        }
        columns
    }
}

fn format_of(path: &std::path::Path) -> PyResult<Format> {
    Format::of_path(path).ok_or_else(|| {
        let endings = Format::endings(Format::all());
        refused(format!("path: found {}; expected a file that ends in {endings}", path.display()))
    })
}

/// The differences of offsets, which begin with 0 and never fall.
fn lengths(name: &str, offsets: &Doubles<'_>) -> PyResult<Vec<u32>> {
    let offsets = whole(name, offsets)?;
    let differences = offsets.windows(2).map(|pair| pair[1].checked_sub(pair[0])).collect();
    let ascending: Option<Vec<u32>> = if offsets.first() == Some(&0) { differences } else { None };
    ascending.ok_or_else(|| {
        refused(format!(
            "{name}: found offsets that do not begin with 0, or fall; expected 0, then ascending numbers"
        ))
    })
}

/// Choices one after the other, each with a row of its own.
fn choices(per_state: &[u32], rows: usize) -> PyResult<Choices> {
    let mut builder = ChoicesBuilder::with_capacity(per_state.len());
    let mut first = 0;
    for &count in per_state {
        if count > 0 {
            let last = RowId::from_index(first + count as usize - 1);
            builder.push_range(RowRange { first: RowId::from_index(first), last });
        }
        first += count as usize;
        builder.finish_state();
    }
    if first != rows {
        return Err(refused(format!(
            "state_offsets: found {first} choices in all; expected {rows}, as many as choice_offsets has"
        )));
    }
    Ok(builder.finish())
}

fn set(name: &str, members: &[u64], states: usize) -> PyResult<StateSet> {
    let mut set = StateSet::with_capacity(states);
    for &state in members {
        if state >= states as u64 {
            return Err(refused(format!(
                "{name}: found the state {state}; expected one of {states}, from 0"
            )));
        }
        set.insert(state as usize);
    }
    Ok(set)
}
