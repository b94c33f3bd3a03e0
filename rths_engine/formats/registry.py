"""Every format that is read, in the order in which a file is tried; the content of the file decides, not its name."""

from __future__ import annotations

from rths_engine.formats import apart, damage, recognised, surroundings
from rths_engine.formats.format import Format
from rths_engine.formats.laboratory import (
    catman,
    catman_ascii,
    famos,
    hdf5,
    lvm,
    matlab,
    matlab73,
    mdf,
    mts,
    netcdf,
    opensees_binary,
    opensees_text,
    opensees_xml,
    parquet,
    tdms,
    toa5,
    tracerdaq,
    uff,
)
from rths_engine.formats.plain import columns, excel, json_file, markers, record
from rths_engine.formats.source import Source
from rths_engine.formats.strong_motion import (
    asa,
    at2,
    bhrc,
    cosmos,
    csmip,
    csmip_raw,
    csmnc,
    cwb,
    dyna,
    geonet,
    knet,
    knet_archive,
    mseed,
    nsmn,
    smc,
)
from rths_engine.formats.table import Table, checked
from rths_engine.foundation.errors import FileError, Issue

FORMATS: tuple[Format, ...] = (
    parquet.FORMAT,
    matlab73.FORMAT,
    netcdf.FORMAT,
    hdf5.FORMAT,
    matlab.FORMAT,
    tdms.FORMAT,
    mdf.FORMAT,
    famos.FORMAT,
    catman.FORMAT,
    uff.FORMAT,
    opensees_binary.FORMAT,
    excel.FORMAT,
    json_file.FORMAT,
    lvm.FORMAT,
    catman_ascii.FORMAT,
    mts.FORMAT,
    toa5.FORMAT,
    tracerdaq.FORMAT,
    opensees_xml.FORMAT,
    opensees_text.FORMAT,
    mseed.FORMAT,
    knet.FORMAT,
    knet_archive.FORMAT,
    dyna.FORMAT,
    geonet.FORMAT,
    nsmn.FORMAT,
    csmnc.FORMAT,
    cwb.FORMAT,
    bhrc.FORMAT,
    asa.FORMAT,
    cosmos.FORMAT,
    csmip.FORMAT,
    csmip_raw.FORMAT,
    smc.FORMAT,
    at2.FORMAT,
)
COLUMNS, RECORD = columns.FORMAT, record.FORMAT  # text of no known format: rows of a table, or samples of one record
_OWN_MARKS = (COLUMNS, RECORD, cosmos.FORMAT)  # they refuse marks of missing values with the line; COSMOS states its mark
TITLES = tuple(one.title for one in (*FORMATS, COLUMNS))
BY_KEY = {one.key: one for one in (*FORMATS, COLUMNS, RECORD)}


def read(source: Source, otherwise: Format = COLUMNS, format: str | None = None) -> Table:
    """The table in a file; `otherwise` reads text of no known format. Raises FileError, with the lines that it names."""
    source = source.in_utf8()
    try:
        return _read(source, otherwise, format)
    except FileError as error:
        raise FileError(surroundings.shown(error.issues, source)) from None


def _read(source: Source, otherwise: Format, format: str | None) -> Table:
    if not source.head.strip():
        raise FileError(Issue("file", "is empty", fix="choose a file of measurements or a record"))
    if format is not None and format not in BY_KEY:
        raise FileError(Issue("format", "is not a known format", format, "choose one of " + ", ".join(BY_KEY)))
    chosen = BY_KEY[format] if format else detected(source, otherwise)
    with damage.refused(chosen.title):
        table = checked(apart.read(source, chosen.key) if chosen.apart else chosen.read(source))
    if chosen not in _OWN_MARKS:
        markers.refuse_in(table)
    return table


def detected(source: Source, otherwise: Format = COLUMNS) -> Format:
    """The format of a file by its content. Raises FileError for a format that is recognised but not read."""
    skipped = (
        opensees_text.FORMAT if otherwise is RECORD else None
    )  # no file of it says that it is one; a record can end with .out
    found = next((one for one in FORMATS if one is not skipped and one.looks_like(source)), None)
    if found is None:
        recognised.refuse(source)
    return found or otherwise
