"""The whole service for a browser test: `python -m tests.browser.serve DATA PORT`, on RTHS_DATABASE_URL where it is set."""

from __future__ import annotations

import sys
from pathlib import Path

import uvicorn

from app.cli.serve import LIVE
from app.config import from_environment
from app.main import create_app

if __name__ == "__main__":
    data, port = Path(sys.argv[1]), int(sys.argv[2])
    settings = from_environment(data=data, port=port, local_sign_in=True)
    uvicorn.run(create_app(settings), host="127.0.0.1", port=port, log_level="warning", **LIVE)
