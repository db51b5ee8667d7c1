//! What properties mean for a kind of model.

use crate::model::ModelKind::{Idtmc, Imdp};
use crate::property::{Property, Resolution};

#[test]
fn resolutions_follow_prism() {
    use Resolution::{Pmaxmax, Pmaxmin, Pminmax, Pminmin};
    for (text, kind, resolution, threshold) in [
        ("Pmaxmin=? [ F b ]", Imdp, Pmaxmin, None),
        ("Pmaxmax=? [ F b ]", Imdp, Pmaxmax, None),
        ("Pminmin=? [ F b ]", Imdp, Pminmin, None),
        ("Pminmax=? [ F b ]", Imdp, Pminmax, None),
        ("(Pminmax=? [ F b ])<0.5", Imdp, Pminmax, Some("<0.5")),
        ("P>=0.5 [ F b ]", Imdp, Pminmin, Some(">=0.5")),
        ("P>0.5 [ G b ]", Imdp, Pminmin, Some(">0.5")),
        ("P<=0.5 [ F b ]", Imdp, Pmaxmax, Some("<=0.5")),
        ("P<0.5 [ F b ]", Imdp, Pmaxmax, Some("<0.5")),
        ("Pmin=? [ F b ]", Idtmc, Pminmin, None),
        ("(Pmax=? [ F b ])>0.5", Idtmc, Pmaxmax, Some(">0.5")),
        ("P>=0.5 [ F b ]", Idtmc, Pminmin, Some(">=0.5")),
        ("P<0.5 [ F b ]", Idtmc, Pmaxmax, Some("<0.5")),
    ] {
        let objective = text.parse::<Property>().unwrap().resolve(kind).unwrap();
        assert_eq!(objective.resolution, resolution, "{text}");
        assert_eq!(objective.threshold.map(|t| t.to_string()).as_deref(), threshold, "{text}");
    }
}

#[test]
fn ambiguous_directions_are_refused() {
    for (text, kind, words) in [
        ("Pmin=? [ F b ]", Imdp, ["PRISM reads it as Pminmin", "Storm as Pminmax"]),
        ("(Pmax=? [ F b ])>0.5", Imdp, ["PRISM reads it as Pmaxmax", "Storm as Pmaxmin"]),
        ("Pmaxmin=? [ F b ]", Idtmc, ["Pmaxmin", "expected Pmin"]),
        ("Pmaxmax=? [ F b ]", Idtmc, ["Pmaxmax", "expected Pmax"]),
        ("Pminmin=? [ F b ]", Idtmc, ["Pminmin", "expected Pmin"]),
        ("Pminmax=? [ F b ]", Idtmc, ["Pminmax", "expected Pmax"]),
    ] {
        let error = text.parse::<Property>().unwrap().resolve(kind).unwrap_err().to_string();
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
    }
}

#[test]
fn flipping_changes_both_players() {
    for resolution in Resolution::ALL {
        let flipped = resolution.flipped();
        assert_ne!(resolution.policy_maximises(), flipped.policy_maximises());
        assert_ne!(resolution.nature_maximises(), flipped.nature_maximises());
        assert_eq!(flipped.flipped(), resolution);
    }
}
