//! Workbooks read back, without the writer's library.

use std::fs;
use std::io::Read;
use std::path::Path;

/// The text of a part of a workbook.
pub fn part(path: &Path, name: &str) -> String {
    let mut archive = zip::ZipArchive::new(fs::File::open(path).unwrap()).unwrap();
    let mut text = String::new();
    archive.by_name(name).unwrap().read_to_string(&mut text).unwrap();
    text
}

/// The titles of a sheet and its rows, by the shared strings of the workbook.
pub fn sheet(path: &Path, number: usize) -> Vec<Vec<String>> {
    let unescaped = |text: &str| text.replace("&amp;", "&").replace("&lt;", "<");
    let strings = part(path, "xl/sharedStrings.xml");
    let strings: Vec<String> = strings
        .split("<si>")
        .skip(1)
        .map(|item| unescaped(item.split_once('>').unwrap().1.split("</t>").next().unwrap()))
        .collect();
    let cell = |text: &str| {
        let value = text.split("<v>").nth(1).map_or("", |rest| rest.split("</v>").next().unwrap());
        if text.contains("t=\"s\"") { strings[value.parse::<usize>().unwrap()].clone() } else { value.to_owned() }
    };
    let column = |text: &str| {
        text.split('"')
            .next()
            .unwrap()
            .bytes()
            .take_while(u8::is_ascii_uppercase)
            .fold(0, |at, letter| 26 * at + usize::from(letter - b'A') + 1)
    };
    let rows = part(path, &format!("xl/worksheets/sheet{number}.xml"));
    let row = |text: &str| {
        let mut cells = Vec::new();
        for part in text.split("<c r=\"").skip(1) {
            cells.resize(column(part).max(cells.len()), String::new());
            *cells.last_mut().unwrap() = cell(part);
        }
        cells
    };
    rows.split("<row ").skip(1).map(row).collect()
}

/// The names of the sheets in their order.
pub fn sheet_names(path: &Path) -> Vec<String> {
    let sheets = part(path, "xl/workbook.xml");
    sheets.split("<sheet name=\"").skip(1).map(|rest| rest.split('"').next().unwrap().to_owned()).collect()
}
