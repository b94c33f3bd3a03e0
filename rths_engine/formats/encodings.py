"""Text in Japanese, Chinese or Turkish code pages, known by words that such a text has in its own code page only."""

from __future__ import annotations

_WORDS = {
    "cp932": "時間 加速度 荷重 変位 単位 サンプリング データ 最大 周波数 観測 記録 速度 試験 成分 地震",
    "euc_jp": "時間 加速度 荷重 変位 単位 サンプリング データ 最大 周波数 観測 記録 速度 試験 成分 地震",
    "gb18030": "时间 加速度 荷载 位移 单位 采样 数据 最大 频率 台站 记录 速度 试验 地震",
    "big5": "時間 加速度 荷重 位移 單位 取樣 資料 最大 頻率 測站 記錄 速度 試驗 地震",
    "cp1254": "sayısı aralığı frekansı sıklığı örneği yer değiştirme kayıt",
}
_EXPECTED = {encoding: tuple(words.split()) for encoding, words in _WORDS.items()}


def of(head: bytes) -> str:
    """The code page of the first bytes of a text; empty for UTF-8, for other text and for binary content."""
    if b"\0" in head or head.isascii() or _decodes(head, "utf-8"):
        return ""
    found = {encoding: _known(head, encoding) for encoding in _EXPECTED}
    best = max(found, key=lambda encoding: found[encoding])
    return best if found[best] else ""


def _decodes(raw: bytes, encoding: str) -> str:
    """The text, where the bytes are of the encoding; a sign cut at the end of the bytes is left out."""
    for cut in range(4):
        try:
            return raw[: len(raw) - cut].decode(encoding)
        except UnicodeDecodeError as error:
            if error.start < len(raw) - 4:
                return ""
    return ""


def _known(raw: bytes, encoding: str) -> int:
    """How many letters the words have that the text has in this encoding."""
    text = _decodes(raw, encoding).lower()
    return sum(len(word) for word in _EXPECTED[encoding] if word in text)
