//! Tasks over named regions, for both kinds of actions: a package to be picked up at `a` and brought to `c` without meeting `b`.

use serde_json::{Value, json};

pub fn sequence(horizon: impl Into<Value>) -> Value {
    let horizon: Value = horizon.into();
    json!({"type": "sequence", "sequence": [{"reach": "a"}, {"reach": "c", "avoid": ["b"]}], "horizon": horizon})
}

pub fn formula(text: &str, logic: &str, horizon: u64) -> Value {
    json!({"type": "formula", "formula": text, "logic": logic, "horizon": horizon})
}

/// As another tool may write `F (a & (!b U c))`.
pub const DELIVERY: &str = r#"HOA: v1
States: 3
Start: 0
AP: 3 "c" "b" "a"
Acceptance: 1 Inf(0)
--BODY--
State: 0 [!2 | !0 & 1] 0 [2 & !0 & !1] 1 [0 & 2] 2
State: 1 [!0 & !1] 1 [!0 & 1 & !2] 0 [!0 & 1 & 2] 0 [0] 2
State: 2 {0} [t] 2
--END--
"#;
