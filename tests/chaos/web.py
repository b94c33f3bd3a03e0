"""The web service of a chaos run, without a worker: `python -m tests.chaos.web DATA PORT`."""

from __future__ import annotations

import sys
from pathlib import Path

import uvicorn

from app.config import from_environment
from app.main import create_app

if __name__ == "__main__":
    data, port = Path(sys.argv[1]), int(sys.argv[2])
    app = create_app(from_environment(data=data, port=port, embedded_worker=False, local_sign_in=True))
    uvicorn.run(app, host="127.0.0.1", port=port, log_level="warning", timeout_graceful_shutdown=2)
