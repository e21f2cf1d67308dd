//! An order in which everything comes after what it depends on, or the circles that forbid one.

/// Nodes in a possible order, and circles: each a list of nodes, every one depending on the next and the last on the first.
/// Nodes on a circle stand in the order too, somewhere.
pub struct Order {
    /// All nodes.
    pub order: Vec<u32>,
    /// Dependencies that lead back, each with the circle it closes.
    pub circles: Vec<Vec<u32>>,
    /// For every node the length of the longest chain of dependencies below it.
    pub depth: Vec<u32>,
}

impl Order {
    fn deepen(&mut self, user: u32, needed: u32) {
        let depth = self.depth[needed as usize] + 1;
        self.depth[user as usize] = self.depth[user as usize].max(depth);
    }
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    New,
    Open,
    Done,
}

/// Depth first, without recursion: chains may be a million long. `dependencies(i)` lists what node `i` needs.
pub fn order(nodes: usize, dependencies: impl Fn(u32) -> Vec<u32>) -> Order {
    let mut state = vec![State::New; nodes];
    let mut found = Order { order: Vec::with_capacity(nodes), circles: Vec::new(), depth: vec![0; nodes] };
    let mut path: Vec<(u32, Vec<u32>)> = Vec::new();
    for root in 0..nodes as u32 {
        if state[root as usize] == State::New {
            state[root as usize] = State::Open;
            path.push((root, dependencies(root)));
        }
        while let Some((node, waiting)) = path.last_mut() {
            let node = *node;
            match waiting.pop() {
                Some(next) if state[next as usize] == State::New => {
                    state[next as usize] = State::Open;
                    path.push((next, dependencies(next)));
                }
                Some(next) if state[next as usize] == State::Open => {
                    let start = path.iter().position(|(open, _)| *open == next).unwrap_or(0);
                    found.circles.push(path[start..].iter().map(|(open, _)| *open).collect());
                }
                Some(next) => found.deepen(node, next),
                None => {
                    state[node as usize] = State::Done;
                    found.order.push(node);
                    path.pop();
                    if let Some(&(user, _)) = path.last() {
                        found.deepen(user, node);
                    }
                }
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::order;

    #[test]
    fn what_is_needed_comes_first() {
        let found = order(3, |node| {
            if node == 0 {
                vec![2]
            } else if node == 2 {
                vec![1]
            } else {
                vec![]
            }
        });
        assert_eq!(found.order, [1, 2, 0]);
        assert!(found.circles.is_empty());
    }

    #[test]
    fn circles_are_found_and_long_chains_are_no_trouble() {
        assert_eq!(order(2, |node| vec![1 - node]).circles, [[0, 1]]);
        let n = 300_000;
        let chain = order(n, |node| if node as usize + 1 < n { vec![node + 1] } else { vec![] });
        assert_eq!((chain.order.len(), chain.depth[0], chain.depth[n - 1]), (n, n as u32 - 1, 0));
    }
}
