"""Seeds for both targets: the repository's problem files, good and bad, and those in folders given as arguments."""

import hashlib
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TABLE_ROWS = 8
LONGEST_FILE, LONGEST_TEXT = 20_000, 400


def put(target: str, data: bytes) -> None:
    folder = ROOT / "fuzz" / "corpus" / target
    folder.mkdir(parents=True, exist_ok=True)
    (folder / hashlib.sha1(data).hexdigest()).write_bytes(data)


def with_tables(path: pathlib.Path) -> bytes:
    """The file with the beginnings of its tables after it."""
    text = path.read_bytes()
    for number, table in enumerate(re.findall(rb'"([^"\n]*\.csv)"', text)[:2]):
        text = text.replace(table, (b"sections.csv", b"ribs.csv")[number])
        found = path.parent / table.decode(errors="replace")
        rows = found.read_bytes().splitlines()[:TABLE_ROWS] if found.is_file() else [b"name,kind,b,h", b"s,rectangle,1,2"]
        text += b"\n%%\n" + b"\n".join(rows) + b"\n"
    return text


for folder in [ROOT / "problems", ROOT / "tests" / "bad", *map(pathlib.Path, sys.argv[1:])]:
    for path in sorted(folder.glob("*.toml")):
        seed = with_tables(path)
        if len(seed) < LONGEST_FILE:
            put("problem_file", seed)
        for text in re.findall(r'"([^"\n]*[-+*/(<>=][^"\n]*)"', path.read_text(errors="replace")):
            if len(text) < LONGEST_TEXT:
                put("expression", text.encode())
