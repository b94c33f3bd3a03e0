"""The words of column names and the roles that they mean, in the languages of files.

Words are in lower case and without accents: English, German, French, Spanish, Italian, romanised Japanese, and the recorders of
OpenSees and OpenFresco.
"""

from __future__ import annotations

import re

FLOOR = "(floor|storey|story|level|roof|mass|dof|etage|stockwerk|geschoss|piso|planta|piano)"
_GROUND = "(ground|base|table|input|shake|boden|fundament|rutteltisch|sol|suelo|terreno|tavola)"
_ACCELERATION = r"(acc|accel\w*|acceler\w*|acel\w*|\w*beschleunigung\w*|beschl|kasokudo)"
_FORCE = (
    r"(force|forces|load|loads|\w*kraft|kraefte|\w*last|belastung|restoring|lc|loadcell|fmeas|f|frc|reaction|effort|charge|fuerza"
    r"|carga|forza|carico|kaju|kajuu)"
)
_VELOCITY = r"(vel\w*|speed|\w*geschwindigkeit|geschw|vitesse|velocidad|velocita|sokudo)"
_DISPLACEMENT = (
    r"(disp\w*|dsp|position|pos|stroke|lvdt|travel|extension|deformation|elongation|\w*weg|verschiebung|auslenkung|hub"
    r"|deplacement|course|allongement|desplazamiento|recorrido|spostamento|corsa|heni|hen i)"
)

# role -> pattern of its column names; the first match counts
ROLES: tuple[tuple[str, re.Pattern[str]], ...] = tuple(
    (role, re.compile(pattern))
    for role, pattern in (
        (
            "t",
            r"^(t|time|times|timestamp|elapsed|zeit|temps|tiempo|tempo|jikan|sec|seconds|clock|x value)$"
            r"|^(time|elapsed|zeit|temps|tiempo)\b|\b(time|zeit)$|^(mess|lauf)zeit\b",
        ),
        ("temperature", r"\btemp(erature?|eratur|eratura)?s?\b|\btherm|\btc\b"),
        (
            "ag",
            rf"\bag\b|\b{_GROUND}\b.*\b{_ACCELERATION}\b|\b{_ACCELERATION}\b.*\b{_GROUND}\b|\beq acc"
            r"|\b(boden|fundament)beschleunigung\b",
        ),
        ("a_floor", rf"\ba floor\b|\b{_ACCELERATION}\b|\b(udotdot|uddot|xddot)\b"),
        ("force_ext", r"\bforce ext\b|\b(external|ext|applied|hammer|exciter|shaker)\b.*\b(force|load)|\bhammer\b"),
        ("x_comp", r"\bx comp\b|\bcompensated\b|\bcomp\b|\bctrl (dsp|disp)\b"),
        (
            "x_cmd",
            r"\bx cmd\b|\bx ?c\b|\b(cmd|command\w*|targ|target|ref|reference|setpoint|set point|desired|qg|demand)\b"
            r"|\b(soll\w*|consigne|consigna|comando)\b",
        ),
        ("f_meas", rf"\bf meas\b|\b{_FORCE}\b|\b(pr|pm)\b"),
        ("v_floor", rf"\bv floor\b|\b{FLOOR}\b.*\b{_VELOCITY}\b|\b{_VELOCITY}\b.*\b{FLOOR}\b"),
        ("v_meas", rf"\bv meas\b|\b{_VELOCITY}\b|\b(v|xdot|udot|dx|qdot)\b"),
        ("current", r"\bcurrent\w*|\bcurr\b|\bamp(s|ere\w*)?\b|\bi\b|\b(strom|courant|corriente|corrente)\b"),
        (
            "coil_voltage",
            r"\b(coil|spule\w*|magnet|mr)\b.*\b(voltage|volts?|spannung|tension)\b|\b(voltage|spannung)\b.*\b(coil|spule\w*)\b",
        ),
        (
            "drive",
            r"\bdrive\b|\bcontrol\w*|\bexcit\w*|\bvalve\b|\bservo\b|\binput\b|\b(voltage|spannung|tension)\b|\bu\b|\bvir\b",
        ),
        ("x_floor", rf"\bx floor\b|\b{FLOOR}\b"),
        ("x_meas", rf"\bx meas\b|\b{_DISPLACEMENT}\b|\b(ist\w*|actuator|qm|um|x|d|y|q)\b"),
    )
)

BY_DIMENSION = {
    "time": "t",
    "length": "x_meas",
    "velocity": "v_meas",
    "acceleration": "a_floor",
    "force": "f_meas",
    "current": "current",
    "temperature": "temperature",
}

# words of columns that no unit explains and that are no measurement, with the reason
ASIDE: tuple[tuple[re.Pattern[str], str], ...] = (
    (
        re.compile(
            r"\b(cycles?|zyklen|zyklus|zyklenzahl|lastspiele?|lastwechsel|ciclos?|cicl[io]|segments?)"
            r"( (count|number|num|no|nr|id))?$|^(n|no|nr|number of) (cycles|segments)\b"
        ),
        "counts cycles or segments, and is not a measurement",
    ),
    (
        re.compile(
            r"^(samples?|scans?|records?|points?|index|idx|row|line|nr|no|messpunkt|messwert|muestra|campione|echantillon)"
            r"( (number|num|no|nr|nummer|id|index|count|numero))?$"
        ),
        "is a sample number, not a time",
    ),
    (
        re.compile(r"^(spannung|tension|esfuerzo|sforzo|contrainte)( \w)?$"),
        "can be a voltage or a stress (or a force): state its unit in the file, or give it a role",
    ),
    (
        re.compile(r"\b(strain|\w*dehnung|gauge|gage|dms|hizumi|stress)\b"),
        "is a strain or a stress by its name: no role is one",
    ),
    (re.compile(r"^(untitled|comment|kommentar|unbenannt|events?|status|flags?)$"), "has a name without a meaning"),
)

IS_DRIVE = re.compile(r"\b(drive|control\w*|excit\w*|valve|servo|vir|input)\b")  # and not the letter u alone
OF_RECORDER = re.compile(r"\bbatt(ery|erie|eria)?\b|\b(aux\w*|analog\w*|digital|spare)\b.*\binput\b|\bpanel temp\b")

# words that tell the reading of a transducer from its calibrated measurement
OF_READING = re.compile(
    r"\b(raw|roh\w*|brut\w*|crudo|grezz\w|uncal\w*|unkal\w*|reading|signal|volts?|voltage|spannung|counts?|adc)\b"
    r"|\b(cal|calib\w*|kalib\w*|etalonn\w*|calibrad\w|tarat\w|eng|engineering|scaled|skaliert)\b"
)

AZIMUTH = re.compile(
    r"[-+]?\b\d{1,3}(?:\.\d+)?\s*(?:degrees?|deg|°|grad)(?![A-Za-z])|\b[NS]\s*\d{1,2}\s*[EW]\b|\baz(?:imuth|imut)?\.?\s*[:=]?\s*\d{1,3}\b",
    re.IGNORECASE,
)
