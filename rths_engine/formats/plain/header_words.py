"""How headers name what they state, in English, German, French, Spanish, Italian, Portuguese, Turkish, Japanese and Chinese.

Patterns for text in lower case without accents. A label that can also mean something else ("rate" of loading, "frequency" of
a sine, "length" of a specimen) is listed only in a form that cannot.
"""

from __future__ import annotations

import re
import unicodedata

from rths_engine.foundation import unit_text

_GROUP = "['\u2019\u00a0\u202f]"  # between thousands
NUMBER = (
    rf"[-+]?(?:\d{{1,3}}(?:,\d{{3}})+\.\d+|\d{{1,3}}(?:{_GROUP}\d{{3}})+(?:[.,]\d+)?|\d+(?:[.,]\d+)?|[.,]\d+)"
    r"(?:[ed][-+]?\d+)?(?![\d]|[.,]\d)"
)
BRACKET = r"(?:\s*[(\[]\s*(?P<bracket>[^)\]]{0,24}?)\s*[)\]])?"
IS = r"\s*(?:[:=,;\t]|\.{2,}|\bis\b|\bof\b)*\s*"

_OF_DATA = (
    r"(?:(?:acceleration|accel|data|sample|raw|total|time|discrete|recorded)\s+)*"
    r"(?:data|data\s*points?|points?|pts|samples?|values?|scans|ordinates)\b(?:\s+(?:recorded|in\s+record))?"
)
COUNT = "|".join(
    (
        r"n_?pts?|npoints?|n_?samples?|ndata|n_?data",
        rf"(?:total\s+)?(?:number|num|no|nr|nb)\b\.?\s*(?:of\s+)?{_OF_DATA}|#\s*(?:of\s+)?{_OF_DATA}",
        r"(?:data\s*points?|sample\s*count|samples|points|total\s+samples|scans|record\s+points)(?=\s*[:=])",
        r"(?:anzahl|zahl)\s+(?:der\s+)?(?:daten(?:punkte)?|messpunkte|messwerte|werte|punkte|abtastwerte|samples|proben)",
        r"datenpunkte|messwerte(?=\s*[:=])|werteanzahl|punktzahl|anzahl(?=\s*[:=])",
        r"(?:nombre|nb|nbre)\b\.?\s+(?:de\s+|d['\u2019]\s*)?(?:points|donnees|echantillons|valeurs|mesures|pts)",
        r"(?:numero|num|nro|no|n|cantidad|total|quantidade)\b\.?\s*(?:(?:de|di|dei|dos)\s+)?(?:datos|puntos|muestras|valores|punti|campioni"
        r"|dati|valori|dados|pontos|amostras)",
        r"(?:veri|nokta|ornek)\s+sayisi|\u30c7\u30fc\u30bf\u6570|\u30b5\u30f3\u30d7\u30eb\u6570|(?:\u6570\u636e|\u91c7\u6837|\u6837)?\u70b9\u6570",
    )
)
COUNT_AFTER = (
    r"(?:(?:acceleration|accel|data|sample)\s+)*(?:points|samples|values|datenpunkte|messwerte|werte|puntos|datos|muestras|punti"
    r"|campioni|dati|echantillons|donnees)\b(?!\s*(?:/|per\b|pro\b|par\b|por\b|al\b|a\s+line|each|in\s+each))"
)

_PER = r"(?:/|\bper\b|\bpro\b|\bpar\b|\bpor\b|\bal\b)"
_SAMPLES = r"(?:samples?|smpls?|pts|points|scans|readings?|values?|mesures?|werte|muestras|campioni|echantillons|ornek)"
_SECOND = r"s(?:ec\w*|ekunde|egundo|econdo|n|aniye)?"
_MINUTE = r"min(?:ut\w*|\.)?"
_HOUR = r"(?:h(?:r|our)?|std|stunde|hora|heure|ora)"
PER_SECOND = rf"(?:k(?:ilo)?\s*(?={_SAMPLES}|s\s*/))?(?:{_SAMPLES}|s|1)?\s*{_PER}\s*{_SECOND}\b"
PER_LONGER = rf"(?:{_SAMPLES}|s|1)?\s*{_PER}\s*(?:{_MINUTE}|{_HOUR})(?![a-z])|(?:min|h)\^?-1\b"
PER_HOUR = rf"{_PER}\s*{_HOUR}(?![a-z])|h\^?-1"
RATE_UNIT = rf"k?hz\b|k?sps\b|(?:kilo)?hertz\b|{PER_SECOND}|{PER_LONGER}|s\^?-1\b"
OTHER_RATE_UNIT = rf"(?!\s*{_PER}\s*(?:ch|k?can))\s*(?:[a-z]*hz\b|[a-z]*\s*{_PER}\s*[a-z]+|[a-z]+\^?-1\b|cpm\b)"
DECIMATED = re.compile(
    r"(?:(?:decimat|dezimier|dezimation|decimaci|decimaz|downsampl|down-sampl|subsampl|sub-sampl)\w*"
    r"|(?:data\s+)?reduction\s+(?:factor|ratio))\s*(?:factor|ratio|faktor|by|of|to|from|auf|um|von|:|=|,|;|\t|\()*\s*(?P<v>\d+(?:\.\d+)?)"
    r"|every\s+(?P<e>\d+)(?:st|nd|rd|th)\s+(?:sample|point|scan|value)"
)
RATE = "|".join(
    (
        rf"sps(?=\s*[:=,;\t(\[]\s*\d)|{_SAMPLES}\s*{_PER}\s*(?:{_SECOND}|{_MINUTE})(?=\s*[:=,;\t]\s*\d)",
        r"samp(?:l(?:e|ing))?\.?\s*(?:rate|freq(?:uency|\.)?)|\bfs(?=\s*[:=(\[])|f_s|samplerate|samplefreq",
        r"(?:scan|acquisition|acq|daq|data|storage|logging|log|recording|record|digiti[sz]ation|digiti[sz]ing|save|output|"
        r"reading)\s*(?:rate|freq(?:uency|\.)?)",
        r"abtast(?:rate|frequenz)|mess(?:rate|frequenz)|(?:aufzeichnungs|speicher|erfassungs)rate",
        r"(?:frequence|taux|cadence|vitesse)\s+(?:d['\u2019]\s*|de\s+)(?:echantillonnage|acquisition|mesure)",
        r"(?:frecuencia|tasa|velocidad)\s+de\s+(?:muestreo|adquisicion)|(?:frequencia|taxa)\s+de\s+(?:amostragem|aquisicao)",
        r"(?:frequenza|velocita|tasso)\s+di\s+(?:campionamento|acquisizione)|ornekleme\s+(?:frekansi|hizi|orani)",
        r"ornekleme\s+sikligi|(?:frequency|frequenz)\s+of\s+sampling",
        r"\u30b5\u30f3\u30d7\u30ea\u30f3\u30b0(?:\u5468\u6ce2\u6570|\u30ec\u30fc\u30c8)|\u91c7\u6837(?:\u9891\u7387|\u7387)",
    )
)
RATE_BEFORE = (
    r"(?:sampled|acquired|recorded|digiti[sz]ed|abgetastet|aufgezeichnet|echantillonne\w*|muestreado|campionat\w+)"
    r"\s+(?:at|with|mit|bei|a|con)\s+"
)

TIME_UNIT = (
    r"(?:ms(?:ec)?|milli\w*|us(?:ec)?|[u\u00b5\u03bc]s|s(?:ec(?:ond)?s?)?|sek\w*|seg\w*|second\w*"
    r"|min(?:utes?|uten|uti)?|h(?:ours?)?)\b"
)
STEP = "|".join(
    (
        r"\bdt\b|[\u03b4\u2206\u0394]\s*t\b|delta[ _]?t\b|d_t|time[ _-]?(?:step|interval|increment)s?|timestep",
        r"(?:sampl(?:e|ing)|scan|acquisition|recording|data|storage|logging|digiti[sz]ing)\s*(?:time\s*)?(?:interval|period|step|"
        r"increment|spacing)",
        r"zeitschritt(?:weite)?|abtast(?:intervall|zeit|periode|schritt)|messintervall|zeitintervall",
        r"pas\s+(?:de\s+temps|d['\u2019]\s*(?:echantillonnage|acquisition)|temporel)|(?:periode|intervalle)\s+(?:de\s+temps|"
        r"d['\u2019]\s*(?:echantillonnage|acquisition))",
        r"(?:intervalo|paso|periodo|passo)\s+de\s+(?:muestreo|tiempo|amostragem|tempo)",
        r"(?:passo|intervallo|periodo)\s+(?:di\s+(?:campionamento|tempo)|temporale)|ornekleme\s+araligi",
        r"(?:\u30b5\u30f3\u30d7\u30ea\u30f3\u30b0|\u91c7\u6837|\u65f6\u95f4)(?:\u9593\u9694|\u95f4\u9694)",
    )
)
STEP_WITH_UNIT = r"\b(?:step|interval|intervall|intervallo|intervalo|pas|paso|passo|schrittweite)\b"
STEP_BEFORE = r"(?:(?:spaced|intervals?)\s+(?:at|of)|\bevery|\balle|\btoutes\s+les|\bcada|\bogni|points\s+at)\s+"

DURATION = (
    r"(?:(?:total|record(?:ing|ed)?|test|signal)\s+)?duration(?:\s+time)?|record\s*length|length\s+of\s+record|total\s+time"
    r"|(?:mess|aufzeichnungs|versuchs|gesamt|signal)?dauer|messzeit|duree(?:\s+(?:totale|de\s+l['\u2019]?\s*\w+|d['\u2019]\s*\w+))?"
    r"|duracion(?:\s+(?:total|del?\s+\w+))?|durata(?:\s+\w+)?|duracao|kayit\s+suresi"
)
START = (
    r"(?:record(?:ing)?\s+|test\s+|data\s+|acquisition\s+)?(?:start(?:ed)?|begin(?:ning)?)(?:\s*time)?(?:\s+at)?|t_?min|start_?time"
    r"|(?:start|anfangs)zeit|beginn|debut|heure\s+de\s+debut|(?:hora\s+de\s+)?inicio|(?:ora\s+di\s+)?inizio|baslangic"
)
END = (
    r"(?:record(?:ing)?\s+|test\s+|data\s+|acquisition\s+)?(?:end(?:ed)?|stop(?:ped)?|finish(?:ed)?)(?:\s*time)?(?:\s+at)?|t_?max|t_?end"
    r"|end_?time|stop_?time|(?:end|stopp?)zeit|ende|(?:heure\s+de\s+)?fin|(?:hora\s+(?:de\s+fin|final))|(?:ora\s+di\s+)?fine|bitis"
)
OTHER_DURATION = re.compile(
    r"5\s*-\s*[79]5|significant|bracketed|arias|strong|pre-?\s?(?:event|trigger)|post-?\s?(?:event|trigger)"
)

_OF = (
    r"(?:acc\w*|vel\w*|disp\w*|value|amplitude|load|force|stroke|beschleunigung|kraft|last|weg|verschiebung|ivme|kuvvet"
    r"|aceleracion|carga|fuerza|desplazamiento|valor|aceleracao|forca|deslocamento|effort|charge|deplacement|valeur"
    r"|accelerazione|carico|forza|spostamento|valore|deger)"
)
_GREATEST = r"max(?:\.|imum|imal\w*|im[ao]|imale)?|massim[ao]|maksimum|pico|en\s+buyuk"
_LEAST = r"minimum|minimal\w*|minim[ao]|minimale|minimo|en\s+kucuk|min\."
PEAK = (
    r"(?:raw\s+|corrected\s+)?pg[avd]\b(?:\s+values?)?"
    rf"|(?:peak|{_GREATEST}|abs\.?\s*max(?:imum)?)\s+(?:ground\s+)?{_OF}\b\.?"
    r"|abs(?:olute)?\.?\s*max(?:imum|\.)?(?![a-z])|max(?:imum|\.)?\s*abs(?:olute)?\.?(?:\s+value)?(?![a-z])"
    r"|(?:peak|max(?:\.|imum)?)(?=\s*[(\[:=,;\t]\s*[-+\d.a-z])|a_?max\b|[fp]_?max\b|spitzen(?:wert|beschleunigung|kraft|last)|maximalwert"
    rf"|(?:hochst|maximal)(?:wert|kraft|last|weg)|{_OF}\s+(?:{_GREATEST}|di\s+picco|de\s+pico|pico)(?![a-z])"
    r"|(?:\u6700\u5927|\u5cf0)(?:\u52a0\u901f\u5ea6|\u8377\u91cd|\u5024|\u503c|\u529b|\u5909\u4f4d|\u4f4d\u79fb)"
)
MINIMUM = (
    rf"(?:{_LEAST}|min)\s+(?:ground\s+)?{_OF}\b\.?|(?:{_LEAST})(?=\s*[(\[:=,;\t]\s*[-+\d.a-z])|{_OF}\s+(?:{_LEAST})(?![a-z])"
    r"|[af]_?min\b|(?:kleinst|minimal|mindest)wert|\u6700\u5c0f(?:\u5024|\u503c|\u52a0\u901f\u5ea6|\u8377\u91cd)"
)
OF_ACCELERATION = "acc|pga|beschl|acel|ivme|\u52a0\u901f\u5ea6"
OF_QUANTITY = (
    ("velocity", r"pgv|veloc|vel\b|geschwind|vitesse|velocid"),
    ("displacement", r"pgd|disp|weg|deplac|desplaz|spostam|deslocam|stroke|\u5909\u4f4d|\u4f4d\u79fb"),
    (
        "force",
        r"force\b|load\b|kraft|last\b|carga|fuerza|forza|forca|carico|effort|charge|kuvvet|\b[fp]_?max|\u8377\u91cd|\u529b",
    ),
)
BARE_MINIMUM = r"min(?=\s*[:=]\s*[-+]?[\d.])"  # beside a maximum only: it can be a minute too
FACTOR = re.compile(
    r"(?:(?:scale|scaling|conversion|calibration|multiplication)[\s_-]*factor|scaling|multiplier|(?:multipl\w+|divid\w+)(?:\s+\w+){0,2}?\s+(?:by|with)"
    r"|(?:skalierungs|umrechnungs|kalibrier)faktor|mit\s+faktor|facteur\s+(?:d['\u2019]\s*echelle|de\s+\w+)|factor\s+de\s+\w+"
    r"|fattore\s+di\s+\w+|fator\s+de\s+\w+|olcek\s+faktoru|carpan|(?<![a-z])factor(?=\s*[:=])|(?<![a-z])gain(?=\s*[:=]))"
    rf"\s*(?:[:=,;\t(]|\bis\b|\bof\b|\bby\b|\bwith\b)*\s*(?P<v>{NUMBER})"
)
PEAK_TIME = (
    r"time\s+of\s+(?:the\s+)?(?:pga|peak|max\w*)|(?:pga|peak)\s+time|zeit(?:punkt)?\s+des\s+\w*(?:maximum|spitze)\w*"
    r"|temps\s+d(?:u|e\s+la?)\s+(?:pic|max\w*|pga)|tiempo\s+(?:del?\s+)?(?:pico|pga|max\w*)|tempo\s+(?:del?\s+)?(?:picco|pga|max\w*)"
)
OTHER_FACTOR = re.compile(
    r"sensor|instrument|recorder|digiti[sz]er|pre-?amp|amplifier|filter|damping|safety|similitude|geometr|model|length|participation|importance|ductility"
)
OTHER_PEAK = re.compile(r"full\s*scale|range|capacity|stroke|rated|limit|sensitivity|clip|filter|spectr|target|nominal|allow")
OTHER_UNIT = re.compile(
    r"full\s*scale|range|sensitivity|resolution|noise|\blsb\b|threshold|trigger|clip|filter|\bgain\b|capacity|messbereich|empfindlichkeit"
)

MISSING = (
    r"missing(?:\s+(?:data|values?|samples?))?|no[\s-]*data(?:\s+values?)?|null(?:\s+values?)?|nan\s+value|_?fill\s*value"
    r"|bad\s+(?:data|values?)|dummy(?:\s+values?)?|fehl(?:wert|end\w*(?:\s+\w+)?)|ungultig\w*|(?:valeurs?|donnees?)\s+manquantes?"
    r"|(?:valor(?:es)?|datos?)\s+(?:faltantes?|ausentes?|perdidos?|nulos?)|sin\s+datos?|(?:valor[ei]|dat[oi])\s+mancant[ei]"
)
CHANNELS = (
    r"(?:number|no|num)\b\.?\s*(?:of\s+)?(?:channels|columns|signals)|(?:channels|columns)(?=\s*[:=]\s*\d)|kanalanzahl"
    r"|anzahl\s+(?:der\s+)?(?:kanale|spalten)|nombre\s+de\s+(?:canaux|voies|colonnes)|numero\s+(?:de|di)\s+(?:canales|canali|columnas|colonne)"
)
UNIT = (
    r"\b(?:units?|einheit(?:en)?|unites?|unidad(?:es)?|unita(?:\s+di\s+misura)?|unidade|birim|\u5358\u4f4d|\u5355\u4f4d|\u55ae\u4f4d)\b(?:\s+of\s+\w+)?"
    r"\s*(?:[:=]|\bof\b|\bin\b|\bare\b|\bis\b|\bde\b)\s*"
)
COMPONENT = (
    r"n\s*-?\s*s|[eo]\s*-?\s*w|e\s*-\s*o|u\s*-?\s*d|north\s*-?\s*south|east\s*-?\s*west|nord\s*-?\s*sud|ost\s*-?\s*west"
    r"|est\s*-?\s*ouest|n\d{2,3}[ew]?|h[12]|vert(?:ical|ikal|icale)?|up|long(?:itudinal)?|trans(?:versal|verse)?|[nezvltxy]"
)
COMPONENTS = r"(?:components?|komponenten?|composantes?|componentes?|componenti|channels?|kanale)\s*[:=]\s*"

_WIDE = re.compile("[\uff01-\uff9f]+")  # letters, digits and kana of another width
_VOICED = "\u3099\u309a"  # marks of Japanese sounds, which tell one syllable from another


def plain(text: str) -> str:
    """The text in lower case, without accents, in the signs of a keyboard."""
    return without_accents(unit_text.ascii_signs(text)).lower()


def without_accents(text: str) -> str:
    """The text without accents, in the case in which it is written; Japanese sounds keep their marks, wide signs are narrow."""
    narrow = _WIDE.sub(lambda wide: unicodedata.normalize("NFKC", wide[0]), text)
    apart = unicodedata.normalize("NFD", narrow.replace("\u00df", "ss").replace("\u0131", "i"))
    kept = "".join(sign for sign in apart if sign in _VOICED or not unicodedata.combining(sign))
    return unicodedata.normalize("NFC", kept)


def number(text: str) -> float:
    """The number in a text of the pattern NUMBER, with a decimal point or comma."""
    digits = re.sub(_GROUP, "", text).replace("d", "e")
    digits = digits.replace(",", "") if "," in digits and "." in digits else digits.replace(",", ".")
    return float(digits)


def whole(text: str) -> int | None:
    """The number in a text of the pattern NUMBER as a count: `1,200` is 1200; None where it is no whole number."""
    if re.fullmatch(r"[1-9]\d{0,2}(?:['\u2019\u00a0\u202f.,]\d{3})+", text):
        return int(re.sub(r"\D", "", text))
    found = number(text)
    return int(found) if found == int(found) and found >= 0 else None
