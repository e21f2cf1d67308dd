//! Which part of a study a worker does: told, or read from what its launcher set.

/// Every `count`-th chain, beginning at `index`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Share {
    /// From 0.
    pub index: usize,
    /// 1 or more.
    pub count: usize,
}

impl Default for Share {
    /// Everything.
    fn default() -> Self {
        Share { index: 0, count: 1 }
    }
}

/// A launcher's names for rank and size, and for the first rank where that is not 0.
const LAUNCHERS: [[&str; 2]; 3] =
    [["SLURM_PROCID", "SLURM_NTASKS"], ["OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"], ["PMI_RANK", "PMI_SIZE"]];

impl Share {
    /// `3/64`: the third of 64.
    ///
    /// # Errors
    /// Anything else, in words.
    pub fn parse(text: &str) -> Result<Share, String> {
        let wrong = || format!("`{text}` is no share: as in 3/64, the third of 64");
        let (index, count) = text.split_once('/').ok_or_else(wrong)?;
        let (index, count): (usize, usize) =
            (index.trim().parse().map_err(|_| wrong())?, count.trim().parse().map_err(|_| wrong())?);
        if (1..=count).contains(&index) { Ok(Share { index: index - 1, count }) } else { Err(wrong()) }
    }

    /// Whether a chain is in it.
    pub fn holds(self, chain: usize) -> bool {
        chain % self.count == self.index
    }

    /// The share by the environment of Slurm (arrays, steps and both), MPI launchers or HyperQueue, whose size is `shards`; everything
    /// where no launcher is known.
    pub fn of_environment(variable: impl Fn(&str) -> Option<String>, shards: Option<usize>) -> Share {
        let number = |name: &str| variable(name).and_then(|text| text.trim().parse::<usize>().ok());
        let array = number("SLURM_ARRAY_TASK_ID").zip(shards.or_else(|| number("SLURM_ARRAY_TASK_COUNT")));
        let (first, step) = (number("SLURM_ARRAY_TASK_MIN").unwrap_or(0), number("SLURM_ARRAY_TASK_STEP").unwrap_or(1).max(1));
        let array = array.map(|(id, count)| (id.saturating_sub(first) / step, count));
        let ranked = LAUNCHERS.iter().find_map(|[rank, size]| number(rank).zip(number(size)));
        let (index, count) = match (array, ranked) {
            (Some((task, tasks)), Some((rank, ranks))) => (task * ranks + rank, tasks * ranks),
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => (number("HQ_TASK_ID").unwrap_or(0), shards.unwrap_or(1)),
        };
        let count = count.max(1);
        Share { index: index % count, count }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(list: &[(&str, &str)], shards: Option<usize>) -> Share {
        Share::of_environment(|name| list.iter().find(|(known, _)| *known == name).map(|(_, value)| (*value).into()), shards)
    }

    #[test]
    fn launchers_are_understood() {
        assert_eq!(of(&[], None), Share::default());
        let array = [("SLURM_ARRAY_TASK_ID", "5"), ("SLURM_ARRAY_TASK_COUNT", "4"), ("SLURM_ARRAY_TASK_MIN", "3")];
        assert_eq!(of(&array, None), Share { index: 2, count: 4 });
        assert_eq!(of(&[("SLURM_PROCID", "1"), ("SLURM_NTASKS", "2")], None), Share { index: 1, count: 2 });
        let both = [("SLURM_ARRAY_TASK_ID", "1"), ("SLURM_ARRAY_TASK_COUNT", "2"), ("SLURM_PROCID", "1"), ("SLURM_NTASKS", "3")];
        assert_eq!(of(&both, None), Share { index: 4, count: 6 });
        assert_eq!(of(&[("OMPI_COMM_WORLD_RANK", "7"), ("OMPI_COMM_WORLD_SIZE", "8")], None), Share { index: 7, count: 8 });
        assert_eq!(of(&[("PMI_RANK", "0"), ("PMI_SIZE", "2")], None), Share { index: 0, count: 2 });
        assert_eq!(of(&[("HQ_TASK_ID", "9")], Some(4)), Share { index: 1, count: 4 });
        assert_eq!(of(&[("SLURM_PROCID", "none"), ("SLURM_NTASKS", "2")], None), Share::default());
    }

    #[test]
    fn shares_are_counted_from_one() {
        assert_eq!(Share::parse("3/64"), Ok(Share { index: 2, count: 64 }));
        for wrong in ["0/4", "5/4", "3", "a/b", "1/0", ""] {
            assert!(Share::parse(wrong).unwrap_err().contains("3/64"), "{wrong}");
        }
    }

    #[test]
    fn every_chain_is_in_one_share() {
        for chain in 0..20 {
            assert_eq!((0..7).filter(|&index| Share { index, count: 7 }.holds(chain)).count(), 1);
        }
    }
}
