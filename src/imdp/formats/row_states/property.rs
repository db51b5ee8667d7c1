//! Properties of the model with row states.

use super::{EncodingError, RowStates};
use crate::property::{PathFormula, Property, StateFormula};

impl RowStates {
    /// The text of the property whose value in the encoding is that of `property` in the original.
    ///
    /// It is a [`Property`] again unless the operator is `X`: `X X` is understood by PRISM, but not by this crate.
    ///
    /// # Errors
    /// [`EncodingError::Steps`] if twice the number of steps is more than PRISM reads.
    pub fn translate(&self, property: &Property) -> Result<String, EncodingError> {
        let double = |steps: Option<u64>| match steps {
            None => Ok(None),
            Some(steps) => match steps.checked_mul(2).filter(|&steps| i32::try_from(steps).is_ok()) {
                Some(steps) => Ok(Some(steps)),
                None => Err(EncodingError::Steps { property: property.to_string(), steps }),
            },
        };
        let path = match &property.path {
            // Two steps from a state of the original there are no row states, so nothing needs to be added.
            PathFormula::Next(formula) => {
                let next = PathFormula::Next(formula.clone());
                return Ok(property.with_path(&format!("X {next}")));
            }
            PathFormula::Finally { formula, steps } => {
                PathFormula::Finally { formula: self.outside_rows(formula), steps: double(*steps)? }
            }
            PathFormula::Globally { formula, steps } => {
                PathFormula::Globally { formula: self.also_in_rows(formula), steps: double(*steps)? }
            }
            PathFormula::Until { left, right, steps } => PathFormula::Until {
                left: self.also_in_rows(left),
                right: self.outside_rows(right),
                steps: double(*steps)?,
            },
        };
        Ok(property.with_path(&path.to_string()))
    }

    /// `formula & !"row"`.
    fn outside_rows(&self, formula: &StateFormula) -> StateFormula {
        if in_rows(formula) == Some(false) {
            return formula.clone();
        }
        let mut operands = match formula {
            StateFormula::And(operands) => operands.clone(),
            _ => vec![formula.clone()],
        };
        operands.push(StateFormula::negation(StateFormula::label(&self.label)));
        StateFormula::And(operands)
    }

    /// `formula | "row"`.
    fn also_in_rows(&self, formula: &StateFormula) -> StateFormula {
        if in_rows(formula) == Some(true) {
            return formula.clone();
        }
        let mut operands = match formula {
            StateFormula::Or(operands) => operands.clone(),
            _ => vec![formula.clone()],
        };
        operands.push(StateFormula::label(&self.label));
        StateFormula::Or(operands)
    }
}

/// Whether a formula holds in row states, which have no label of the original; `None` if that depends on variables.
fn in_rows(formula: &StateFormula) -> Option<bool> {
    match formula {
        StateFormula::True => Some(true),
        StateFormula::False | StateFormula::Label(_) => Some(false),
        StateFormula::Variable(_) | StateFormula::Compare(..) => None,
        StateFormula::Not(operand) => in_rows(operand).map(|holds| !holds),
        StateFormula::And(operands) => all(operands.iter().map(in_rows)),
        StateFormula::Or(operands) => {
            all(operands.iter().map(|operand| in_rows(operand).map(|holds| !holds))).map(|holds| !holds)
        }
        StateFormula::Implies(left, right) => match (in_rows(left), in_rows(right)) {
            (Some(false), _) | (_, Some(true)) => Some(true),
            (Some(true), Some(false)) => Some(false),
            _ => None,
        },
        StateFormula::Iff(left, right) => Some(in_rows(left)? == in_rows(right)?),
        StateFormula::Differ(left, right) => Some(in_rows(left)? != in_rows(right)?),
    }
}

/// Whether all hold: one that does not is enough to know that they do not.
fn all(mut operands: impl Iterator<Item = Option<bool>>) -> Option<bool> {
    operands
        .try_fold(Some(true), |so_far, operand| match operand {
            Some(false) => Err(()),
            Some(true) => Ok(so_far),
            None => Ok(None),
        })
        .unwrap_or(Some(false))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{
        ActionNames, ChoicesBuilder, IntervalMdp, Labels, ModelKind, Parts, Rows, StateSet, StateVariables,
    };

    fn encoding(labels: &[&str]) -> RowStates {
        let mut choices = ChoicesBuilder::with_capacity(1);
        choices.push_absorbing();
        let mut all = StateSet::with_capacity(1);
        all.insert(0);
        let mut of_states = Labels::default();
        labels.iter().for_each(|label| of_states.insert(*label, all.clone()));
        let parts = Parts {
            kind: ModelKind::Imdp,
            rows: Rows::new(),
            choices: choices.finish(),
            actions: ActionNames::None,
            initial: all,
            labels: of_states,
            variables: StateVariables::default(),
        };
        RowStates::new(&IntervalMdp::new(parts).unwrap()).unwrap()
    }

    fn translated(text: &str) -> String {
        encoding(&["a", "b"]).translate(&text.parse().unwrap()).unwrap()
    }

    #[test]
    fn formulas_are_made_right_in_row_states() {
        for (original, encoded) in [
            (r#"Pmaxmin=? [ F<=8 "b" ]"#, r#"Pmaxmin=? [ F<=16 "b" ]"#),
            (r#"Pmaxmin=? [ F<8 !"b" ]"#, r#"Pmaxmin=? [ F<=14 (!"b" & !"row") ]"#),
            (r#"Pminmax=? [ F x=1 ]"#, r#"Pminmax=? [ F (x = 1 & !"row") ]"#),
            (r#"Pmaxmin=? [ "a" U "b" ]"#, r#"Pmaxmin=? [ ("a" | "row") U "b" ]"#),
            (r#"(Pmaxmin=? [ !"a" U<=3 "b" ])>=0.9"#, r#"(Pmaxmin=? [ !"a" U<=6 "b" ])>=0.9"#),
            (r#"P>=0.5 [ G<=2 !"a" ]"#, r#"P>=0.5 [ G<=4 !"a" ]"#),
            (r#"Pmaxmax=? [ G ("a" | x>2) ]"#, r#"Pmaxmax=? [ G ("a" | x > 2 | "row") ]"#),
            (r#"Pmaxmax=? [ G ("a" => "b") ]"#, r#"Pmaxmax=? [ G ("a" => "b") ]"#),
            (r#"Pmaxmax=? [ F ("a" <=> "b") & x=0 ]"#, r#"Pmaxmax=? [ F (("a" <=> "b") & x = 0 & !"row") ]"#),
            (r#""n": Pminmin=? [ X !"a" ]"#, r#""n": Pminmin=? [ X X !"a" ]"#),
            (r#"Pminmin=? [ F true ]"#, r#"Pminmin=? [ F (true & !"row") ]"#),
        ] {
            assert_eq!(translated(original), encoded, "{original}");
        }
    }

    #[test]
    fn the_label_is_a_new_one() {
        let encoded = encoding(&["row", "row_"]);
        assert_eq!(encoded.label, "row__");
        let property: Property = r#"Pmaxmin=? [ G "row" ]"#.parse().unwrap();
        assert_eq!(encoded.translate(&property).unwrap(), r#"Pmaxmin=? [ G ("row" | "row__") ]"#);
    }

    #[test]
    fn too_many_steps_are_refused() {
        let encoded = encoding(&["a"]);
        let property: Property = r#"Pmaxmin=? [ F<=1073741824 "a" ]"#.parse().unwrap();
        assert!(matches!(encoded.translate(&property), Err(EncodingError::Steps { steps: 1073741824, .. })));
    }
}
