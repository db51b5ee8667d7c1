//! The LQR gain of 200 random systems against scipy's.
use dynabs::system::{Lqr, spectral_radius};
use nalgebra::DMatrix;
use serde_json::Value;

fn matrix(value: &Value) -> DMatrix<f64> {
    let rows: Vec<Vec<f64>> = serde_json::from_value(value.clone()).unwrap();
    DMatrix::from_fn(rows.len(), rows[0].len(), |i, j| rows[i][j])
}

#[test]
fn gains_agree_with_scipy() {
    let cases = crate::common::data("riccati.json");
    let cases = cases.as_array().unwrap();
    assert_eq!(cases.len(), 200);
    for (i, case) in cases.iter().enumerate() {
        let [a, b, q, r, k, p] = ["A", "B", "Q", "R", "K", "P"].map(|name| matrix(&case[name]));
        let lqr = Lqr::solve(&a, &b, &q, &r).unwrap_or_else(|error| panic!("case {i}: {error}"));
        assert!(lqr.residual < 1e-11, "case {i}: residual {:e}", lqr.residual);
        assert!((&lqr.cost - &p).norm() < 1e-8 * p.norm(), "case {i}: P");
        assert!((&lqr.gain - &k).norm() < 1e-8 * (1.0 + k.norm()), "case {i}: K");
        assert!(spectral_radius(&(&a - &b * &lqr.gain)) < 1.0, "case {i}: stability");
    }
}
