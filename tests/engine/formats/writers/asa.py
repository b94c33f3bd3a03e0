"""Standard acceleration files of Mexico: labels with a value for each channel, rulers, names, then the channels."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Record:
    """Channels of equal length. `header`: texts that replace those that follow from the samples, by their label."""

    values: Sequence[Sequence[float]]
    dt: float = 0.005
    names: Sequence[str] = ("V", "N00E", "N90E")
    layout: str = "3F10.4"
    named: bool = True
    header: dict[str, str] = field(default_factory=dict)


def each(values: Sequence[object]) -> str:
    return "".join(f"/{one}" for one in values)


def written(record: Record) -> bytes:
    channels, samples = len(record.values), len(record.values[0])
    ruler = "---------+" * 8
    sizes = [[abs(value) for value in one] for one in record.values]
    at = [one.index(max(one)) for one in sizes]
    header = {
        "NOMBRE DE LA ESTACION": "ACAPULCO CENTRO CULTURAL", "CLAVE DE LA ESTACION": "ACAC",
        "NUMERO DE CANALES": f"{channels}", "ORIENTACION C1-C6 (rumbo;orientacion)": each(record.names),
        "ORIENTACION C7-C12 (rumbo;orientacion)": "",
        "VEL. DE MUESTREO, C1-C6 (muestras/s)": each([f"{1 / record.dt:g}"] * channels),
        "VEL. DE MUESTREO, C7-C12 (muestras/s)": "",
        "INTERVALO DE MUESTREO, C1-C6 (s)": each([f"{record.dt:g}"] * channels),
        "FECHA DEL SISMO [GMT]": "2017/09/19", "HORA EPICENTRO (GMT)": "18:14:40",
        "HORA DE LA PRIMERA MUESTRA (GMT)": "18:14:18",
        "DURACION DEL REGISTRO (s), C1-C6": each([f"{samples * record.dt:.2f}"] * channels),
        "NUM. TOTAL DE MUESTRAS, C1-C6": each([samples] * channels),
        "ACEL. MAX.(Gal), C1-C6": each([f"{one[k]:.4f}" for one, k in zip(record.values, at, strict=True)]),
        "ACEL. MAX., C1-C6, EN LA MUESTRA": each([k + 1 for k in at]),
        "ACEL. MAX.(Gal), C7-C12": "",
        "UNIDADES DE LOS DATOS": "Gal (cm/s/s)", "FORMATO DATOS (FORTRAN,10 campos/dato)": record.layout,
    } | record.header  # fmt: skip
    wide, kind = int(record.layout[2:4]), record.layout[1].lower()
    lines = ["*" * 86, " INSTITUTO DE INGENIERIA, UNAM", "ARCHIVO ESTANDAR DE ACELERACION:", "VERSION DEL FORMATO : 2.0"]
    lines += [f"{key:<39s}: {value}" for key, value in header.items()]
    lines += ["CALIDAD DEL ACELEROGRAMA:", "REGISTRO DIGITAL COMPLETO", "", "DATOS DE ACELERACION:", ruler]
    if record.named:
        lines += [
            "".join(f"{f'CANAL-{k + 1}':>10s}" for k in range(channels)),
            "".join(f"{one:>10s}" for one in record.names),
            ruler,
        ]
    digits = 4 if kind == "f" else 7
    lines += ["".join(f"{one:{wide}.{digits}{kind}}" for one in row) for row in zip(*record.values, strict=True)]
    return ("\r\n".join(lines) + "\r\n").encode()
