//! What is put together from all finished chains.

use super::store::{Store, StoreError, TABLE};
use super::table::Table;
use super::{Study, pictures};

/// Puts the table of what is finished by now, and its pictures, into the study's folder; the table.
///
/// # Errors
/// Whatever the file system says.
pub fn merge(study: &Study, store: &Store) -> Result<Table, StoreError> {
    let table = Table::of(study, store);
    store.put(TABLE, |out| table.write(study, out))?;
    for (name, picture) in pictures::pictures(study, &table) {
        store.put(&name, |out| out.write_all(picture.as_bytes()))?;
    }
    Ok(table)
}
