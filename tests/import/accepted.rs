//! What is read, and how it is shared.

use imdp::formats::prism::import_with_progress;
use imdp::formats::{Imported, Place, Warning};
use imdp::model::{ActionNames, ModelKind, RowBuffer, RowId, RowRange, StateId, VariableValues};

use super::{Files, LAB, STA, TRA, assert_refused, import_texts};

#[test]
fn a_model_is_read() {
    let Imported { model, warnings, .. } = import_texts(TRA, Some(STA), LAB).unwrap();
    assert_eq!(warnings, []);
    assert_eq!(model.kind(), ModelKind::Imdp);
    assert_eq!((model.size().choices, model.size().transitions, model.size().rows), (3, 4, 1));
    assert_eq!(model.rows().to_stored().row(RowId(0)).successors, [1, 2].map(StateId));
    assert_eq!(model.rows().to_stored().row(RowId(0)).lower, [0.2, 0.2]);
    assert!(model.choices().is_absorbing(StateId(1)) && model.choices().is_absorbing(StateId(2)));
    let expected = ActionNames::OfChoice {
        names: vec!["a".to_owned(), "b".to_owned()],
        ids: vec![0, 1, ActionNames::UNNAMED],
    };
    assert_eq!(*model.actions(), expected);
    assert_eq!(model.initial().ones().collect::<Vec<_>>(), [0]);
    let labels: Vec<_> = model.labels().iter().map(|(name, set)| (name, set.ones().collect())).collect();
    assert_eq!(labels, [("deadlock", vec![]), ("goal", vec![1])]);
    assert_eq!(model.variables().get("x").unwrap().values, VariableValues::Int(vec![3, -1, 0]));
    let VariableValues::Bool(b) = &model.variables().get("b").unwrap().values else { panic!() };
    assert_eq!(b.ones().collect::<Vec<_>>(), [0, 2]);
}

#[test]
fn oddities_are_accepted() {
    let plain = import_texts(TRA, Some(STA), LAB).unwrap().model;
    let crlf = |text: &str| text.replace('\n', "\r\n");
    let same = [
        (crlf(TRA), crlf(STA), crlf(LAB)),
        (TRA.trim_end().to_owned(), STA.trim_end().to_owned(), LAB.trim_end().to_owned()),
        (crlf(TRA).trim_end().to_owned(), crlf(STA).trim_end().to_owned(), crlf(LAB).trim_end().to_owned()),
        (format!("{TRA}\n\n"), format!("{STA}\n"), format!("{LAB}\r\n")),
        // As PRISM exports them.
        (format!("# Transitions (IMDP)\n#\n{TRA}"), format!("# States\n{STA}"), format!("# Labels\n{LAB}")),
        (TRA.replace("[1,1]", "1"), STA.to_owned(), LAB.to_owned()),
        (TRA.replace("[1,1]", "[1.0,1e0]"), STA.to_owned(), LAB.to_owned()),
        (TRA.to_owned(), STA.to_owned(), LAB.replace("0: 0\n1: 2\n", "1: 2\n0: 0\n")),
        (TRA.replace("0 0 1 [0.2,0.8] a\n0 0 2", "0 0 2 [0.2,0.8] a\n0 0 1"), STA.to_owned(), LAB.to_owned()),
    ];
    for (tra, sta, lab) in same {
        let read = import_texts(&tra, Some(&sta), &lab).unwrap_or_else(|error| panic!("{tra:?}: {error}"));
        assert_eq!(read.model, plain, "{tra:?}");
        assert_eq!(read.warnings, []);
    }
    let several = import_texts(TRA, None, "0=\"init\" 1=\"deadlock\"\n0: 0 1\n2: 0\n").unwrap().model;
    assert_eq!(several.initial().ones().collect::<Vec<_>>(), [0, 2]);
    let zero = import_texts("2 1 2\n0 0 0 [0,1]\n0 0 1 [0.0,1]\n", None, "0=\"init\"\n0: 0\n").unwrap();
    assert_eq!(zero.model.rows().to_stored().row(RowId(0)).lower, [0.0, 0.0]);
}

#[test]
fn decimals_decide_sums() {
    let tenths: String = (0..10).map(|state| format!("0 0 {state} 0.1\n")).collect();
    let read = import_texts(&format!("10 1 10\n{tenths}"), None, "0=\"init\"\n0: 0\n").unwrap();
    assert!(matches!(read.warnings[..], [Warning::Deadlocks { count: 9, first: StateId(1) }]));

    let tra = "3 3 5\n0 0 0 [0,1]\n0 0 1 [0,1]\n1 0 0 0.5\n1 0 1 0.4999999995\n2 0 2 [1,1]\n";
    let read = import_texts(tra, None, "0=\"init\"\n0: 0\n").unwrap();
    let [warning @ Warning::Widened { count: 1, first }] = &read.warnings[..] else { panic!() };
    assert_eq!(first.place, Place::Text { line: 4, column: 1 });
    assert!(warning.to_string().contains("m.tra:4:1"));
    let buffer = &mut RowBuffer::default();
    let row = read.model.rows().row(RowId(1), buffer);
    assert_eq!(row.lower, [0.5, 0.4999999995]);
    assert!(row.upper[0] > 0.5 && row.upper[0] + row.upper[1] >= 1.0 && row.upper[1] < 0.500000001);
}

#[test]
fn rows_are_shared() {
    let row =
        |state: u32, choice: u32, p: &str| format!("{state} {choice} 0 [{p},1]\n{state} {choice} 1 [0,1]\n");
    let mut tra = "4 9 17\n".to_owned();
    for state in 0..2 {
        for (choice, p) in (0..).zip(["0.1", "0.2", "0.3"]) {
            tra += &row(state, choice, p);
        }
    }
    // State 2 stays in one of two choices, so it is no absorbing state. State 3 has no choice.
    tra += &format!("2 0 2 1\n{}2 2 0 [0.10,1]\n2 2 1 [0,1]\n", row(2, 1, "0.3"));
    let Imported { model, warnings, .. } = import_texts(&tra, None, "0=\"init\"\n0: 0\n").unwrap();
    assert_eq!(warnings, [Warning::Deadlocks { count: 1, first: StateId(3) }]);
    assert_eq!(model.rows().len(), 4);
    assert_eq!(model.choices().ranges(StateId(0)), [RowRange { first: RowId(0), last: RowId(2) }]);
    assert_eq!(model.choices().ranges(StateId(0)), model.choices().ranges(StateId(1)));
    assert_eq!(model.choices().rows(StateId(2)).collect::<Vec<_>>(), [3, 2, 0].map(RowId));
    assert!(model.choices().is_deadlock(StateId(3)) && !model.choices().is_absorbing(StateId(2)));
    assert_eq!(*model.actions(), ActionNames::None);
}

#[test]
fn interval_chains_are_read() {
    let tra = "3 4\n0 1 [0.1,0.9]\n0 2 [0.1,0.9]\n1 1 1\n2 0 1\n";
    let model = import_texts(tra, None, "0=\"init\"\n0: 0\n").unwrap().model;
    assert_eq!(model.kind(), ModelKind::Idtmc);
    assert_eq!((model.size().choices, model.size().transitions), (3, 4));
    assert!(model.choices().is_absorbing(StateId(1)));
}

#[test]
fn long_files_are_read_like_short_ones() {
    // Long enough for many chunks; every state has its own rows, except for the last.
    let (states, width) = (20_000, 8);
    let mut tra = format!("{states} {} {}\n", 2 * states, 2 * width * states);
    for line in 0..2 * states * width {
        let (state, choice) = (line / width / 2, line / width % 2);
        let lower = 1 + (state * 7 + choice * 3) % 1000;
        tra += &format!("{state} {choice} {} [0.0{lower:04},1] act{choice}\n", line % width + state % 100);
    }
    let lab = "0=\"init\"\n0: 0\n";
    let model = import_texts(&tra, None, lab).unwrap().model;
    assert_eq!(model.size().transitions, 2 * states * width);
    assert_eq!(model.rows().row_len(model.choices().rows(StateId(19_999)).last().unwrap()), 8);
    let wrong = tra.replacen("\n19000 1 0 ", "\n19000 1 x ", 1);
    assert_refused("long", import_texts(&wrong, None, lab), "m.tra:304010:9", &["`x`"]);
}

#[test]
fn progress_ends_with_the_file() {
    let files = Files::new(TRA.as_bytes(), None, LAB.as_bytes());
    let mut seen = 0;
    import_with_progress(&files.tra(), None, None, &mut |bytes| seen = bytes).unwrap();
    assert_eq!(seen, TRA.len() as u64);
}

#[test]
fn a_choice_may_be_longer_than_a_chunk() {
    let width = 100_000;
    let mut tra = format!("{width} 2 {}\n", width + 1);
    (0..width).rev().for_each(|to| tra += &format!("0 0 {to} [0.0,0.00002]\n"));
    tra += "7 0 7 1\n";
    let model = import_texts(&tra, None, "0=\"init\"\n0: 0\n").unwrap().model;
    assert_eq!(model.rows().to_stored().row(RowId(0)).len(), width);
    assert!(model.choices().is_absorbing(StateId(7)) && model.choices().is_deadlock(StateId(8)));
}

#[test]
fn layout_changes_nothing() {
    let plain = import_texts(TRA, Some(STA), LAB).unwrap();
    // Blank lines, comments, blanks and tabs, any order, numbers in other forms.
    let tra =
        "# T\n3  3\t4 \n\n2 0 2 [1., 1]\n1 0 1 [+1,4/4]\tb\n# x\n0 0 2  [.2,8e-1] a\n0 0 1 [1/5, 4/5] a \n";
    let sta = "# States\n( x, b )\n2:(0,True)\n\n0: (3,true)\n1:(-1,False,)\n";
    let lab = "0=\"init\"  1=\"deadlock\" 2=\"goal\" \n\n1:2\n1: 2\n0: 0 0\n2:\n";
    for (tra, sta, lab) in [(tra, STA, LAB), (TRA, sta, LAB), (TRA, STA, lab), (tra, sta, lab)] {
        let read = import_texts(tra, Some(sta), lab).unwrap();
        assert_eq!(read.model, plain.model);
        let odd = read.warnings.iter().any(|warning| matches!(warning, Warning::Layout { .. }));
        assert_eq!(odd, tra != TRA);
    }
}

#[test]
fn names_need_not_be_identifiers() {
    let tra = TRA.replace(" b\n", " -1\n").replace(" a\n", " a-b\n");
    let lab = LAB.replace("goal", "reach me!");
    let model = import_texts(&tra, Some(STA), &lab).unwrap().model;
    assert_eq!(model.actions().name(0, None).unwrap(), "a-b");
    assert_eq!(model.actions().name(1, None).unwrap(), "-1");
    assert!(model.labels().get("reach me!").unwrap().contains(1));
}

#[test]
fn variables_that_are_no_integers_are_left_out() {
    let sta = "(x,b)\n0:(0.5,true)\n1:(1,false)\n2:(2,true)\n";
    let Imported { model, warnings, .. } = import_texts(TRA, Some(sta), LAB).unwrap();
    assert!(model.variables().get("x").is_none() && model.variables().get("b").is_some());
    assert!(matches!(&warnings[..], [Warning::Ignored { what, .. }] if what.contains("x")), "{warnings:?}");
}
