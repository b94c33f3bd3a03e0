"""Spellings of units in files: English, German, French, Spanish, Italian and romanised Japanese, without regard to case.

Accents are left out here; `unit_names` removes them from the text. A plural or a trailing point that only adds `s` or `.` to
a spelling is listed where it is usual.
"""

from __future__ import annotations

# unit -> its spellings in lower case; the unit's own name is read too
SPELLINGS: dict[str, tuple[str, ...]] = {
    "s": (
        "sec", "secs", "second", "seconds", "sek", "sekunde", "sekunden", "seconde", "secondes", "seg", "segundo", "segundos",
        "secondo", "secondi", "byo",
    ),
    "ms": (
        "msec", "msecs", "millisec", "millisecond", "milliseconds", "millisekunde", "millisekunden", "milliseconde",
        "millisecondes", "milisegundo", "milisegundos", "millisecondo", "millisecondi",
    ),
    "us": ("usec", "microsecond", "microseconds", "mikrosekunde", "mikrosekunden", "microseconde", "microsecondes"),
    "min": ("mins", "minute", "minutes", "minuten", "minuto", "minutos", "minuti"),
    "h": ("hr", "hrs", "hour", "hours", "stunde", "stunden", "heure", "heures", "hora", "horas", "ora", "ore"),
    "Hz": ("hertz", "sps", "samples/s", "samples/sec", "samples/second"),
    "kHz": ("kilohertz", "ksps"),
    "m": ("meter", "meters", "metre", "metres", "metro", "metros", "metri"),
    "mm": (
        "millimeter", "millimeters", "millimetre", "millimetres", "milimetro", "milimetros", "millimetro", "millimetri",
    ),
    "cm": ("centimeter", "centimeters", "centimetre", "centimetres", "zentimeter", "centimetro", "centimetros", "centimetri"),
    "um": ("micron", "microns", "micrometer", "micrometers", "micrometre", "micrometres", "mikrometer", "micrometro"),
    "in": ("inch", "inches", '"', "''", "zoll", "pouce", "pouces", "pulgada", "pulgadas", "pulg", "pollice", "pollici"),
    "ft": ("foot", "feet", "fuss", "pied", "pieds", "pie", "pies", "piede", "piedi"),
    "mm/s": ("mmps",),
    "cm/s": ("kine", "kines"),
    "in/s": ("ips",),
    "m/s^2": ("ms-2", "ms^-2", "mps2", "mpss"),
    "cm/s^2": ("cms-2", "cms^-2", "cmps2"),
    "mm/s^2": ("mms-2", "mms^-2"),
    "gal": ("gals", "galileo", "galileos"),
    "g": ("g's", "gs", "gn", "g-force", "gforce", "grav", "standard gravity"),
    "mg": ("milli-g", "milli g", "millig", "milligs", "milli-gs"),
    "g/10": ("tenths of g", "tenth of g", "tenths of a g"),
    "kg": ("kilogram", "kilograms", "kilogramm", "kilogramme", "kilogrammes", "kilogramo", "kilogramos", "kilogrammo", "kgs"),
    "t": ("tonne", "tonnes", "metric ton", "metric tons", "tonelada", "toneladas", "tonnellata", "tonnellate"),
    "N": ("newton", "newtons", "newtonios"),
    "kN": ("kilonewton", "kilonewtons", "kilo-newton", "kilo newton", "kilonewtonios"),
    "MN": ("meganewton", "meganewtons"),
    "mN": ("millinewton", "millinewtons", "milinewton"),
    "daN": ("decanewton", "decanewtons", "dekanewton"),
    "kgf": (
        "kg-f", "kg f", "kg(f)", "kgsf", "kg force", "kg-force", "kilogram-force", "kilogram force", "kilograms force",
        "kilograms-force", "kilogramme-force", "kilogrammes-force", "kilogrammkraft", "kilogramo-fuerza", "kilogramos fuerza",
        "chilogrammo-forza", "kp", "kilopond", "kiloponds",
    ),
    "tf": (
        "t-f", "t(f)", "tonne-force", "tonne force", "tonnes-force", "tonnes force", "metric ton-force", "metric tons-force",
        "tonelada-fuerza", "toneladas fuerza", "tonnellata-forza",
    ),
    "tonf(US)": (
        "us tonf", "us ton-force", "us tons-force", "us ton force", "us ton", "us tons", "short ton-force", "short tons-force",
        "short ton", "short tons",
    ),
    "lb": ("lbs", "pound", "pounds", "livre", "livres", "libra", "libras", "libbra", "libbre"),
    "lbf": ("lbsf", "lbfs", "lb-f", "lb f", "lb(f)", "lb force", "lbs force", "pound-force", "pounds-force", "pound force"),
    "kip": ("kips", "kipf", "klb", "klbs", "klbf", "kip-force", "kilopound", "kilopounds", "kilopound-force"),
    "N/m^2": ("pascal", "pascals"),
    "kPa": ("kilopascal", "kilopascals"),
    "MPa": ("megapascal", "megapascals"),
    "GPa": ("gigapascal", "gigapascals"),
    "bar": ("bars",),
    "psi": ("lb/in^2", "lbf/in^2", "lbs/in^2", "pounds per square inch"),
    "ksi": ("kip/in^2", "kips/in^2"),
    "m/m": ("mm/mm", "in/in", "cm/cm", "strain"),
    "um/m": (
        "ue", "ustrain", "microstrain", "microstrains", "micro strain", "micro-strain", "mikrostrain", "microdef",
        "microdeformation", "microdeformacion", "microdeformazione", "mikrodehnung", "ust", "uin/in", "umm/mm",
    ),
    "V": ("volt", "volts", "voltio", "voltios", "vdc", "v dc", "volts dc"),
    "mV": ("millivolt", "millivolts", "milivoltio", "milivoltios"),
    "V/V": ("volts/volt", "volt/volt"),
    "mV/V": ("millivolts/volt", "millivolt/volt", "mv per v"),
    "A": ("amp", "amps", "ampere", "amperes", "amperio", "amperios"),
    "mA": ("milliamp", "milliamps", "milliampere", "milliamperes"),
    "deg": ("degree", "degrees", "°", "grad", "degre", "degres", "grado", "grados", "gradi", "arcdeg"),
    "rad": ("radian", "radians", "radiant", "radianes", "radianti"),
    "mrad": ("milliradian", "milliradians"),
    "count": (
        "counts", "cnt", "cnts", "adc counts", "adc count", "raw counts", "digit", "digits", "lsb", "zahlwerte", "coups",
        "cuentas", "conteggi",
    ),
    "degC": (
        "c", "°c", "deg c", "deg. c", "degrees c", "degree c", "celsius", "degrees celsius", "grad celsius", "degres celsius",
        "grados celsius", "centigrade",
    ),
    "degF": ("f", "°f", "deg f", "deg. f", "degrees f", "degree f", "fahrenheit", "degrees fahrenheit"),
    "K": ("kelvin", "kelvins"),
    "1": ("-", "unitless", "dimensionless", "dimensionslos", "sans dimension", "sin dimension", "adimensionale"),
    "%": ("percent", "pct", "prozent", "pour cent", "por ciento", "per cento"),
}  # fmt: skip

# words that state that there is no unit
NO_UNIT = frozenset({"", "none", "n/a", "na", "null", "nil", "no unit", "no units", "--"})

# text in exactly this case -> the units that it can mean; empty: none of the table. Read before SPELLINGS
AMBIGUOUS: dict[str, tuple[str, ...]] = {
    "mn": ("mN", "MN"), "Mn": ("mN", "MN"), "Mg": ("mg", "t"), "MG": ("mg", "t"), "T": ("t", "tf"), "k": ("kip", "K"),
    "mPa": (), "MV": (),
}  # fmt: skip

_TONS = ("tonf", "tonsf", "tons-f", "ton", "tons", "ton-force", "tons-force", "ton force", "tons force")

# text in any case -> the units that it can mean
AMBIGUOUS_IN_ANY_CASE: dict[str, tuple[str, ...]] = dict.fromkeys(_TONS, ("tf", "tonf(US)"))
