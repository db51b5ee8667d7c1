//! Reading IntervalMDP.jl's files.

use super::specification::Specification;
use crate::formats::import::{
    Assembly, AssemblyError, Expected, ImportError, Imported, Interval, Judgement, PendingRow, Position,
    RowFault, Warning, hash_row,
};
use crate::model::{ModelKind, RowId, Rows, StateId, StateSet, StateVariables, require_memory};
use crate::numeric::shortest_decimal;
use hdf5_pure::{AttrValue, File};
use std::collections::HashMap;
use std::path::Path;

/// Reads an interval MDP or a chain of intervals from a `.nc` file, and what is asked from the `.json` file beside it.
///
/// A double stands for its shortest decimal. Without initial states, all states are initial, as for IntervalMDP.jl.
///
/// # Errors
/// [`ImportError`] with the variable and the entry of the first thing that is not as the format wants it.
pub fn import(path: &Path) -> Result<Imported, ImportError> {
    let metadata = std::fs::metadata(path).map_err(|error| ImportError::io(path, error))?;
    // The file is in memory as a whole, and its content besides.
    require_memory("the file and its content", metadata.len().saturating_mul(8))?;
    let content = crate::files::read(path).map_err(|error| ImportError::io(path, error))?;
    let reader = Reader {
        path,
        file: File::from_bytes(content).map_err(|error| {
            Position::member(path, "the file", None).refuse("a NetCDF-4 file", error.to_string())
        })?,
    };
    reader.read()
}

struct Reader<'a> {
    path: &'a Path,
    file: File,
}

/// One of the two matrices.
struct Matrix {
    name: &'static str,
    starts: Vec<u64>,
    rows: Vec<u64>,
    values: Vec<f64>,
}

impl Reader<'_> {
    fn refuse(
        &self,
        what: &str,
        entry: Option<u64>,
        expected: impl Into<String>,
        found: impl Into<String>,
    ) -> ImportError {
        Position::member(self.path, what, entry).refuse(expected, found)
    }

    fn read(&self) -> Result<Imported, ImportError> {
        let attributes = self.file.root().attrs();
        let attributes =
            attributes.map_err(|error| self.refuse("attributes", None, "attributes", error.to_string()))?;
        let text = |name: &str| {
            attributes.get(name).and_then(AttrValue::as_str).map(ToString::to_string).unwrap_or_default()
        };
        let kind = match text("model").as_str() {
            "imdp" => ModelKind::Imdp,
            "imc" => ModelKind::Idtmc,
            other => return Err(self.refuse("model", None, "imdp or imc", other)),
        };
        let columns = if kind == ModelKind::Imdp { "from/action" } else { "from" };
        for (name, expected) in [("format", "sparse_csc"), ("rows", "to"), ("cols", columns)] {
            if text(name) != expected {
                return Err(self.refuse(name, None, expected, text(name)));
            }
        }
        let states = self.states(&attributes)?;
        let (lower, upper) = (self.matrix("lower", states)?, self.matrix("upper", states)?);
        if lower.columns() != upper.columns() {
            let expected = format!("{} columns, as in lower", lower.columns());
            return Err(self.refuse("upper_colptr", None, expected, upper.columns().to_string()));
        }
        let of_state = match kind {
            ModelKind::Imdp => self.offsets("stateptr", states, lower.columns())?,
            ModelKind::Idtmc if lower.columns() != states => {
                let expected = format!("{states} columns, one for each state");
                return Err(self.refuse("lower_colptr", None, expected, lower.columns().to_string()));
            }
            ModelKind::Idtmc => (0..=states).collect(),
        };
        let mut transitions = self.assemble(states, &of_state, &lower, &upper)?;
        let beside = self.path.with_extension("json");
        let specification = Specification::read(&beside, states)?;
        let mut warnings = std::mem::take(&mut transitions.warnings);
        if specification.property.is_empty() {
            warnings.push(Warning::NoSpecification { path: beside });
        }
        let initial = self.initial(states)?;
        let mut imported =
            transitions.into_model(kind, initial, specification.labels, StateVariables::default())?;
        imported.model = imported.model.with_rewards(specification.rewards)?;
        imported.warnings.extend(warnings);
        imported.properties = specification.property;
        Ok(imported)
    }

    fn states(&self, attributes: &HashMap<String, AttrValue>) -> Result<u64, ImportError> {
        let found = attributes.get("num_states").and_then(AttrValue::as_i64);
        let fits = |states: &u64| (1..=u64::from(StateId::MAX)).contains(states);
        found.and_then(|states| u64::try_from(states).ok()).filter(fits).ok_or_else(|| {
            let expected = format!("between 1 and {} states", StateId::MAX);
            self.refuse("num_states", None, expected, found.map_or("none".into(), |n| n.to_string()))
        })
    }

    fn integers(&self, name: &str) -> Result<Vec<u64>, ImportError> {
        let read = self.file.dataset(name).and_then(|dataset| dataset.read_i64());
        let values =
            read.map_err(|error| self.refuse(name, None, "a list of integers", error.to_string()))?;
        let negative = values.iter().position(|value| *value < 0);
        match negative {
            Some(entry) => {
                Err(self.refuse(name, Some(entry as u64), "a number from 1 on", values[entry].to_string()))
            }
            None => Ok(values.into_iter().map(|value| value as u64).collect()),
        }
    }

    /// Offsets that count from 1, as offsets from 0.
    fn offsets(&self, name: &str, count: u64, total: u64) -> Result<Vec<u64>, ImportError> {
        let mut offsets = self.integers(name)?;
        if offsets.len() as u64 != count + 1 {
            return Err(self.refuse(name, None, format!("{} entries", count + 1), offsets.len().to_string()));
        }
        let mut least = 1;
        for (entry, offset) in offsets.iter_mut().enumerate() {
            let is_end = entry == 0 || entry as u64 == count;
            let wanted = if entry == 0 { 1 } else { total + 1 };
            if *offset < least || *offset > total + 1 || (is_end && *offset != wanted) {
                let expected =
                    if is_end { wanted.to_string() } else { format!("between {least} and {}", total + 1) };
                return Err(self.refuse(name, Some(entry as u64), expected, offset.to_string()));
            }
            least = *offset;
            *offset -= 1;
        }
        Ok(offsets)
    }

    fn matrix(&self, name: &'static str, states: u64) -> Result<Matrix, ImportError> {
        let [starts, rows, values] = ["colptr", "rowval", "nzval"].map(|part| format!("{name}_{part}"));
        let mut successors = self.integers(&rows)?;
        for (entry, successor) in successors.iter_mut().enumerate() {
            if !(1..=states).contains(successor) {
                let expected = format!("a state from 1 to {states}");
                return Err(self.refuse(&rows, Some(entry as u64), expected, successor.to_string()));
            }
            *successor -= 1;
        }
        let read = self.file.dataset(&values).and_then(|dataset| dataset.read_f64());
        let bounds =
            read.map_err(|error| self.refuse(&values, None, "a list of numbers", error.to_string()))?;
        if bounds.len() != successors.len() {
            let expected = format!("{} entries, as in {rows}", successors.len());
            return Err(self.refuse(&values, None, expected, bounds.len().to_string()));
        }
        // Written so that NaN fails.
        if let Some(entry) = bounds.iter().position(|bound| !(0.0..=1.0).contains(bound)) {
            let found = format!("{:?}", bounds[entry]);
            return Err(self.refuse(&values, Some(entry as u64), "probabilities between 0 and 1", found));
        }
        let columns = self.integers(&starts)?.len().saturating_sub(1) as u64;
        let starts = self.offsets(&starts, columns, successors.len() as u64)?;
        Ok(Matrix { name, starts, rows: successors, values: bounds })
    }

    fn assemble(
        &self,
        states: u64,
        of_state: &[u64],
        lower: &Matrix,
        upper: &Matrix,
    ) -> Result<crate::formats::import::Transitions, ImportError> {
        let expected = Expected {
            states,
            choices: lower.columns(),
            transitions: (lower.rows.len() + upper.rows.len()) as u64,
        };
        let mut assembly = Assembly::new(expected)?;
        let (mut row, mut rows) = (PendingRow::default(), Rows::new());
        let mut widened: Option<(u64, Position)> = None;
        for state in 0..states {
            for column in of_state[state as usize]..of_state[state as usize + 1] {
                let at = || Position::member(self.path, "upper_colptr", Some(column));
                row.clear();
                rows.clear();
                let mut below = lower.column(column).peekable();
                for (successor, upper_bound) in upper.column(column) {
                    // What is not listed is 0.
                    let own = below.next_if(|(other, _)| *other == successor);
                    let lower_bound = own.map_or(0.0, |(_, bound)| bound);
                    if lower_bound > upper_bound {
                        let expected = format!("an upper bound of at least {lower_bound}");
                        return Err(at().refuse(expected, upper_bound.to_string()));
                    }
                    // There is a negative zero.
                    row.push(
                        StateId(successor as u32),
                        Interval::of_doubles(lower_bound + 0.0, upper_bound + 0.0),
                    );
                }
                if let Some((successor, _)) = below.next() {
                    let expected = format!(
                        "an upper bound for state {} as there is a lower one, in order",
                        successor + 1
                    );
                    return Err(at().refuse(expected, "none"));
                }
                if row.is_empty() {
                    return Err(at().refuse("an action with destinations", "none"));
                }
                let texts: Vec<_> = row
                    .bounds()
                    .into_iter()
                    .map(|(l, u)| (shortest_decimal(l), shortest_decimal(u)))
                    .collect();
                let written = || texts.iter().map(|(l, u)| (l.as_bytes(), u.as_bytes()));
                let judgement = row.finish(written, &mut rows).map_err(|fault| match fault {
                    RowFault::Twice { successor, .. } => {
                        at().refuse(RowFault::ONCE, successor.next().to_string())
                    }
                    RowFault::NoDistribution(fault) => at().refuse(fault.expected, fault.sum),
                })?;
                if judgement != Judgement::FINE {
                    widened.get_or_insert((0, at())).0 += 1;
                }
                let content = rows.row(RowId(0));
                assembly.push(StateId(state as u32), hash_row(content), content, None).map_err(|error| {
                    match error {
                        AssemblyError::Memory(error) => ImportError::Memory(error),
                        AssemblyError::TooManyRows => at().refuse(AssemblyError::at_most(), "one more"),
                    }
                })?;
            }
        }
        let mut transitions = assembly.finish();
        let widened = widened.map(|(count, first)| Warning::Widened { count, first });
        transitions.warnings.splice(0..0, widened);
        Ok(transitions)
    }

    fn initial(&self, states: u64) -> Result<StateSet, ImportError> {
        let mut initial = StateSet::with_capacity(states as usize);
        for (entry, state) in self.integers("initial_states")?.into_iter().enumerate() {
            if !(1..=states).contains(&state) {
                let expected = format!("a state from 1 to {states}");
                return Err(self.refuse("initial_states", Some(entry as u64), expected, state.to_string()));
            }
            initial.insert(state as usize - 1);
        }
        if initial.is_clear() {
            initial.insert_range(..);
        }
        Ok(initial)
    }
}

impl Matrix {
    fn columns(&self) -> u64 {
        self.starts.len() as u64 - 1
    }

    /// The entries of a column, by state.
    fn column(&self, column: u64) -> impl Iterator<Item = (u64, f64)> + '_ {
        let range = self.starts[column as usize] as usize..self.starts[column as usize + 1] as usize;
        self.rows[range.clone()].iter().copied().zip(self.values[range].iter().copied())
    }
}

impl std::fmt::Debug for Matrix {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} of {} entries", self.name, self.rows.len())
    }
}
