//! Solving with a certificate that is written, read and accepted.

use imdp::certificate::{self, Certificate, FileDigest};
use imdp::model::IntervalMdp;
use imdp::property::Property;
use imdp::solver::{Answer, SolverOptions};
use imdp::verify::check;

/// Any digest: the model is in memory.
pub fn files() -> Vec<FileDigest> {
    vec![FileDigest { kind: "dynabs".into(), sha256: "0".repeat(64) }]
}

/// The answer and its certificate, which has been through a file and was accepted.
pub fn certified(
    model: &IntervalMdp,
    property: &Property,
    options: &SolverOptions<'_>,
) -> (Answer, Certificate) {
    let mut answer = Answer::new(model, property, &SolverOptions { evidence: true, ..*options }).unwrap();
    let certificate = answer.certificate(property, files()).unwrap();
    let mut bytes = vec![];
    certificate::write(&certificate, &mut bytes).unwrap();
    assert_eq!(certificate::read(&bytes).unwrap(), certificate, "{property}");
    let proved = check(&certificate, model, &files());
    let proved = proved.unwrap_or_else(|rejection| panic!("{property}: {rejection}\n{certificate:?}"));
    assert_eq!((proved.lower, proved.upper), (answer.lower, answer.upper), "{property}");
    assert_eq!(proved.verdict, answer.verdict, "{property}");
    (answer, certificate)
}
