//! The tables of nodes, supports and loads.

use super::super::Assembly;
use crate::input::source::Written;
use crate::input::table::Tables;

impl Assembly<'_> {
    pub(super) fn node_table(&mut self, written: &Written, tables: &mut Tables<'_>) {
        let _ = (written, tables);
    }

    pub(super) fn support_table(&mut self, written: &Written, tables: &mut Tables<'_>) {
        let _ = (written, tables);
    }

    pub(super) fn load_table(&mut self, written: &Written, tables: &mut Tables<'_>) {
        let _ = (written, tables);
    }
}
