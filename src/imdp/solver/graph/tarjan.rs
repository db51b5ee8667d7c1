//! Strongly connected components.

/// The strongly connected components of what is reachable from `roots`, successors before predecessors.
///
/// `edges(v, out)` lists the successors of `v < nodes`. Tarjan's algorithm with its own stack, so that long
/// chains do not overflow the thread's.
pub(crate) fn strong_components(
    nodes: usize,
    roots: impl Iterator<Item = usize>,
    mut edges: impl FnMut(usize, &mut Vec<u32>),
) -> Vec<Vec<u32>> {
    const UNSEEN: u32 = u32::MAX;
    let mut index = vec![UNSEEN; nodes];
    let mut low = vec![0u32; nodes];
    let mut on_stack = vec![false; nodes];
    let (mut counter, mut stack, mut components) = (0, vec![], vec![]);
    // The path being explored; the edges of its nodes lie in `pending`, each from `start` on.
    let mut path: Vec<(usize, usize)> = vec![];
    let mut pending: Vec<u32> = vec![];
    for root in roots {
        let mut enter = (index[root] == UNSEEN).then_some(root);
        loop {
            if let Some(node) = enter.take() {
                index[node] = counter;
                low[node] = counter;
                counter += 1;
                on_stack[node] = true;
                stack.push(node as u32);
                path.push((node, pending.len()));
                edges(node, &mut pending);
            }
            let Some(&(node, start)) = path.last() else { break };
            if pending.len() > start
                && let Some(next) = pending.pop()
            {
                let next = next as usize;
                if index[next] == UNSEEN {
                    enter = Some(next);
                } else if on_stack[next] {
                    low[node] = low[node].min(index[next]);
                }
                continue;
            }
            path.pop();
            if let Some(&(parent, _)) = path.last() {
                low[parent] = low[parent].min(low[node]);
            }
            if low[node] == index[node] {
                let first = stack.iter().rposition(|&v| v as usize == node).unwrap_or(0);
                let component = stack.split_off(first);
                component.iter().for_each(|&v| on_stack[v as usize] = false);
                components.push(component);
            }
        }
    }
    components
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_come_after_what_they_reach() {
        let graph: [&[u32]; 6] = [&[1], &[2, 3], &[0], &[4], &[3, 5], &[]];
        let components = strong_components(6, 0..6, |v, out| out.extend_from_slice(graph[v]));
        let sorted: Vec<Vec<u32>> = components
            .into_iter()
            .map(|mut component| {
                component.sort_unstable();
                component
            })
            .collect();
        assert_eq!(sorted, [vec![5], vec![3, 4], vec![0, 1, 2]]);
    }

    #[test]
    fn long_chains_do_not_overflow() {
        let n = 300_000;
        let edges = |v: usize, out: &mut Vec<u32>| out.extend((v + 1 < n).then_some(v as u32 + 1));
        assert_eq!(strong_components(n, 0..n, edges).len(), n);
    }
}
