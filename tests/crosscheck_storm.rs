//! Storm and the shipped models: all states, both modes, all four operators, with and without a bound.
//!
//! Runs where `$DYNABS_PYTHON` is a Python with stormpy, as in `.ci/run`; with `$PRISM` set, PRISM is asked too.
use crate::common::{abstraction, reference_mode};
use dynabs::abstraction::Abstraction;
use imdp::engines::{
    Agreement, CrossCheckOptions, Engine, Finding, Handed, Prism, RunLimits, Storm, Subject, cross_check,
    raised,
};
use imdp::model::IntervalMdp;
use imdp::property::{Inquiry, PathFormula, Property, Resolution};
use imdp::solver::SolverOptions;
use std::time::Duration;

/// Inputs that keep the transitions of large models to some hundred thousand.
fn small(model: &str) -> Vec<String> {
    match model {
        "double_integrator" => vec![r#"/input={"lower":[-10],"upper":[10]}"#.into()],
        "double_integrator_two_layer" => vec![
            r#"/input={"lower":[-20],"upper":[20]}"#.into(),
            r#"/stabilizer/abstract_input={"lower":[-5,-5],"upper":[5,5]}"#.into(),
        ],
        _ => vec![],
    }
}

/// The engines that the environment names.
fn engines() -> Vec<Box<dyn Engine>> {
    let named = |variable: &str| std::env::var_os(variable).is_some_and(|value| !value.is_empty());
    let mut engines: Vec<Box<dyn Engine>> = vec![];
    if named("DYNABS_PYTHON") {
        engines.push(Box::new(Storm::find(None).unwrap()));
    }
    if named("PRISM") {
        engines.push(Box::new(Prism::find(None).unwrap()));
    }
    engines
}

fn ask(model: &IntervalMdp, properties: &[Property]) -> Vec<Finding> {
    let raised = raised(model).unwrap();
    let subject = Subject { model, raised: raised.as_ref(), handed: Handed::Copy };
    let engines = engines();
    let engines: Vec<&dyn Engine> = engines.iter().map(|engine| &**engine).collect();
    let options = CrossCheckOptions {
        solver: SolverOptions { epsilon: 1e-10, ..SolverOptions::default() },
        limits: RunLimits { timeout: Duration::from_secs(300), memory_mib: 4096, progress: &() },
    };
    let inquiries: Vec<_> = properties.iter().cloned().map(Inquiry::Probability).collect();
    cross_check(&subject, &inquiries, &engines, &options).unwrap()
}

/// The task and the same without a bound, for every operator.
fn questions(abstraction: &Abstraction) -> Vec<Property> {
    let PathFormula::Until { left, right, steps } = abstraction.property.path.clone() else { panic!() };
    let bounded = PathFormula::Until { left: left.clone(), right: right.clone(), steps };
    let unbounded = PathFormula::Until { left, right, steps: None };
    let all = |path: PathFormula| Resolution::ALL.map(|resolution| Property::value(resolution, path.clone()));
    [all(bounded), all(unbounded)].concat()
}

fn assert_agreement(what: &str, findings: &[Finding]) {
    for finding in findings {
        assert_eq!(finding.agreement, Agreement::Agrees, "{what}: {finding:#?}");
    }
}

#[test]
fn shipped_models() {
    if engines().is_empty() {
        return;
    }
    for model in crate::common::shipped_models() {
        for mode in [vec![], vec![reference_mode()]] {
            let abstraction = abstraction(&model, &[small(&model), mode.clone()].concat());
            let properties = questions(&abstraction);
            let findings = ask(&abstraction.model, &properties);
            assert_eq!(findings.len(), engines().len() * properties.len());
            assert_agreement(&format!("{model} {mode:?}"), &findings);
        }
    }
}

/// What the engines' own languages have no words for is asked in other ones.
#[test]
fn every_form_of_property() {
    let Abstraction { model, .. } = abstraction("room_temperature", &[]);
    let texts = [
        "Pmaxmin=? [ X \"reached\" ]",
        "Pmaxmin=? [ G<=6 !\"failed\" ]",
        "Pminmax=? [ G !\"failed\" ]",
        "(Pmaxmin=? [ !\"failed\" U<=6 \"reached\" ])>=0.9",
        "P>=0.1 [ F<=3 x1>=20 & x1<25 ]",
        "Pmaxmax=? [ F<=0 \"reached\" ]",
        "Pmaxmin=? [ F false ]",
        "Pminmin=? [ true U<=2 true ]",
    ];
    let properties: Vec<Property> = texts.iter().map(|text| text.parse().unwrap()).collect();
    assert_agreement("room_temperature", &ask(&model, &properties));
}
