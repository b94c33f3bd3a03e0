#!/usr/bin/env bash
# Times in an Excel file are rounded to whole milliseconds by python-calamine and openpyxl.
#
# Surprise:    a time column of 1024 Hz in a cell format for time comes back in steps of 1 ms with one step of zero in 42: 2 s of data have 2000 instants
#              instead of 2048. The file holds 17 digits. The same numbers in a cell without a time format come back complete.
# Version:     python-calamine 0.9.1, openpyxl 3.1.5
# Expectation: ECMA-376 (18.17.4) stores a time as a fraction of a day in double precision; Python's `timedelta` holds microseconds, so an
#              error of at most 0.5 us is expected.
# For users:   format the time column as a number (seconds) before you save the file, or map the sampling rate instead of the time column.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"${PYTHON:-python3}" -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check python-calamine==0.9.1 openpyxl==3.1.5
cd "$work"
"$work/venv/bin/python" -W ignore - <<'PY'
import sys
import zipfile
from importlib.metadata import version

import openpyxl
import python_calamine

print("python-calamine", version("python-calamine"), "openpyxl", version("openpyxl"))
rate, count = 1024, 2048
seconds = [sample / rate for sample in range(count)]
rows = "".join(
    f'<row r="{n}"><c r="A{n}" s="1"><v>{t / 86400:.17g}</v></c><c r="B{n}"><v>{t:.17g}</v></c></row>'
    for n, t in enumerate(seconds, start=1)
)
main = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
package = "http://schemas.openxmlformats.org/package/2006"
office = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
kind = "application/vnd.openxmlformats-officedocument.spreadsheetml"
files = {
    "[Content_Types].xml": f'<Types xmlns="{package}/content-types">'
    '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    f'<Override PartName="/xl/workbook.xml" ContentType="{kind}.sheet.main+xml"/>'
    f'<Override PartName="/xl/styles.xml" ContentType="{kind}.styles+xml"/>'
    f'<Override PartName="/xl/worksheets/sheet1.xml" ContentType="{kind}.worksheet+xml"/></Types>',
    "_rels/.rels": f'<Relationships xmlns="{package}/relationships">'
    f'<Relationship Id="r1" Type="{office}/officeDocument" Target="xl/workbook.xml"/></Relationships>',
    "xl/workbook.xml": f'<workbook xmlns="{main}" xmlns:r="{office}">'
    '<sheets><sheet name="test" sheetId="1" r:id="r1"/></sheets></workbook>',
    "xl/_rels/workbook.xml.rels": f'<Relationships xmlns="{package}/relationships">'
    f'<Relationship Id="r1" Type="{office}/worksheet" Target="worksheets/sheet1.xml"/>'
    f'<Relationship Id="r2" Type="{office}/styles" Target="styles.xml"/></Relationships>',
    "xl/styles.xml": f'<styleSheet xmlns="{main}"><numFmts count="1"><numFmt numFmtId="164" formatCode="[h]:mm:ss.000000"/></numFmts>'
    '<fonts count="1"><font/></fonts><fills count="1"><fill><patternFill patternType="none"/></fill></fills><borders count="1"><border/></borders>'
    '<cellStyleXfs count="1"><xf/></cellStyleXfs>'
    '<cellXfs count="2"><xf numFmtId="0"/><xf numFmtId="164" applyNumberFormat="1"/></cellXfs></styleSheet>',
    "xl/worksheets/sheet1.xml": f'<worksheet xmlns="{main}"><sheetData>{rows}</sheetData></worksheet>',
}
with zipfile.ZipFile("test.xlsx", "w") as book:
    for name, text in files.items():
        book.writestr(name, '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n' + text)

def table(read):
    return [row[0].total_seconds() for row in read], [row[1] for row in read]

calamine = table(python_calamine.CalamineWorkbook.from_path("test.xlsx").get_sheet_by_index(0).to_python())
sheet = openpyxl.load_workbook("test.xlsx").active
openpyxl_read = table([[cell.value for cell in row] for row in sheet.iter_rows()])
changed = False
print(f"expected {count} distinct instants, each within 0.0005 ms")
for name, (times, numbers) in (("python-calamine", calamine), ("openpyxl", openpyxl_read)):
    error = max(abs(a - b) for a, b in zip(times, seconds))
    distinct = len({round(t, 6) for t in times})
    print(f"{name}: {distinct} distinct instants, up to {error * 1000:.3f} ms off; as numbers: {len(set(numbers))} distinct")
    changed |= not (distinct < count and 4e-4 < error < 6e-4 and numbers == seconds)
if changed:
    sys.exit("The behaviour has changed.")
PY
