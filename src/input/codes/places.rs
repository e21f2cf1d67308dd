//! The stations at which a rib's forces are looked at.
//!
//! Codes speak of the largest compression and the largest moments along a member. Between its ends a rib without loads on its span has one
//! axial force and moments that vary linearly, so that its ends have the largest; a loaded one is looked at at all stations of the
//! structure, its axial force at both ends and at the station itself.

/// Stations of one rib under one case.
pub(in crate::input) struct Places {
    /// Of the axial force alone.
    pub axial: Vec<f64>,
    /// Of moments alone.
    pub bending: Vec<f64>,
    /// Whether something acts along the span.
    loaded: bool,
    /// Whether sections differ along it.
    tapered: bool,
}

impl Places {
    pub fn of(loaded: bool, tapered: bool, stations: &[f64]) -> Places {
        let all = || stations.to_vec();
        Places {
            axial: if loaded || tapered { all() } else { vec![0.0] },
            bending: if loaded || tapered { all() } else { vec![0.0, 1.0] },
            loaded,
            tapered,
        }
    }

    /// Stations of N, My and, in space, Mz for the interaction of all three. In a tapered rib the two moments are those of one station.
    pub fn joined(&self, space: bool) -> Vec<(f64, f64, Option<f64>)> {
        let mut list = Vec::new();
        for &y in &self.bending {
            let axial = if self.loaded { vec![0.0, y, 1.0] } else { vec![0.0] };
            let others: Vec<Option<f64>> = match (space, self.tapered) {
                (false, _) => vec![None],
                (true, true) => vec![Some(y)],
                (true, false) => self.bending.iter().map(|&z| Some(z)).collect(),
            };
            for z in others {
                for &n in &axial {
                    if !list.contains(&(n, y, z)) {
                        list.push((n, y, z));
                    }
                }
            }
        }
        list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_enough_where_nothing_acts_between() {
        let bare = Places::of(false, false, &[0.0, 0.5, 1.0]);
        assert_eq!(bare.joined(false), [(0.0, 0.0, None), (0.0, 1.0, None)]);
        assert_eq!(bare.joined(true).len(), 4);
        let loaded = Places::of(true, false, &[0.0, 0.5, 1.0]);
        assert_eq!(loaded.axial.len(), 3);
        // Two at the ends, three in the middle.
        assert_eq!(loaded.joined(false).len(), 7);
    }
}
