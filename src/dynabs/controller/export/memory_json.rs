//! How memories change, as self-describing JSON.

use crate::controller::Controller;
use crate::partition::CellId;
use crate::task::{HalfSpace, Standing};
use serde_json::json;

/// How memories change, if the task is an automaton.
pub(super) fn memory_tables(controller: &Controller) -> Option<serde_json::Value> {
    let task = controller.task();
    let letters = task.letters()?;
    let standing = |standing: &Standing| match *standing {
        Standing::Open(memory) => json!(memory),
        Standing::Reached => json!("done"),
        Standing::Failed => json!("failed"),
    };
    let half_space = |half_space: &HalfSpace| json!({"normal": half_space.normal, "offset": half_space.offset, "strict": half_space.strict});
    let shape = |shape: &Vec<HalfSpace>| shape.iter().map(half_space).collect::<Vec<_>>();
    let region = |shapes: &Vec<Vec<HalfSpace>>| shapes.iter().map(shape).collect::<Vec<_>>();
    Some(json!({
        "about": "a run begins in the last row of next; at every state, memory = next[memory][letter], where bit r of letter says \
                  whether the state is in region r: the bits certain[class of the cell], and those of possible[class] whose \
                  region contains the state (all half-spaces of one of its shapes: normal * x < offset if strict, else <=)",
        "memories": task.memories(),
        "next": letters.next.iter().map(|row| row.iter().map(standing).collect::<Vec<_>>()).collect::<Vec<_>>(),
        "class_of_cell": (0..controller.num_cells()).map(|cell| task.class(CellId(cell))).collect::<Vec<_>>(),
        "certain": letters.labels.iter().map(|label| label.certain).collect::<Vec<_>>(),
        "possible": letters.labels.iter().map(|label| label.possible).collect::<Vec<_>>(),
        "regions": controller.memory.letters().regions().iter().map(region).collect::<Vec<_>>(),
    }))
}
