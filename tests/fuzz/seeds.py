"""A valid file of every format of the registry, as the independent writers of the tests write it."""

from __future__ import annotations

import io
import tarfile
from collections.abc import Callable

import numpy as np

from tests.engine import measurements
from tests.engine.formats.writers import (
    asa,
    at2,
    bhrc,
    catman,
    catman_ascii,
    cosmos,
    csmip,
    csmnc,
    cwb,
    dyna,
    famos,
    geonet,
    knet,
    lvm,
    matlab5,
    mdf4,
    mseed,
    mts,
    netcdf3,
    nsmn,
    opensees,
    plain,
    smc,
    tdms,
    toa5,
    tracerdaq,
    uff58,
    xlsx,
)

WAVE = np.round(58 * np.sin(0.15 * np.arange(120)) * np.exp(-np.arange(120) / 60), 4)
VALUES = [float(one) for one in WAVE]
THREE = (VALUES, [round(-0.8 * one, 4) for one in VALUES], [round(0.5 * one, 4) for one in VALUES])
COUNTS = [900 + round(50 * one) for one in VALUES]
ROWS = [(0.01 * k, one, -2 * one) for k, one in enumerate(VALUES)]
NAMES, UNITS = ("Time", "Disp", "Force"), ("s", "mm", "kN")


def _mts() -> bytes:
    return mts.written(
        mts.ENGLISH,
        [mts.block(mts.ENGLISH, NAMES, UNITS, ROWS, stamp=1.5, points=len(ROWS))],
        mts.operator(mts.ENGLISH),
    )


def _archive() -> bytes:
    raw = io.BytesIO()
    with tarfile.open(fileobj=raw, mode="w:gz") as tar:
        for direction in ("E-W", "N-S"):
            content = knet.written(knet.Record(COUNTS, direction=direction))
            info = tarfile.TarInfo(f"AOM0170806140843.{direction.replace('-', '')}")
            info.size = len(content)
            tar.addfile(info, io.BytesIO(content))
    return raw.getvalue()


def _netcdf() -> bytes:
    time = netcdf3.Variable("time", np.arange(120) / 250, ("time",), {"units": "seconds since 2024-05-06 07:08:09"})
    return netcdf3.file([time, netcdf3.Variable("force", WAVE, ("time",), {"units": "kN", "scale_factor": 0.01})])


def _columns() -> bytes:
    return plain.table(zip(*ROWS, strict=True), ["Time (s),Disp (mm),Force (kN)"]).encode()


def _workbook() -> bytes:
    return xlsx.file(xlsx.Sheet("Data", [list(NAMES), list(UNITS), *(list(row) for row in ROWS)]))


SEEDS: dict[str, tuple[str, Callable[[], bytes]]] = {
    "parquet": ("test.parquet", lambda: measurements.parquet(measurements.COLUMNS[:60])),
    "matlab73": ("test.mat", measurements.matlab73),
    "netcdf": ("test.nc", _netcdf),
    "hdf5": ("test.h5", measurements.hdf5),
    "matlab": ("test.mat", lambda: matlab5.file({"t": WAVE, "force": {"data": WAVE, "dt": 0.004, "units": "kN"}})),
    "tdms": ("test.tdms", lambda: tdms.file([tdms.Channel("rig", "force", WAVE, tdms.waveform(0.01, unit="kN"))])),
    "mdf": (
        "test.mf4",
        lambda: mdf4.file(mdf4.Group(np.arange(120) / 100, [mdf4.Channel("stroke", WAVE, "mm")])),
    ),
    "famos": ("test.raw", lambda: famos.file(famos.Channel("Kraft", WAVE, 0.005, 416.0, "kN"))),
    "catman": (
        "test.bin",
        lambda: catman.file(catman.Channel("Time", np.arange(120) / 100, "s"), catman.Channel("Kraft", WAVE, "kN")),
    ),
    "uff58": (
        "test.uff",
        lambda: uff58.file(uff58.Record(WAVE, 0.0009765625, unit="N"), uff58.Record(WAVE, binary=True)),
    ),
    "opensees-binary": ("node.bin", lambda: opensees.binary(ROWS)),
    "excel": ("test.xlsx", _workbook),
    "json": ("test.json", measurements.json_nested),
    "lvm": ("test.lvm", lambda: lvm.written([[lvm.Signal("Force", VALUES), lvm.Signal("Disp", VALUES, "mm")]])),
    "catman-ascii": (
        "test.asc",
        lambda: catman_ascii.written([("fast", [0.01 * k for k in range(120)], [("Kraft", "N", VALUES)])]),
    ),
    "mts": ("specimen.dat", _mts),
    "toa5": ("Fast.dat", lambda: toa5.written(NAMES[1:], UNITS[1:], [row[1:] for row in ROWS])),
    "tracerdaq": ("tracer.txt", lambda: tracerdaq.written(NAMES[1:], [row[1:] for row in ROWS])),
    "opensees-xml": ("node.xml", lambda: opensees.xml(ROWS, (2, 3))),
    "opensees-text": ("node.out", lambda: opensees.text(ROWS)),
    "mseed": ("test.mseed", lambda: mseed.written(mseed.Channel("BK.VALB.40.HN1", COUNTS, encoding=mseed.STEIM1))),
    "knet": ("test.NS", lambda: knet.written(knet.Record(COUNTS))),
    "knet_archive": ("AOM0170806140843.tar.gz", _archive),
    "dyna": ("test.ASC", lambda: dyna.written(dyna.Record(VALUES))),
    "geonet": ("test.V2A", lambda: geonet.written(geonet.Component("N10E", 10, [[round(one, 1) for one in VALUES]]))),
    "nsmn": ("0911.txt", lambda: nsmn.written(nsmn.Record(THREE))),
    "csmnc": ("test.dat", lambda: csmnc.written(csmnc.Record(VALUES))),
    "cwb": ("test.txt", lambda: cwb.written(cwb.Record([[round(one, 3) for one in each] for each in THREE]))),
    "bhrc": ("test.V1", lambda: bhrc.written(bhrc.Component("L", VALUES))),
    "asa": ("test.asa", lambda: asa.written(asa.Record(THREE))),
    "cosmos": ("test.V2", lambda: cosmos.written(cosmos.Channel(WAVE))),
    "csmip": ("test.V2", lambda: csmip.file(csmip.corrected(csmip.Channel(WAVE)))),
    "csmip_raw": ("test.V1", lambda: csmip.file(csmip.uncorrected(csmip.Channel(np.round(WAVE / 1000, 6))))),
    "smc": ("test.smc", lambda: smc.written(smc.Record(WAVE))),
    "at2": ("RSN1.AT2", lambda: at2.written(WAVE / 100)),
    "columns": ("test.csv", _columns),
    "record": ("record.txt", lambda: plain.record(WAVE, ["dt = 0.01 s, acceleration in gal"]).encode()),
}
