"""What a laboratory checks of its audit log: the chain, its head, and an export by a program that is not ours."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

from fastapi.testclient import TestClient

ROOT = Path(__file__).parents[2]


def test_the_log_says_whether_its_chain_is_whole(client: TestClient) -> None:
    client.post("/api/v1/queue/hold", json={"by": "Ana"})
    found = client.get("/api/v1/audit/check").json()
    head = client.get("/api/v1/audit/head").json()
    assert found["whole"] and found["head"] == head and head["text"] == f"{head['number']}:{head['hash']}"
    assert client.get("/api/v1/audit/check", params={"head": head["text"]}).json()["whole"]
    refused = client.get("/api/v1/audit/check", params={"head": "nothing"})
    assert refused.status_code == 422 and refused.json()["errors"][0]["where"] == "head"


def test_an_export_passes_the_script_of_the_documents(client: TestClient, tmp_path: Path) -> None:
    for name in ("Zoë", 'a "quoted" \\ name', "line\nbreak"):
        client.post("/api/v1/queue/hold", json={"by": name, "reason": "größer 🙂"})
    text = client.get("/api/v1/audit/export").text
    script = re.search(r"```python\n(import hashlib.*?)```", (ROOT / "docs" / "audit.md").read_text(encoding="utf-8"), re.S)
    assert script is not None and len(script[1].strip().splitlines()) <= 10

    def verified(text: str) -> subprocess.CompletedProcess[str]:
        verify = [sys.executable, "-c", script[1]]
        return subprocess.run(verify, input=text, capture_output=True, text=True, encoding="utf-8", check=False)

    whole, changed = verified(text), verified(text.replace("Zoë", "Zoe"))
    assert whole.returncode == 0 and client.get("/api/v1/audit/head").json()["text"] in whole.stdout, whole.stderr
    assert changed.returncode != 0 and "entry" in changed.stderr
